//! The velocity of a wall partner by (18)–(20): v_a − v_w = β (v_a − v_wall), linear through zero at the surface.

use crate::lanes::Real;
use crate::lanes::algebra::dot;

/// β_max of the paper (20) `[-]`.
pub const PAPER_LIMIT: f64 = 2.0;
/// β_max of the recipe `[-]`.
pub const LIMIT: f64 = 6.0;

/// β = min(β_max, 1 + d_w/d_a) of (20) `[-]`: `r` is r_aw `[m]`, `normal` that of the wall into the flow, `depth` d_w
/// `[m]`, so that the distance d_a of a to the surface is n·r − d_w, kept above 1e-6 h.
#[inline(always)]
pub fn factor<V: Real, const D: usize>(r: &[V; D], normal: &[V; D], depth: V, smoothing_length: f64, limit: f64) -> V {
    let distance = (dot(normal, r) - depth).max(V::splat(1e-6 * smoothing_length));
    (V::splat(1.0) + depth / distance).min(V::splat(limit))
}
