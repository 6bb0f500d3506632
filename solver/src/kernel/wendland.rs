//! Wendland C2 (Wendland 1995): 7/(4πh²) in 2-D, 21/(16πh³) in 3-D, times (1 − q/2)⁴ (2q + 1).

use crate::lanes::Real;
use std::f64::consts::PI;

/// W(0) h^D `[-]`.
pub(super) fn normalisation(dimension: usize) -> f64 {
    if dimension == 2 { 7.0 / (4.0 * PI) } else { 21.0 / (16.0 * PI) }
}

/// W over its value at 0.
#[inline(always)]
pub(super) fn value<V: Real>(q: V) -> V {
    let t = (V::splat(1.0) - V::splat(0.5) * q).max(V::splat(0.0));
    let t2 = t * t;
    t2 * t2 * (V::splat(2.0) * q + V::splat(1.0))
}

/// (1/q) dW/dq over W(0), −5 (1 − q/2)³ without a division, times a scale, at q/2.
#[inline(always)]
pub(super) fn gradient_weight<V: Real>(half_q: V, scale: V) -> V {
    let t = (V::splat(1.0) - half_q).max(V::splat(0.0));
    (t * t) * (t * (scale * V::splat(-5.0)))
}
