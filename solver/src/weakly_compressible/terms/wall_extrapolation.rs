//! Extrapolation from the flow to a wall particle: recipe step 3 (default) or Adami's pressure (22) with the density
//! (23) (the paper), term by term of the averages over flow neighbours with the weights V_f W_wf.

use crate::lanes::algebra::{accumulate_outer, dot, matrix_product, zero_tensor};
use crate::lanes::{Lanes, Real};

/// Below this part of a full neighbourhood Σ V W a wall particle counts as dry `[-]`.
pub const DRY: f64 = 1e-12;
/// Nearest distance at which the velocity fit weighs a flow particle, in spacings `[-]`.
pub const NEAREST: f64 = 0.25;

/// 1/Σ V W, or 0 for a dry wall, which carries nothing.
#[inline(always)]
pub fn wet_inverse<V: Lanes>(weights: V) -> V {
    V::splat(1.0).where_less(V::splat(DRY), weights) / weights.max(V::splat(DRY))
}

/// Part of a spacing's square that keeps the fit of a line to a single row of particles from a slope of its own `[-]`.
const RIDGE: f64 = 0.1;

/// The divisor of a line's slope, M_0 M_2 − M_1² with a ridge, from the moments Σ V W dᵏ of the distances to the surface.
#[inline(always)]
pub fn spread<V: Lanes>(weights: V, first_moment: V, moment: V, spacing: f64) -> V {
    let ridge = V::splat(RIDGE * spacing * spacing) * weights * weights;
    (weights * moment - first_moment * first_moment + ridge).max(V::splat(f64::MIN_POSITIVE))
}

/// Hydrostatic growth of the pressure from a flow particle to the wall along its normal `[Pa]`: ρ g_n r_n with the part
/// min(1, p/p_full). A layer of half a spacing's weight, `full_increment` `[Pa]`, carries the full growth, a weightless
/// one none: without this factor particles without pressure ride on a frictionless cushion.
#[inline(always)]
pub fn growth_along_normal<V: Lanes>(pressure: V, density: V, gravity: V, distance: V, full_increment: V) -> V {
    let part = (pressure / full_increment).min(V::splat(1.0)).max(V::splat(0.0));
    density * gravity * distance * part
}

/// Hydrostatic growth of (22) `[Pa]`, with the sign of growth along gravity.
#[inline(always)]
pub fn growth_along_gravity<V: Lanes, const D: usize>(density: V, r: &[V; D], gravity: &[V; D]) -> V {
    density * dot(r, gravity)
}

/// R s R: a smooth wall mirrors the stress, so that what it carries along its surface is that of the flow with the other
/// sign; a rough one (`smoothness` 0) has that of the flow to the last bit.
#[inline(always)]
pub fn mirrored<V: Real, const D: usize>(stress: &[[V; D]; D], smoothness: V, normal: &[V; D]) -> [[V; D]; D] {
    let reflection = reflection(smoothness, normal);
    matrix_product(&matrix_product(&reflection, stress), &reflection)
}

/// R = I − 2 k n nᵀ, which mirrors at the plane with the normal n for k = 1; for k = 0 it is the identity to the last
/// bit, and so R s R is s.
#[inline(always)]
fn reflection<V: Real, const D: usize>(k: V, normal: &[V; D]) -> [[V; D]; D] {
    let mut reflection = zero_tensor::<V, D>();
    for i in 0..D {
        reflection[i][i] = V::splat(1.0);
    }
    accumulate_outer(&mut reflection, V::splat(-2.0) * k, normal, normal);
    reflection
}

#[cfg(test)]
mod tests {
    const STRESS: [[f64; 3]; 3] = [[0.3, -1.7, 0.9], [-1.7, 2.1, 0.1], [0.9, 0.1, -2.4]];
    const NORMAL: [f64; 3] = [2.0 / 3.0, 1.0 / 3.0, -2.0 / 3.0];
    /// Across the normal.
    const ALONG: [f64; 3] = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];

    fn mirrored(smoothness: f64) -> [[f64; 3]; 3] {
        super::mirrored(&STRESS, smoothness, &NORMAL)
    }

    #[test]
    fn a_smooth_wall_turns_the_traction_along_its_surface_around_and_nothing_else() {
        let traction = |stress: &[[f64; 3]; 3], direction: &[f64; 3]| -> f64 {
            (0..3).map(|i| direction[i] * (0..3).map(|j| stress[i][j] * NORMAL[j]).sum::<f64>()).sum()
        };
        let smooth = mirrored(1.0);
        assert!(traction(&STRESS, &ALONG).abs() > 0.1);
        assert!((traction(&smooth, &ALONG) + traction(&STRESS, &ALONG)).abs() < 1e-14);
        assert!((traction(&smooth, &NORMAL) - traction(&STRESS, &NORMAL)).abs() < 1e-14);
    }

    #[test]
    fn a_rough_wall_has_the_stress_of_the_flow_to_the_last_bit() {
        assert_eq!(mirrored(0.0).map(|row| row.map(f64::to_bits)), STRESS.map(|row| row.map(f64::to_bits)));
    }
}
