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
