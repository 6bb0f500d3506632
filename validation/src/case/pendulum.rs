//! A case for this crate's own tests: a damped pendulum, cheap and with an exact solution.

use super::error::ParameterError;
use super::{Case, Progress, Registry, Run, Tier};
use crate::figure::Figure;
use crate::metric::{Confidence, Limit, Metric, Variant};
use crate::observation::{Frame, Outcome, Recorded};
use crate::output::Table;
use serde::{Deserialize, Serialize};

pub(crate) static REGISTRY: Registry = Registry::new(&[&Pendulum]);

#[derive(Debug)]
pub(crate) struct Pendulum;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Parameters {
    slope_angle: f64,
    steps: Vec<u64>,
    limit: f64,
    grain: Grain,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Grain {
    diameter: f64,
    damping: f64,
}

#[derive(Debug, Clone, Serialize)]
pub(crate) struct Swing {
    steps: u64,
    damping: f64,
    angle: f64,
}

impl Run for Swing {
    fn variant(&self) -> Variant {
        Variant::of("steps", self.steps)
    }
    fn particle_steps(&self) -> f64 {
        self.steps as f64
    }
}

impl Case for Pendulum {
    type Parameters = Parameters;
    type Run = Swing;
    type Observation = Vec<f64>;

    fn name(&self) -> &'static str {
        "pendulum"
    }
    fn summary(&self) -> &'static str {
        "damped pendulum for tests"
    }
    fn description(&self) -> &'static str {
        "An overdamped pendulum against its exponential decay."
    }
    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        &[("slope_angle", "start [°]"), ("grain.diameter", "[m]")]
    }
    fn parameters(&self, tier: Tier) -> Parameters {
        let finest = if tier == Tier::Quick { 40 } else { 400 };
        Parameters {
            slope_angle: 10.0,
            steps: vec![20, finest],
            limit: 0.05,
            grain: Grain { diameter: 1e-3, damping: 1.0 },
        }
    }
    fn check(&self, parameters: &Parameters) -> Result<(), ParameterError> {
        let diameter = parameters.grain.diameter;
        if !(diameter > 0.0 && diameter.is_finite()) {
            return Err(ParameterError::field("grain.diameter", diameter, "positive", "give it in metres"));
        }
        if !(parameters.slope_angle > -90.0 && parameters.slope_angle < 90.0) {
            let rule = "inside (−90°, 90°)";
            return Err(ParameterError::field("slope_angle", parameters.slope_angle, rule, "give it in degrees"));
        }
        Ok(())
    }
    fn runs(&self, parameters: &Parameters) -> Vec<Swing> {
        let swing = |&steps: &u64| Swing { steps, damping: parameters.grain.damping, angle: parameters.slope_angle };
        parameters.steps.iter().map(swing).collect()
    }
    fn simulate(&self, run: &Swing, progress: &dyn Progress) -> Result<Recorded<Vec<f64>>, ParameterError> {
        if run.steps == 0 {
            return Err(ParameterError::field("steps", 0, "positive", "take more steps"));
        }
        let interval = 1.0 / run.steps as f64;
        let mut angle = vec![run.angle];
        for step in 0..run.steps {
            let last = angle[angle.len() - 1];
            angle.push(last - interval * run.damping * last);
            progress.advance(step as f64 * interval, 1.0, step as f64);
        }
        let end = angle[angle.len() - 1];
        let diverged = Outcome::Diverged { message: "particle 0 left".to_owned(), expected: run.damping > 1e6 };
        Ok(Recorded {
            outcome: if end.abs() <= 1e3 { Outcome::Finished } else { diverged },
            state_hash: format!("{:016x}", end.to_bits()),
            particles: 1,
            steps: run.steps,
            simulated_time: 1.0,
            wall_seconds: 1e-6,
            threads: rayon::current_num_threads(),
            frames: vec![Frame {
                time: 1.0,
                position: vec![[end.sin(), -end.cos(), 0.0]],
                scalars: vec![("angle".to_owned(), "rad".to_owned(), vec![end])],
                vectors: vec![("velocity".to_owned(), "m/s".to_owned(), vec![[0.0, 1.0, 2.0]])],
            }],
            data: angle,
        })
    }
    fn metrics(&self, parameters: &Parameters, records: &[(Swing, Recorded<Vec<f64>>)]) -> Vec<Metric> {
        records
            .iter()
            .map(|(run, record)| {
                let exact = run.angle * (-run.damping).exp();
                let end = record.data.last().copied().unwrap_or(f64::NAN);
                Metric::observed("decay_error", &run.variant(), (end / exact - 1.0).abs(), "-")
                    .against(Some(0.0), "exponential decay", Confidence::Exact)
                    .gated(Limit::AtMost(parameters.limit), "first order in the step")
            })
            .collect()
    }
    fn figures(&self, _parameters: &Parameters, _records: &[(Swing, Recorded<Vec<f64>>)]) -> Vec<Figure> {
        Vec::new()
    }
    fn tables(&self, _parameters: &Parameters, records: &[(Swing, Recorded<Vec<f64>>)]) -> Vec<Table> {
        let rows = records.iter().flat_map(|(_, record)| &record.data).map(|&angle| vec![angle]).collect();
        vec![Table { name: "angle".to_owned(), columns: vec!["angle [rad]".to_owned()], rows }]
    }
}
