//! Bulk density of a material: from its law, if that has a grain density, or as given.

use crate::case::ParameterError;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, not_negative};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The density of a material in bulk, whatever its law.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bulk {
    /// Solid fraction φ `[-]`: the bulk density is φ times the grain density.
    #[schemars(transform = between(0.01, 1.0, "give 0.5 to 0.64 for grains, or 1 for a law with a bulk density"))]
    pub solid_fraction: f64,
    /// Bulk density `[kg/m³]` of a law without a grain density; 0 with one that has it.
    #[schemars(transform = not_negative("give it in kg/m³, such as 1500, or 0 with a law of grains"))]
    pub bulk_density: f64,
}

impl Bulk {
    /// Grains of a solid fraction, with a law that has their density.
    pub fn of_grains(solid_fraction: f64) -> Self {
        Self { solid_fraction, bulk_density: 0.0 }
    }

    /// Bulk density `[kg/m³]` of a law's material.
    pub fn density(&self, law: &Rheology) -> f64 {
        let of_grains = || law.grain_density().map_or(self.bulk_density, |grains| self.solid_fraction * grains);
        law.pore_liquid().map_or_else(of_grains, |pore| pore.mixture_density())
    }

    /// Refuses a bulk density beside that of the grains, and a law that leaves it open.
    pub fn check(&self, law: &Rheology) -> Result<(), ParameterError> {
        let refused = |rule: &str, remedy: &str| {
            let rule = format!("{rule} \"{}\"", law.name());
            Err(ParameterError::field("bulk_density", self.bulk_density, &rule, remedy))
        };
        if let Some(pore) = law.pore_liquid() {
            if self.solid_fraction != 1.0 {
                let rule = format!("1 with the law \"{}\"", law.name());
                let remedy = format!("leave it out; the law's own `solid_fraction` is {}", pore.solid_fraction);
                return Err(ParameterError::field("solid_fraction", self.solid_fraction, &rule, &remedy));
            }
            return match self.bulk_density {
                0.0 => Ok(()),
                _ => refused("0 with the law", "leave it out; it follows from the densities of grains and liquid"),
            };
        }
        match law.grain_density() {
            Some(_) if self.bulk_density != 0.0 => {
                refused("0 with the law", "leave it out; it follows from `solid_fraction` and the grain density")
            }
            None if self.bulk_density <= 0.0 => {
                refused("positive with the law", "give it in kg/m³, such as 1500, because the law has no grain density")
            }
            _ => Ok(()),
        }
    }
}
