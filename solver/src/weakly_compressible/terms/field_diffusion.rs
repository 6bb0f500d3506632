//! Diffusion of a field that a law keeps of each particle, D ∇²f_a = D Σ_b w_ab (f_b − f_a) with w_ab = −2 V_b F ≥ 0.
//!
//! No moment matrix divides this: without neighbours there is no flux, so that a free surface lets nothing through, and a field
//! that is not negative stays so. Sums over flow neighbours are made by the pass of continuity; here is what boundaries add to
//! the diagonal.
//!
//! A rough wall where f vanishes: its particle at a depth d_w has −f_a d_w/d_a by the line through zero at the surface, so
//! that the pair takes w (1 + d_w/d_a) f_a, with a bound for particles that nearly touch the wall.
//!
//! A free surface where f vanishes: what is missing of the lattice's Σ w is taken from f_a, times a factor that was fitted so that
//! the first mode of a layer of 20 rows decays as it should, to 0.2 % of its wave number on lattices and displaced by a tenth of a
//! spacing, in the plane and in space alike (3.5 is 0.4 % too weak, 5 is 0.5 % too strong). It is fitted for the recipe's
//! kernel and smoothing ratio. Only particles whose neighbourhood is open count, by the smallest eigenvalue of their moment matrix: the
//! bulk's disorder would be a sink.

use crate::lanes::Real;
use crate::lanes::algebra::dot;

/// Largest 1 + d_w/d_a `[-]`.
const STEEPEST: f64 = 6.0;
/// Nearest distance to a wall that is divided by, in spacings `[-]`.
const NEAREST: f64 = 0.05;
/// Smallest eigenvalue of the moment matrix from which on a neighbourhood is closed `[-]`.
pub const CLOSED: f64 = 0.85;
/// Range of eigenvalues below it over which it opens `[-]`.
const OPENING: f64 = 0.1;

/// Strength of the sink at a surface over the missing weight `[-]`.
const SURFACE_STRENGTH: f64 = 4.0;

/// 1 + d_w/d_a of a pair with a wall particle at a depth `[m]` behind its surface, whose normal is given; 0 for a smooth wall.
#[inline(always)]
pub fn wall_factor<V: Real, const D: usize>(r: &[V; D], normal: &[V; D], depth: V, smoothness: V, spacing: f64) -> V {
    let above = (dot(r, normal) - depth).max(V::splat(NEAREST * spacing));
    let factor = (V::splat(1.0) + depth / above).min(V::splat(STEEPEST));
    factor * (V::splat(1.0) - smoothness)
}

/// Sink at a free surface `[1/m²]`. It follows from the Σ w of a particle and that of a lattice, and the smallest
/// eigenvalue of its moment matrix.
#[inline(always)]
pub fn surface_sink<V: Real>(weights: V, full_weight: f64, eigenvalue: V) -> V {
    let zero = V::splat(0.0);
    let missing = (V::splat(full_weight) - weights).max(zero);
    let open = ((V::splat(CLOSED) - eigenvalue) * V::splat(1.0 / OPENING)).max(zero).min(V::splat(1.0));
    V::splat(SURFACE_STRENGTH) * missing * open
}

/// Harmonic mean of two conductivities, as two layers in a row have it.
#[inline(always)]
pub fn mean_conductivity<V: Real>(a: V, b: V) -> V {
    let product = a * b;
    (product + product) / (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_zero_at_the_wall_loses_what_it_should() {
        // f = d: the wall particle has −d_w, and the pair takes f_a − f_w = d_a + d_w
        let factor = wall_factor(&[0.0, 0.3], &[0.0, 1.0], 0.1, 0.0, 0.2);
        assert!((factor * 0.2 - 0.3).abs() < 1e-15);
        assert_eq!(wall_factor(&[0.0, 0.3], &[0.0, 1.0], 0.1, 1.0, 0.2), 0.0);
        assert_eq!(wall_factor(&[0.0, 0.1], &[0.0, 1.0], 0.1, 0.0, 0.2), STEEPEST);
    }

    #[test]
    fn only_what_is_open_is_a_sink() {
        let sink = |weights, eigenvalue| surface_sink(weights, 8.0, eigenvalue);
        assert_eq!((sink(8.0, 0.5), sink(9.0, 0.5), sink(4.0, CLOSED)), (0.0, 0.0, 0.0));
        assert_eq!(sink(4.0, 0.5), 4.0 * SURFACE_STRENGTH);
        assert!(sink(4.0, 0.8) < sink(4.0, 0.78));
    }
}
