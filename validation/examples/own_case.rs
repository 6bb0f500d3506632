//! A case of one's own: a shear wave in a viscous liquid, u = U sin ky, that decays with exp(−ν k² t).
//! `cargo run --example own_case -- report` judges it; with `--fresh` after a change here, which the store does not know.

use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::{domain::Domain, vector::Vector};
use bagnold_validation::case::{Case, ParameterError, Progress, Registry, Run, Tier};
use bagnold_validation::metric::{Confidence, Limit, Metric, Variant};
use bagnold_validation::{cases::recording::record, observation::Recorded};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

pub(crate) static CASES: Registry = Registry::new(&[&ShearWave]);
fn main() -> std::process::ExitCode {
    bagnold_validation::cli::program(CASES, std::env::args_os())
}

/// U = 1 m/s in a box of 1 m, 1000 kg/m³, over 0.2 s.
struct ShearWave;
/// Its parameters, which are its one run as well: particles over the box, kinematic viscosity ν `[m²/s]`.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Wave {
    rows: usize,
    viscosity: f64,
}

impl Run for Wave {
    fn variant(&self) -> Variant {
        Variant::of("rows", self.rows)
    }
}

impl Case for ShearWave {
    type Parameters = Wave;
    type Run = Wave;
    type Observation = f64;
    fn name(&self) -> &'static str {
        "shear-wave"
    }
    fn summary(&self) -> &'static str {
        "a shear wave that decays"
    }
    fn parameters(&self, tier: Tier) -> Wave {
        Wave { rows: if tier == Tier::Quick { 20 } else { 40 }, viscosity: 0.05 }
    }
    fn check(&self, wave: &Wave) -> Result<(), ParameterError> {
        let refusal = ParameterError::field("rows", wave.rows, "10 to 1000", "20 is quick");
        (10..=1000).contains(&wave.rows).then_some(()).ok_or(refusal)
    }
    fn runs(&self, wave: &Wave) -> Vec<Wave> {
        vec![wave.clone()]
    }
    fn simulate(&self, wave: &Wave, progress: &dyn Progress) -> Result<Recorded<f64>, ParameterError> {
        let (n, spacing) = (wave.rows, 1.0 / wave.rows as f64);
        let place = |k: usize| Vector::<2>::new((k % n) as f64 + 0.5, (k / n) as f64 + 0.5) * spacing;
        let mut flow = Flow::at_rest((0..n * n).map(place).collect(), 1000.0, spacing);
        flow.velocity = flow.position.iter().map(|x| Vector::<2>::new((TAU * x[1]).sin(), 0.0)).collect();
        let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Kept };
        let law = Rheology::Newtonian(Newtonian { viscosity: 1000.0 * wave.viscosity });
        let domain = Domain::periodic([0.0; 2], [1.0; 2]);
        let mut simulation = Simulation::new(Scene { domain, ..Scene::unbounded(flow, spacing, liquid, law) })?;
        Ok(record(&mut simulation, 0.2, progress, |end| {
            let waves = end.position.iter().zip(&end.velocity).map(|(x, u)| 2.0 * u[0] * (TAU * x[1]).sin());
            waves.sum::<f64>() / (n * n) as f64
        }))
    }
    fn metrics(&self, wave: &Wave, records: &[(Wave, Recorded<f64>)]) -> Vec<Metric> {
        let error = |(run, record): &(Wave, Recorded<f64>)| {
            let left = record.data / (-wave.viscosity * TAU * TAU * record.simulated_time).exp();
            Metric::observed("amplitude_error", &run.variant(), 100.0 * (left - 1.0), "%")
                .against(Some(0.0), "exp(−ν k² t)", Confidence::Exact)
                .gated(Limit::Within(-3.0, 3.0), "of second order in the spacing: 20 rows a wave")
        };
        records.iter().map(error).collect()
    }
}
