//! A case for the harness' and the program's own tests: a damped pendulum, cheap and with an exact solution.

use crate::case::{Case, Flow, Judge, ParameterError, Progress, Registry, RunCost, Tabulate};
use crate::metric::{Confidence, Limit, Metric, Variant};
use crate::observation::{Frame, Outcome, Recorded};
use crate::output::Table;
use bagnold_solver::parameter::{inside, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub(crate) static REGISTRY: Registry = Registry::new(&[&Pendulum]);

#[derive(Debug)]
pub(crate) struct Pendulum;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct Swing {
    /// Start `[°]`.
    #[schemars(transform = inside(-90.0, 90.0, "give it in degrees").in_words("above −90° and below 90°"))]
    slope_angle: f64,
    steps: u64,
    limit: f64,
    grain: PendulumBob,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
struct PendulumBob {
    /// `[m]`.
    #[schemars(transform = positive("give it in metres").in_words("positive"))]
    diameter: f64,
    damping: f64,
}

impl Default for Swing {
    fn default() -> Self {
        Self { slope_angle: 10.0, steps: 20, limit: 0.05, grain: PendulumBob { diameter: 1e-3, damping: 1.0 } }
    }
}

impl Flow for Swing {
    const RUNS: &'static str = "[[vary]]\npath = \"steps\"\nvalues = [20, 40]\npaper = [20, 400]";
    type Observation = Vec<f64>;

    fn variant(&self) -> Variant {
        Variant::of("steps", self.steps)
    }
    fn cost(&self) -> RunCost {
        RunCost::weakly_compressible(1.0, self.steps as f64)
    }
    fn simulate(&self, progress: &Progress) -> Result<Recorded<Vec<f64>>, ParameterError> {
        if self.steps == 0 {
            return Err(ParameterError::field("steps", 0, "positive", "take more steps"));
        }
        let interval = 1.0 / self.steps as f64;
        let mut angle = vec![self.slope_angle];
        for step in 0..self.steps {
            let last = angle[angle.len() - 1];
            angle.push(last - interval * self.grain.damping * last);
            progress.advance(step as f64 * interval, 1.0, step as f64);
        }
        let end = angle[angle.len() - 1];
        let diverged = Outcome::Diverged { message: "particle 0 left".to_owned(), expected: self.grain.damping > 1e6 };
        Ok(Recorded {
            outcome: if end.abs() <= 1e3 { Outcome::Finished } else { diverged },
            state_hash: format!("{:016x}", end.to_bits()),
            particles: 1,
            steps: self.steps,
            simulated_time: 1.0,
            wall_seconds: 1e-6,
            threads: rayon::current_num_threads(),
            frames: vec![Frame {
                time: 1.0,
                position: vec![[end.sin(), -end.cos(), 0.0]],
                scalars: vec![("angle".to_owned(), "rad".to_owned(), vec![end])],
                vectors: vec![("velocity".to_owned(), "m/s".to_owned(), vec![[0.0, 1.0, 2.0]])],
            }],
            first_bad: None,
            data: angle,
        })
    }
}

impl Case for Pendulum {
    const NAME: &'static str = "pendulum";
    const SUMMARY: &'static str = "damped pendulum for tests";
    const DESCRIPTION: &'static str = "An overdamped pendulum against its exponential decay.";
    type Flow = Swing;
    const METRICS: Judge<Self::Flow> = |records| {
        records
            .iter()
            .map(|(run, record)| {
                let exact = run.slope_angle * (-run.grain.damping).exp();
                let end = record.data.last().copied().unwrap_or(f64::NAN);
                Metric::observed("decay_error", &run.variant(), (end / exact - 1.0).abs(), "-")
                    .against(Some(0.0), "exponential decay", Confidence::Exact)
                    .gated(Limit::AtMost(run.limit), "first order in the step")
            })
            .collect()
    };
    const TABLES: Tabulate<Self::Flow> = |records| {
        let rows = records.iter().flat_map(|(_, record)| &record.data).map(|&angle| vec![angle]).collect();
        vec![Table { name: "angle".to_owned(), columns: vec!["angle [rad]".to_owned()], rows }]
    };
}
