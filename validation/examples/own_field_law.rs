//! The program `bagnold` with a law of one's own that remembers: friction that softens with the plastic strain.
//! `cargo run --example own_field_law -- run SCENE.toml` takes `law = "softening"` in the scene's material.

use bagnold_solver::material::rheology::TrialStress;
use bagnold_solver::material::rheology::field::{FieldReturn, FieldStep, LawField};
use bagnold_solver::material::rheology::open::{OpenFieldLaw, OpenLaw, Parameters, RegistrationError, register};
use serde::Deserialize;
use std::process::ExitCode;

/// The parameters, which a file gives beside the key `law`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Softening {
    /// Friction coefficient before the material has yielded `[-]`.
    peak_friction: f64,
    /// Friction coefficient after it `[-]`.
    residual_friction: f64,
    /// Plastic shear strain over which the one becomes the other `[-]`.
    softening_strain: f64,
}

impl OpenFieldLaw for Softening {
    fn field(&self) -> LawField {
        LawField {
            name: "plastic_strain",
            unit: "-",
            description: "plastic shear strain so far",
            initial: 0.0,
            bounds: (0.0, 1e6),
            diffusion: None,
        }
    }
    fn end_of_step(&self, trial: &TrialStress<f64>, field: &FieldStep<f64>) -> FieldReturn<f64> {
        let yield_stress = self.yield_stress(trial.pressure, field);
        let beyond = (trial.shear_stress - yield_stress).max(0.0);
        FieldReturn { shear_stress: trial.shear_stress - beyond, field: field.value + beyond / trial.shear_modulus }
    }
    fn yield_stress(&self, pressure: f64, field: &FieldStep<f64>) -> f64 {
        let softened = (field.value / self.softening_strain).min(1.0);
        (self.peak_friction + softened * (self.residual_friction - self.peak_friction)) * pressure.max(0.0)
    }
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.residual_friction * pressure.max(0.0) / shear_rate.max(1e-6)
    }
    fn contact_friction(&self) -> f64 {
        self.residual_friction
    }
}

/// Makes `law = "softening"` known, once a program and before the first file is read.
pub(crate) fn register_softening() -> Result<(), RegistrationError> {
    register("softening", |parameters: &Parameters| Ok(OpenLaw::with_field(parameters.read::<Softening>()?)))
}

fn main() -> ExitCode {
    match register_softening() {
        Ok(()) => bagnold_validation::cli::main(),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
