//! Bingham plastic whose yield stress grows with the pressure by Coulomb friction: a bed of grains that yields at its
//! surface and holds below.
//!
//! τ = τ_y + μ_c p + μ |γ̇|, (21) of the bed-load model with a yield stress that knows the overburden; regularised after
//! Papanastasiou (1987) and bounded,
//!
//! η = μ + min[(τ_y + μ_c p) (1 − exp(−|γ̇|/γ_r))/|γ̇|, η_max], with |γ̇| = √(2 ε′:ε′).
//!
//! Limits: τ_y + μ_c p over γ_r at rest, where η_max does not bound it; μ at high rates; Bingham's law for μ_c = 0. Equation
//! (21) writes |S| = √(S:S) = |γ̇|/√2: its τ_Y is √2 τ_y. A negative pressure counts as none.

use super::ViscousLaw;
use super::regularisation::inverse_shear_rate_by_one_division;
use crate::parameter::{not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A viscous material that creeps below a yield stress with cohesion and friction.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct CoulombBingham {
    /// Yield stress τ_y `[Pa]` without pressure, in the norm √(½ s:s).
    #[schemars(transform = not_negative("give the yield stress in Pa, or 0 for grains without cohesion"))]
    pub yield_stress: f64,
    /// Friction coefficient μ_c of Coulomb on the pressure `[-]`; 0 is Bingham's law.
    #[schemars(transform = not_negative("give 0.6 for sand and gravel, or 0 for no friction"))]
    pub friction: f64,
    /// Plastic viscosity μ `[Pa·s]`: the slope of τ over |γ̇| in flow.
    #[schemars(transform = not_negative("give the viscosity of the flowing material in Pa·s"))]
    pub plastic_viscosity: f64,
    /// Regularisation rate γ_r `[1/s]`: below it the material creeps.
    #[schemars(transform = positive("give about 1/100 of the typical shear rate in 1/s"))]
    pub regularisation_rate: f64,
    /// Largest viscosity η_max `[Pa·s]` of the yield: what a deep bed at rest is bounded by.
    #[schemars(transform = positive("give a viscosity in Pa·s at which the bed hardly creeps, such as 1e4"))]
    pub largest_viscosity: f64,
}

impl ViscousLaw for CoulombBingham {
    #[inline]
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        let inverse_rate = inverse_shear_rate_by_one_division(shear_rate, self.regularisation_rate);
        let yield_stress = self.yield_stress + self.friction * pressure.max(0.0);
        (yield_stress * inverse_rate).min(self.largest_viscosity) + self.plastic_viscosity
    }

    #[inline]
    fn largest_viscosity(&self, pressure: f64) -> f64 {
        self.viscosity(0.0, pressure)
    }

    /// μ_c: a grain that has left its bed has no pressure, and would slide along a wall for ever.
    fn contact_friction(&self) -> f64 {
        self.friction
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::rheology::Bingham;

    const BED: CoulombBingham = CoulombBingham {
        yield_stress: 5.1,
        friction: 0.6,
        plastic_viscosity: 1.67,
        regularisation_rate: 0.01,
        largest_viscosity: 1e4,
    };

    #[test]
    fn yields_by_cohesion_and_friction_above_the_regularisation() {
        for (rate, pressure) in [(2.0, 0.0), (10.0, 40.0), (300.0, 470.0)] {
            let stress = BED.viscosity(rate, pressure) * rate;
            assert!((stress - (5.1 + 0.6 * pressure + 1.67 * rate)).abs() < 1e-12 * stress);
        }
        assert_eq!(BED.viscosity(3.0, -5.0), BED.viscosity(3.0, 0.0));
    }

    #[test]
    fn is_bingham_without_friction_and_bounded_at_depth() {
        let bingham = Bingham { yield_stress: 5.1, plastic_viscosity: 1.67, regularisation_rate: 0.01 };
        let frictionless = CoulombBingham { friction: 0.0, ..BED };
        for rate in [0.0, 1e-3, 1.0, 50.0] {
            let expected = bingham.viscosity(rate, 0.0);
            assert!((frictionless.viscosity(rate, 900.0) - expected).abs() < 1e-14 * expected);
        }
        // (5.1 + 0.6 · 470) Pa over 0.01/s are 28.7 kPa·s
        assert_eq!(BED.largest_viscosity(470.0), 1e4 + 1.67);
        assert!((BED.largest_viscosity(10.0) - (11.1 / 0.01 + 1.67)).abs() < 1e-9);
    }

    #[test]
    fn stress_grows_and_viscosity_falls_with_the_shear_rate() {
        let (mut stress, mut viscosity) = (0.0, BED.largest_viscosity(300.0));
        for k in 0..100 {
            let rate = 1e-6 * libm::pow(1.25, f64::from(k));
            let next = BED.viscosity(rate, 300.0);
            assert!(next * rate > stress && next <= viscosity);
            (stress, viscosity) = (next * rate, next);
        }
    }
}
