//! Smagorinsky's eddy viscosity, equation (5): ν_s = (C_s Δ)² |γ̇| with |γ̇| = √(2 ε:ε).

use crate::parameter::between;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Sub-particle-scale mixing in proportion to the local shear rate.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Smagorinsky {
    /// Coefficient C_s `[-]`; 0 switches the closure off.
    #[schemars(transform = between(0.0, 1.0, "give 0.07 to 0.25, or 0 for laminar flow"))]
    pub coefficient: f64,
}

impl Smagorinsky {
    /// Mixing length C_s Δ `[m]` at a particle spacing Δ `[m]`.
    #[inline]
    #[must_use]
    pub fn mixing_length(&self, spacing: f64) -> f64 {
        self.coefficient * spacing
    }

    /// Kinematic eddy viscosity ν_s `[m²/s]` at a particle spacing Δ `[m]` and a shear rate `[1/s]`.
    #[inline]
    #[must_use]
    pub fn eddy_viscosity(&self, spacing: f64, shear_rate: f64) -> f64 {
        super::eddy_viscosity(self.mixing_length(spacing), shear_rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shear_stress_is_that_of_a_mixing_length() {
        // Prandtl: τ/ρ = ℓ² |du/dy|², with ℓ = C_s Δ = 0.2 mm and 50 1/s: 1e-4 m²/s².
        let closure = Smagorinsky { coefficient: 0.1 };
        assert!((closure.eddy_viscosity(2e-3, 50.0) * 50.0 - 1e-4).abs() < 1e-18);
    }
}
