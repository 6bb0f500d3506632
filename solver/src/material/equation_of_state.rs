//! Linear equation of state of a weakly compressible material.
//!
//! Equation (6): p = K (ρ/ρ0 − 1), with sound speed c = √(K/ρ0); (23) is its inverse, ρ = ρ0 (p/K + 1).

use crate::lanes::Real;
use serde::{Deserialize, Serialize};

/// Treatment of a negative pressure.
#[derive(Serialize, Deserialize, schemars::JsonSchema, Clone, Copy, Debug, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum Tension {
    /// Cut to zero: dry grains carry no tension.
    Cut,
    /// Kept: a liquid below its reference density is pulled together.
    Kept,
}

/// Pressure as a linear function of density.
#[derive(Serialize, Deserialize, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct EquationOfState {
    /// Density ρ0 `[kg/m³]` without pressure.
    pub reference_density: f64,
    /// Bulk modulus K `[Pa]`.
    pub bulk_modulus: f64,
    /// Treatment of negative pressures.
    pub tension: Tension,
}

impl EquationOfState {
    /// Pressure `[Pa]` at a density `[kg/m³]`, equation (6).
    #[inline(always)]
    #[must_use]
    pub fn pressure<R: Real>(&self, density: R) -> R {
        // (ρ − ρ0)/ρ0 keeps the digits that ρ/ρ0 − 1 loses near ρ0.
        let reference = R::splat(self.reference_density);
        let pressure = R::splat(self.bulk_modulus) * ((density - reference) / reference);
        match self.tension {
            Tension::Cut => pressure.max(R::splat(0.0)),
            Tension::Kept => pressure,
        }
    }

    /// Density `[kg/m³]` at a pressure `[Pa]`, equation (23); not cut, so that walls can continue a profile.
    #[inline(always)]
    #[must_use]
    pub fn density(&self, pressure: f64) -> f64 {
        self.reference_density * (pressure / self.bulk_modulus + 1.0)
    }

    /// The same in the order of rounding that the pairwise operators have for their wall partners.
    #[inline(always)]
    #[must_use]
    pub fn density_of_wall<R: Real>(&self, pressure: R) -> R {
        R::splat(self.reference_density) + pressure * R::splat(self.reference_density / self.bulk_modulus)
    }

    /// Speed of sound c = √(K/ρ0) `[m/s]`.
    #[inline(always)]
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        (self.bulk_modulus / self.reference_density).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAINS: EquationOfState =
        EquationOfState { reference_density: 1500.0, bulk_modulus: 1.03e5, tension: Tension::Cut };

    #[test]
    fn density_and_pressure_are_inverse() {
        for pressure in [0.0, 1e-3, 12.5, 2060.0] {
            // One rounding of ρ ≈ 1500 is worth K · 1e-16 in p.
            assert!((GRAINS.pressure(GRAINS.density(pressure)) - pressure).abs() < 1e-10);
        }
    }

    #[test]
    fn tension_is_cut_for_grains_and_kept_for_a_liquid() {
        let liquid = EquationOfState { tension: Tension::Kept, ..GRAINS };
        assert_eq!(GRAINS.pressure(1499.0), 0.0);
        assert!((liquid.pressure(1499.0) + 1.03e5 / 1500.0).abs() < 1e-9);
    }

    #[test]
    fn sound_speed_is_the_slope_of_the_pressure() {
        let slope = (GRAINS.pressure(1510.0) - GRAINS.pressure(1505.0)) / 5.0;
        assert!((GRAINS.sound_speed() - slope.sqrt()).abs() < 1e-9);
    }
}
