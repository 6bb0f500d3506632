//! Herschel–Bulkley: τ = τ_y + K |γ̇|ⁿ where it flows; the yield term regularised after Papanastasiou (1987).
//!
//! η = τ_y (1 − exp(−|γ̇|/γ_r))/|γ̇| + η_K with |γ̇| = √(2 ε′:ε′) and the consistency part η_K bounded as well:
//! - n ≤ 1: η_K = K (|γ̇|² + γ_r²)^{(n−1)/2}, so η_K = K γ_r^{n−1} at rest, K exactly for n = 1, and the
//!   relative error against K |γ̇|^{n−1} is about ½ (1 − n)(γ_r/|γ̇|)² in flow;
//! - n > 1: η_K = K min(|γ̇|, γ_max)^{n−1} with γ_max = 1000 1/s. A thickening law has no largest viscosity of
//!   its own and hence no explicit time step; laboratory flows under gravity stay below γ_max.

use super::ViscousLaw;
use super::regularisation::inverse_shear_rate;
use crate::parameter::{above, not_negative, up_to};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Shear rate γ_max `[1/s]` above which a thickening consistency (n > 1) no longer grows.
const THICKENING_LIMIT: f64 = 1000.0;

/// A yield-stress material whose flow curve is a power law.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct HerschelBulkley {
    /// Yield stress τ_y `[Pa]` in the norm √(½ s:s).
    #[schemars(transform = not_negative("give the yield stress in Pa, or 0 for a power-law liquid"))]
    pub yield_stress: f64,
    /// Consistency K `[Pa·sⁿ]`.
    #[schemars(transform = not_negative("give the consistency in Pa·sⁿ"))]
    pub consistency: f64,
    /// Flow index n `[-]`: thinning below 1, thickening above.
    #[schemars(transform = up_to(2.0, "give the exponent of the shear rate, such as 1 for a Bingham plastic"))]
    pub flow_index: f64,
    /// Regularisation rate γ_r `[1/s]`: well below the shear rates of interest.
    #[schemars(transform = above(0.0, "give about 1/100 of the typical shear rate in 1/s"))]
    pub regularisation_rate: f64,
}

impl HerschelBulkley {
    /// The bounded consistency part η_K `[Pa·s]` at a shear rate `[1/s]`.
    #[inline]
    fn consistency_viscosity(&self, shear_rate: f64) -> f64 {
        let exponent = self.flow_index - 1.0;
        let rate = if exponent <= 0.0 {
            (shear_rate * shear_rate + self.regularisation_rate * self.regularisation_rate).sqrt()
        } else {
            shear_rate.min(THICKENING_LIMIT)
        };
        self.consistency * libm::pow(rate, exponent)
    }
}

impl ViscousLaw for HerschelBulkley {
    #[inline]
    fn viscosity(&self, shear_rate: f64, _pressure: f64) -> f64 {
        self.yield_stress * inverse_shear_rate(shear_rate, self.regularisation_rate)
            + self.consistency_viscosity(shear_rate)
    }

    /// The sum of the two parts' own maxima: at rest for n ≤ 1; for n > 1, where the maxima lie at opposite ends, an upper bound.
    #[inline]
    fn largest_viscosity(&self, _pressure: f64) -> f64 {
        let stiffest_rate = if self.flow_index <= 1.0 { 0.0 } else { THICKENING_LIMIT };
        self.yield_stress / self.regularisation_rate + self.consistency_viscosity(stiffest_rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::rheology::Bingham;

    const CLAY: HerschelBulkley =
        HerschelBulkley { yield_stress: 15.0, consistency: 4.0, flow_index: 0.4, regularisation_rate: 0.02 };

    #[test]
    fn flows_with_the_herschel_bulkley_stress() {
        for flow_index in [0.4, 1.0, 1.7] {
            let law = HerschelBulkley { flow_index, ..CLAY };
            for rate in [5.0f64, 80.0] {
                let exact = 15.0 + 4.0 * rate.powf(flow_index);
                assert!((law.viscosity(rate, 0.0) * rate - exact).abs() < 1e-5 * exact, "n = {flow_index}");
            }
        }
    }

    #[test]
    fn is_finite_and_bounded_at_every_rate() {
        for flow_index in [0.1, 0.4, 1.0, 1.5, 2.0] {
            let law = HerschelBulkley { flow_index, ..CLAY };
            let bound = law.largest_viscosity(0.0);
            let mut previous_stress = 0.0;
            for k in -60..60 {
                let rate = libm::pow(1.4, f64::from(k));
                let viscosity = law.viscosity(rate, 0.0);
                assert!(viscosity.is_finite() && viscosity <= bound * (1.0 + 1e-15), "n = {flow_index}, rate = {rate}");
                assert!(viscosity * rate > previous_stress, "n = {flow_index}, rate = {rate}");
                previous_stress = viscosity * rate;
            }
            assert!(law.viscosity(0.0, 0.0) <= bound);
        }
    }

    #[test]
    fn a_flow_index_of_one_is_a_bingham_plastic() {
        let law = HerschelBulkley { flow_index: 1.0, ..CLAY };
        let bingham = Bingham { yield_stress: 15.0, plastic_viscosity: 4.0, regularisation_rate: 0.02 };
        for rate in [0.0, 1e-3, 0.02, 7.0] {
            assert!((law.viscosity(rate, 0.0) - bingham.viscosity(rate, 0.0)).abs() < 1e-12);
        }
    }
}
