//! A Newtonian liquid: s = 2 η ε′ with a constant η.

use super::ViscousLaw;
use crate::parameter::not_negative;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A liquid of constant viscosity.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Newtonian {
    /// Dynamic viscosity η `[Pa·s]`.
    #[schemars(transform = not_negative("give the dynamic viscosity in Pa·s; 0.001 for water, 0 for none"))]
    pub viscosity: f64,
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
