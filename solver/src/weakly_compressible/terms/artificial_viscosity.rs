//! Artificial viscosity (15) for approaching pairs and Morris & Monaghan's switch (16) of its coefficient.

use crate::lanes::Real;

/// Smallest coefficient of the switch `[-]`.
pub const SWITCH_LOWEST: f64 = 0.1;
/// Largest coefficient of the switch `[-]`.
pub const SWITCH_HIGHEST: f64 = 1.0;
/// σ in the switch's decay time ς = h/(σ c) `[-]`, Morris & Monaghan's 0.1.
const DECAY: f64 = 0.1;

/// α h c `[m²/s]` of a pair whose particles have coefficients of their own, `speed_length` being h c `[m²/s]`.
#[inline(always)]
pub fn mean_strength<V: Real>(alpha_a: V, alpha_b: V, speed_length: f64) -> V {
    (alpha_b + alpha_a) * V::splat(0.5 * speed_length)
}

/// −Π_ab F-free part of (15): α h c (r·v)⁻ / (ρ̄ r²) `[m⁵/(kg s²)]`, to be multiplied by m_b ∇W.
///
/// `strength` is α h c `[m²/s]`, `approach` r_ab·v_ab `[m²/s]`, `felt` the part of it that is damped `[m²/s]`: of grains what no
/// gradient explains, but never more than the approach. `inverse` is 1/(ρ̄ (r² + δ²)) `[m/kg]`.
#[inline(always)]
pub fn pair_factor<V: Real>(strength: V, approach: V, felt: V, inverse: V) -> V {
    strength * felt.max(approach).min(V::splat(0.0)) * inverse
}

/// One explicit step of (16): dα/dt = −(α − α_min)/ς + S, S = max(0, −∇·v), ς = h/(σ c).
///
/// `divergence` is ∇·v `[1/s]`, `decay_rate` c/h `[1/s]`.
#[inline(always)]
#[must_use]
pub fn switched<R: Real>(coefficient: R, divergence: R, decay_rate: f64, time_step: f64) -> R {
    let lowest = R::splat(SWITCH_LOWEST);
    let change = (-divergence).max(R::splat(0.0)) - (coefficient - lowest) * R::splat(DECAY * decay_rate);
    (coefficient + R::splat(time_step) * change).max(lowest).min(R::splat(SWITCH_HIGHEST))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::{Kernel, KernelShape};

    #[test]
    fn pairs_of_a_shear_flow_dissipate_what_the_viscosity_says() {
        const STRENGTH: f64 = 3e-4;
        let kernel = Kernel::<3>::new(KernelShape::WendlandC2, 3.0);
        let reach = -6..=6_i32;
        let rates = reach.clone().flat_map(|x| reach.clone().map(move |y| (x, y))).flat_map(|(x, y)| {
            let kernel = &kernel;
            reach.clone().map(move |z| {
                let [x, y, z] = [x, y, z].map(f64::from);
                let squared = x * x + y * y + z * z;
                // v = (y, 0, 0), so that v_ab · r_ab = x y
                let factor = pair_factor(STRENGTH, x * y, x * y, 1.0 / squared.max(0.5));
                let weight = kernel.gradient_factor_at(squared.sqrt());
                if squared < 36.0 { 0.5 * factor * x * y * weight } else { 0.0 }
            })
        });
        // α h c/(2 (D + 2)) of a sum over all pairs (Monaghan 2005), of which the approaching half counts
        let (dissipation, expected) = (rates.sum::<f64>().abs(), STRENGTH / (4.0 * (3.0 + 2.0)));
        assert!((dissipation / expected - 1.0).abs() < 0.01, "{dissipation} instead of {expected}");
    }

    #[test]
    fn the_switch_rises_in_compression_and_decays_at_rest() {
        let rate = 200.0;
        let mut alpha = SWITCH_LOWEST;
        for _ in 0..100 {
            alpha = switched(alpha, -50.0, rate, 1e-3);
        }
        // balance of source and decay: α − α_min = S/(σ c/h) = 2.5, cut at the highest
        assert_eq!(alpha, SWITCH_HIGHEST);
        let start = alpha;
        for _ in 0..50 {
            alpha = switched(alpha, 10.0, rate, 1e-3);
        }
        // exponential decay with the time h/(σ c) = 50 ms
        let expected = SWITCH_LOWEST + (start - SWITCH_LOWEST) * libm::exp(-1.0);
        assert!((alpha - expected).abs() < 0.01 * expected);
    }
}
