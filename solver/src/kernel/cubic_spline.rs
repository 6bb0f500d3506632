//! Cubic B-spline, equation (6) of the bed-load paper: 10/(7πh²) in 2-D, 1/(πh³) in 3-D.

use crate::lanes::Real;
use std::f64::consts::PI;

/// W(0) h^D `[-]`.
pub(super) fn normalisation(dimension: usize) -> f64 {
    if dimension == 2 { 10.0 / (7.0 * PI) } else { 1.0 / PI }
}

/// W over its value at 0: ¼(2−q)³ − (1−q)³ for q < 1, ¼(2−q)³ for q < 2.
#[inline(always)]
pub(super) fn value<V: Real>(q: V) -> V {
    let zero = V::splat(0.0);
    let outer = (V::splat(2.0) - q).max(zero);
    let inner = (V::splat(1.0) - q).max(zero);
    outer * outer * outer * V::splat(0.25) - inner * inner * inner
}

/// (1/q) dW/dq over W(0): −3 + 2.25 q for q < 1, −¾(2−q)²/q for q < 2.
#[inline(always)]
pub(super) fn gradient_factor<V: Real>(q: V) -> V {
    let one = V::splat(1.0);
    let outer = (V::splat(2.0) - q).max(V::splat(0.0));
    let near = V::splat(2.25) * q - V::splat(3.0);
    let far = V::splat(-0.75) * outer * outer / q.max(one);
    near.where_less(q, one) + (far - far.where_less(q, one))
}
