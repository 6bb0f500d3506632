//! The paper's viscous force: Cleary's pairwise viscosity (11) and Schwaiger's correction (13)(14).
//!
//! The continuum limit of (11) carries a bulk term η∇·v, so nearly rigid material cannot decompress; use the single
//! divergence for anything with a yield.

use crate::lanes::Lanes;
use crate::lanes::algebra::{difference, matrix_product, product, scaled};

/// 4 (d + 2) of (11), over the harmonic mean of the viscosities: 16 in the plane.
const fn prefactor(dimension: usize) -> f64 {
    2.0 * 2.0 * (dimension as f64 + 2.0)
}

/// (11) of a flow pair over r `[N/m⁴]`. `harmonic` is η_a η_b/((η_a + η_b)(r² + δ²)) `[Pa·s/m²]`, `approach` r_ab·v_ab
/// `[m²/s]`.
#[inline(always)]
pub fn pair_factor<V: Lanes, const D: usize>(weight: V, harmonic: V, approach: V) -> V {
    weight * V::splat(const { prefactor(D) }) * harmonic * approach
}

/// (11) of a wall partner over r `[N/m⁴]`: it carries the viscosity of the flow, so the harmonic mean is that of a.
/// `regular` is r² + δ² `[m²]`.
#[inline(always)]
pub fn wall_factor<V: Lanes, const D: usize>(weight: V, viscosity_a: V, approach: V, regular: V) -> V {
    weight * V::splat(const { prefactor(D) }) * V::splat(0.5) * viscosity_a * approach / regular
}

/// (13) `[N/m³]` from (11), with the gradient sum Σ V (μ_b + μ_a)(v_b − v_a) ⊗ ∇W, the sum Σ V ∇W and the correction L,
/// the blended inverse of the moment matrix Γ of (14): tr(L)/d times what is left of (11) without [∇(μv) − v∇μ +
/// μ∇v]·Σ V ∇W.
#[inline(always)]
pub fn corrected<V: Lanes, const D: usize>(
    viscous: &[V; D],
    gradient: &[[V; D]; D],
    deficit: &[V; D],
    correction: &[[V; D]; D],
) -> [V; D] {
    let excess = product(&matrix_product(gradient, correction), deficit);
    let mut scale = correction[0][0];
    for i in 1..D {
        scale = scale + correction[i][i];
    }
    scaled(scale * V::splat(1.0 / D as f64), &difference(viscous, &excess))
}
