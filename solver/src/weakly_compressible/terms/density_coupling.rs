//! Density–pressure coupling (27): it damps the checkerboard of the pressure and vanishes for smooth fields.
//!
//! The paper subtracts the divergence of the discrete gradient (28) from a Laplacian. Here the difference is one
//! pair sum, Σ V_b F [2(p_a − p_b) − (G_a + G_b)·r_ab] with the corrected pressure gradient G, which is exactly zero
//! for a linear pressure also at free surfaces and walls, and antisymmetric up to V (so it makes no mass).
//! Algebraically it is the density diffusion of Antuono et al. (2010) with δ = σ c Δt/h.

use crate::lanes::Real;
use crate::lanes::algebra::dot;

/// The bracket [2(p_a − p_b) − (G_a + G_b)·r_ab] `[Pa]`.
#[inline(always)]
pub fn bracket<V: Real, const D: usize>(pressure_difference: V, gradient_sum: &[V; D], r: &[V; D]) -> V {
    pressure_difference + pressure_difference - dot(gradient_sum, r)
}
