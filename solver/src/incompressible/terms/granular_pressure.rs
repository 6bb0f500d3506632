//! The pressure of grains between two particles: F_ab = −v_a v_b (p_a/φ_a² + p_b/φ_b²) ∇W with the volumes v of the grains
//! in a particle, equal and opposite.

use crate::vector::Vector;

/// −F_ab/v_a `[N/m^D]` from x_a − x_b `[m]`, F `[1/m^(D+2)]`, v_b `[m^D]` and p_a/φ_a² + p_b/φ_b² `[Pa]`.
#[inline(always)]
pub(crate) fn pull<const D: usize>(separation: Vector<D>, gradient: f64, grains: f64, pressures: f64) -> Vector<D> {
    separation * (grains * pressures * gradient)
}
