//! Quintic B-spline (Schoenberg 1946; Morris, Fox & Zhu 1997) over three pieces of 2h/3 each: 7/(478πg²) in 2-D, 1/(120πg³)
//! in 3-D with g = 2h/3, times (3−s)⁵ − 6(2−s)⁵ + 15(1−s)⁵ with s = r/g.

use crate::lanes::Real;
use std::f64::consts::PI;

/// h/g `[-]`.
const PIECES: f64 = 1.5;
/// The sum of the three fifth powers at s = 0 `[-]`.
const PEAK: f64 = 66.0;

/// W(0) h^D `[-]`.
pub(super) fn normalisation(dimension: usize) -> f64 {
    let unit = if dimension == 2 { 7.0 / (478.0 * PI) } else { 1.0 / (120.0 * PI) };
    PEAK * unit * PIECES.powi(dimension as i32)
}

#[inline(always)]
fn fourth_power<V: Real>(from: f64, s: V) -> V {
    let rest = (V::splat(from) - s).max(V::splat(0.0));
    let square = rest * rest;
    square * square
}

/// W over its value at 0.
#[inline(always)]
pub(super) fn value<V: Real>(q: V) -> V {
    let s = V::splat(PIECES) * q;
    let piece = |from: f64, factor: f64| fourth_power(from, s) * (V::splat(from) - s) * V::splat(factor / PEAK);
    piece(3.0, 1.0) + piece(2.0, -6.0) + piece(1.0, 15.0)
}

/// (1/q) dW/dq over W(0): for s < 1 the polynomial 24 − 24 s² + 10 s³, which needs no division, times a factor.
#[inline(always)]
pub(super) fn gradient_factor<V: Real>(q: V) -> V {
    let one = V::splat(1.0);
    let s = V::splat(PIECES) * q;
    let near = V::splat(24.0) + s * s * (V::splat(10.0) * s - V::splat(24.0));
    let far = (fourth_power(3.0, s) - V::splat(6.0) * fourth_power(2.0, s)) / s.max(one);
    (near.where_less(s, one) + (far - far.where_less(s, one))) * V::splat(-5.0 * PIECES * PIECES / PEAK)
}
