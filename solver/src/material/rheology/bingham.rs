//! Bingham plastic: τ = τ_y + μ |γ̇| where it flows, rigid below τ_y; regularised after Papanastasiou (1987).
//!
//! η = μ + τ_y (1 − exp(−|γ̇|/γ_r))/|γ̇|, with |γ̇| = √(2 ε′:ε′). Limits: μ + τ_y/γ_r at rest, μ at high rates.
//! Equation (21) of the bed-load model writes s = (τ_Y/|S| + 2μ) S with |S| = √(S:S) = |γ̇|/√2: its τ_Y is √2 τ_y.

use super::ViscousLaw;
use super::regularisation::inverse_shear_rate;
use crate::parameter::{above, not_negative};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A viscous material that creeps very slowly, instead of standing still, below a yield stress.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Bingham {
    /// Yield stress τ_y `[Pa]` in the norm √(½ s:s): the shear stress at which simple shear begins.
    #[schemars(transform = not_negative("give the yield stress in Pa, or 0 for a liquid"))]
    pub yield_stress: f64,
    /// Plastic viscosity μ `[Pa·s]`: the slope of τ over |γ̇| in flow.
    #[schemars(transform = not_negative("give the viscosity of the flowing material in Pa·s"))]
    pub plastic_viscosity: f64,
    /// Regularisation rate γ_r `[1/s]`: well below the shear rates of interest.
    #[schemars(transform = above(0.0, "give about 1/100 of the typical shear rate in 1/s"))]
    pub regularisation_rate: f64,
}

impl ViscousLaw for Bingham {
    #[inline]
    fn viscosity(&self, shear_rate: f64, _pressure: f64) -> f64 {
        self.plastic_viscosity + self.yield_stress * inverse_shear_rate(shear_rate, self.regularisation_rate)
    }

    #[inline]
    fn largest_viscosity(&self, _pressure: f64) -> f64 {
        self.plastic_viscosity + self.yield_stress / self.regularisation_rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{Tensor, double_contraction, strain_rate};

    const MUD: Bingham = Bingham { yield_stress: 40.0, plastic_viscosity: 2.0, regularisation_rate: 0.05 };

    #[test]
    fn flows_with_the_bingham_stress_above_the_regularisation() {
        for rate in [2.0, 10.0, 300.0] {
            let shear_stress = MUD.viscosity(rate, 0.0) * rate;
            assert!((shear_stress - (40.0 + 2.0 * rate)).abs() < 1e-12 * shear_stress);
        }
    }

    #[test]
    fn stress_grows_and_viscosity_falls_with_the_shear_rate() {
        let mut previous = (0.0, MUD.largest_viscosity(0.0));
        assert_eq!(MUD.viscosity(0.0, 0.0), previous.1);
        for k in 0..100 {
            let rate = 1e-6 * libm::pow(1.25, f64::from(k));
            let viscosity = MUD.viscosity(rate, 0.0);
            assert!(viscosity * rate > previous.0 && viscosity <= previous.1);
            previous = (viscosity * rate, viscosity);
        }
    }

    #[test]
    fn agrees_with_the_bed_load_model_in_its_own_norm() {
        // Equation (21) in the Frobenius norm, on a plane strain rate with both shear and stretching.
        let strain = strain_rate(&Tensor::<2>::new(3.0, 5.0, -1.0, -3.0));
        let frobenius = double_contraction(&strain, &strain).sqrt();
        let factor = std::f64::consts::SQRT_2 * MUD.yield_stress / frobenius + 2.0 * MUD.plastic_viscosity;
        let viscosity = MUD.viscosity(std::f64::consts::SQRT_2 * frobenius, 0.0);
        assert!((2.0 * viscosity - factor).abs() < 1e-12 * factor);
    }
}
