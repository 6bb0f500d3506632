//! One divergence operator for the whole stress σ = s − pI.
//!
//! ρ_a a_a = Σ V_b F (σ_a E_a + σ_b E_b) r_ab, the same weight for stress and pressure, with E_w = E_a and
//! σ_w = s_w − p_w I for a wall partner. The paper takes (10) for the pressure and (11) for the viscous part: two
//! operators whose errors do not cancel (model notes: 10 % in Bagnold's profile against 0.4 %).

use crate::lanes::Real;
use crate::lanes::algebra::{dot, product, sum_of};

/// (σ_a E_a + σ_b E_b) r `[Pa m]` of a flow pair, from the corrected stresses σE of both.
#[inline(always)]
pub fn traction<V: Real, const D: usize>(corrected_a: &[[V; D]; D], corrected_b: &[[V; D]; D], r: &[V; D]) -> [V; D] {
    let mut lanes = *r;
    for i in 0..D {
        lanes[i] = dot(&sum_of(&corrected_a[i], &corrected_b[i]), r);
    }
    lanes
}

/// (σ_a E_a + σ_w E_a) r `[Pa m]` with a wall partner of stress σ_w; `force_correction` is E_a `[-]`.
#[inline(always)]
pub fn wall_traction<V: Real, const D: usize>(
    corrected_a: &[[V; D]; D],
    wall_stress: &[[V; D]; D],
    force_correction: &[[V; D]; D],
    r: &[V; D],
) -> [V; D] {
    sum_of(&product(corrected_a, r), &product(wall_stress, &product(force_correction, r)))
}
