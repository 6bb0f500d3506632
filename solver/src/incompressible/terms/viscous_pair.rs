//! Viscous friction of a pair (18): K_ab = −2 V_a V_b (η_a + η_b) F/(M_a + M_b), over the mean of both moments M as in the
//! pressure Poisson equation.

use crate::lanes::Real;

/// Δt K_ab `[kg]` from volumes `[m^D]`, the sum of the moments `[-]`, F `[1/m^(D+2)]` and η_a + η_b `[Pa·s]`.
#[inline(always)]
pub(crate) fn coefficient<V: Real>(time_step: f64, volumes: (f64, f64), moments: V, gradient: V, viscosities: V) -> V {
    of_weight(time_step, volumes, gradient / moments, viscosities)
}

/// The same from F over the sum of the moments `[1/m^(D+2)]`.
#[inline(always)]
pub(crate) fn of_weight<V: Real>(time_step: f64, volumes: (f64, f64), weight: V, viscosities: V) -> V {
    V::splat(-2.0 * time_step * volumes.0 * volumes.1) * viscosities * weight
}

/// Rate of a shear over that of its pairs, |u_ab|/r, as a mean over directions `[-]`.
///
/// A pair along the flow sees nothing of γ̇, one across it all: |u_ab|/r = γ̇ |cosα|. For a stress τ that does not depend on
/// the rate the pairs' viscosities τ π/(4 γ̇ |cosα|) then carry just τ: ⟨|cosα|⟩/⟨cos²α⟩ is 4/π in the plane, 3/2 in space.
/// Particles in rows have fewer directions (`phase/sliding_rows`): of the stress in such rows this carries 0.92.
pub(crate) fn mean_rate(dimensions: usize) -> f64 {
    if dimensions == 2 { 4.0 / std::f64::consts::PI } else { 3.0 / 2.0 }
}
