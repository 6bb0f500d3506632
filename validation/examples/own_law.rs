//! A law of one's own: a power-law liquid, η = K |γ̇|^(n − 1), that no built-in law is.
//! `cargo run --example own_law` lets a shear wave decay in it, for n = 1 as a Newtonian liquid's would.

use bagnold_solver::domain::Domain;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::open::{OpenLaw, Parameters, RegistrationError, register};
use bagnold_solver::material::rheology::{Rheology, ViscousLaw};
use bagnold_solver::run::StopReason;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use serde::Deserialize;
use std::error::Error;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

/// The parameters, which a file gives beside the key `law`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PowerLaw {
    /// K `[Pa·sⁿ]`.
    consistency: f64,
    /// n `[-]`.
    flow_index: f64,
}

impl ViscousLaw for PowerLaw {
    fn viscosity(&self, shear_rate: f64, _pressure: f64) -> f64 {
        // below 0.1 1/s the liquid counts as Newtonian: an explicit step needs a largest viscosity
        self.consistency * shear_rate.max(0.1).powf(self.flow_index - 1.0)
    }
    fn largest_viscosity(&self, pressure: f64) -> f64 {
        self.viscosity(0.0, pressure)
    }
}

/// Makes `law = "power-law"` known, once a program and before the first file is read.
pub(crate) fn register_power_law() -> Result<(), RegistrationError> {
    register("power-law", |parameters: &Parameters| Ok(OpenLaw::viscous(parameters.read::<PowerLaw>()?)))
}

/// The law as a file would name it, at a consistency of 50 Pa·sⁿ.
pub(crate) fn law(flow_index: f64) -> Result<Rheology, toml::de::Error> {
    toml::from_str(&format!("law = \"power-law\"\nconsistency = 50.0\nflow_index = {flow_index}"))
}

/// What is left after 0.2 s of a wave of 1 m/s in a periodic box of 1 m and 1000 kg/m³ `[m/s]`.
pub(crate) fn amplitude_left(law: Rheology) -> Result<f64, Box<dyn Error>> {
    let (n, spacing) = (20, 0.05);
    let place = |k: usize| Vector::<2>::new((k % n) as f64 + 0.5, (k / n) as f64 + 0.5) * spacing;
    let mut flow = Flow::at_rest((0..n * n).map(place).collect(), 1000.0, spacing);
    flow.velocity = flow.position.iter().map(|x| Vector::<2>::new((TAU * x[1]).sin(), 0.0)).collect();
    let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Kept };
    let domain = Domain::periodic([0.0; 2], [1.0; 2]);
    let mut simulation = Simulation::new(Scene { domain, ..Scene::unbounded(flow, spacing, liquid, law) })?;
    if let StopReason::Diverged(divergence) = simulation.run(0.2, 0.2, |_| ControlFlow::Continue(())) {
        return Err(divergence.to_string().into());
    }
    let end = simulation.snapshot();
    let waves = end.position.iter().zip(&end.velocity).map(|(x, u)| 2.0 * u[0] * (TAU * x[1]).sin());
    Ok(waves.sum::<f64>() / (n * n) as f64)
}

fn main() -> Result<(), Box<dyn Error>> {
    register_power_law()?;
    println!("exact for n = 1: {:.3} m/s", (-0.05 * TAU * TAU * 0.2).exp());
    for flow_index in [1.0, 0.5] {
        println!("n = {flow_index}: {:.3} m/s", amplitude_left(law(flow_index)?)?);
    }
    Ok(())
}
