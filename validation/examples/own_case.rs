//! A case of one's own: a shear wave in a viscous liquid, u = U sin ky, that decays with exp(−ν k² t).
//! `cargo run --example own_case -- report` judges it.

use bagnold_harness::case::{Case, Flow, Judge, ParameterError, Progress, Registry};
use bagnold_harness::metric::{Confidence, Limit, Metric, Variant};
use bagnold_harness::{case::recording::record, observation::Recorded};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::scene::{self, Scene};
use bagnold_solver::{domain::Domain, vector::Vector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

pub(crate) static CASES: Registry = Registry::new(&[&ShearWave]);
fn main() -> std::process::ExitCode {
    bagnold_validation::cli::program(CASES, std::env::args_os())
}

/// U = 1 m/s in a box of 1 m, 1000 kg/m³, over 0.2 s.
struct ShearWave;
/// One of its flows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
struct Wave {
    /// Rows of particles over the box.
    #[schemars(transform = between(10.0, 1000.0, "20 is quick"))]
    rows: usize,
    /// Kinematic viscosity ν `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s, such as 0.05"))]
    viscosity: f64,
}

impl Default for Wave {
    fn default() -> Self {
        Self { rows: 20, viscosity: 0.05 }
    }
}

impl Flow for Wave {
    const RUNS: &'static str = "[paper]\nrows = 40";
    type Observation = f64;

    fn variant(&self) -> Variant {
        Variant::of("rows", self.rows)
    }
    fn simulate(&self, progress: &Progress) -> Result<Recorded<f64>, ParameterError> {
        let (n, spacing) = (self.rows, 1.0 / self.rows as f64);
        let place = |k: usize| Vector::<2>::new((k % n) as f64 + 0.5, (k / n) as f64 + 0.5) * spacing;
        let mut flow = scene::Flow::at_rest((0..n * n).map(place).collect(), 1000.0, spacing);
        flow.velocity = flow.position.iter().map(|x| Vector::<2>::new((TAU * x[1]).sin(), 0.0)).collect();
        let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Kept };
        let law = Rheology::Newtonian(Newtonian { viscosity: 1000.0 * self.viscosity });
        let domain = Domain::periodic([0.0; 2], [1.0; 2]);
        let scene = || Scene { domain, ..Scene::unbounded(flow.clone(), spacing, liquid, law) };
        record(scene, 0.2, progress, |end| {
            let waves = end.position.iter().zip(&end.velocity).map(|(x, u)| 2.0 * u[0] * (TAU * x[1]).sin());
            waves.sum::<f64>() / (n * n) as f64
        })
    }
}

impl Case for ShearWave {
    const NAME: &'static str = "shear-wave";
    const SUMMARY: &'static str = "a shear wave that decays";
    type Flow = Wave;
    const METRICS: Judge<Self::Flow> = |records| {
        let error = |(wave, record): &(Wave, Recorded<f64>)| {
            let left = record.data / (-wave.viscosity * TAU * TAU * record.simulated_time).exp();
            Metric::observed("amplitude_error", &wave.variant(), 100.0 * (left - 1.0), "%")
                .against(Some(0.0), "exp(−ν k² t)", Confidence::Exact)
                .gated(Limit::Within(-3.0, 3.0), "of second order in the spacing: 20 rows a wave")
        };
        records.iter().map(error).collect()
    };
}
