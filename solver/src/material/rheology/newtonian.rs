//! A Newtonian liquid: s = 2 η ε′ with a constant η.

use super::{ParameterProblem, ViscousLaw, parameter_range};
use serde::{Deserialize, Serialize};

/// A liquid of constant viscosity.
#[derive(Serialize, Deserialize, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Newtonian {
    /// Dynamic viscosity η `[Pa·s]`, ≥ 0.
    pub viscosity: f64,
}

impl Newtonian {
    pub(super) fn parameter_problem(&self) -> Option<ParameterProblem> {
        parameter_range::not_negative(
            "viscosity",
            self.viscosity,
            "give the dynamic viscosity in Pa·s; 0.001 for water, 0 for none",
        )
    }
}

impl ViscousLaw for Newtonian {
    #[inline]
    fn viscosity(&self, _shear_rate: f64, _pressure: f64) -> f64 {
        self.viscosity
    }

    #[inline]
    fn largest_viscosity(&self, _pressure: f64) -> f64 {
        self.viscosity
    }
}
