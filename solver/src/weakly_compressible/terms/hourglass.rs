//! Velocity hourglass control: viscosity on the part of a pair's velocity difference that the velocity gradient
//! does not explain, so that linear velocity fields feel nothing.
//!
//! a_a = Σ_b 2 ν_ab [2 m_b/(ρ_a + ρ_b)] F [v_ab − ½(∇v_a + ∇v_b) r_ab], ν_ab = k h ½(√(p_a/ρ0) + √(p_b/ρ0)):
//! it vanishes with the pressure, so that a loose particle flies freely. Grains get a part of it ([`share`]). Not in the paper;
//! antisymmetric in a and b.

use crate::lanes::Real;
use crate::lanes::algebra::{difference, dot, product, scaled, sum_of};

/// √(p/ρ0) `[m/s]` of a pressure `[Pa]`, from 1/ρ0 `[m³/kg]`.
#[inline(always)]
#[must_use]
pub fn pressure_speed(pressure: f64, inverse_density: f64) -> f64 {
    (pressure.max(0.0) * inverse_density).sqrt()
}

/// Least part of the coefficient that grains get `[-]`.
const LEAST: f64 = 0.375;
/// γ̇ Δ/√(p/ρ0) over which grains at rest pass from all to the least part `[-]`.
const STILL: (f64, f64) = (0.005, 0.02);
/// γ̇ Δ/√(p/ρ0) over which sheared grains pass from the least part to all `[-]`.
const FAST: (f64, f64) = (0.1, 0.3);

/// Part of the coefficient `[-]` for grains without cohesion or a length of their own, from γ̇ Δ and √(p/ρ0) `[m/s]`.
///
/// The control makes the direction of the strain rate differ from particle to particle, so that a layer of 40 rows runs up to 3.7 % too
/// fast: sheared grains get little of it. Where the shear is fast against the pressure, little of it lets a layer sink; grains nearly at
/// rest need all of it against their noise.
#[inline(always)]
#[must_use]
pub fn share(shear_speed: f64, pressure_speed: f64) -> f64 {
    let ramp = |(from, to): (f64, f64)| {
        let width = ((to - from) * pressure_speed).max(f64::MIN_POSITIVE);
        ((shear_speed - from * pressure_speed) / width).clamp(0.0, 1.0)
    };
    LEAST + (1.0 - LEAST) * ramp(FAST).max(1.0 - ramp(STILL))
}

/// 2 ν_ab `[m²/s]`: `strength` is k h `[m]`, `speed_sum` √(p_a/ρ0) + √(p_b/ρ0) `[m/s]`.
#[inline(always)]
pub fn twice_viscosity<V: Real>(strength: f64, speed_sum: V) -> V {
    speed_sum * V::splat(strength)
}

/// The unexplained velocity difference [v_ab − ½(∇v_a + ∇v_b) r_ab] `[m/s]`.
#[inline(always)]
pub fn unexplained<V: Real, const D: usize>(
    velocity_difference: &[V; D],
    gradient_a: &[[V; D]; D],
    gradient_b: &[[V; D]; D],
    r: &[V; D],
) -> [V; D] {
    let half = V::splat(0.5);
    let mut lanes = *velocity_difference;
    for i in 0..D {
        lanes[i] = velocity_difference[i] - half * dot(&sum_of(&gradient_a[i], &gradient_b[i]), r);
    }
    lanes
}

/// The part of a vector along r `[unit of the vector]`; `regular` is r² `[m²]`, kept from zero.
#[inline(always)]
pub fn along_pair<V: Real, const D: usize>(vector: &[V; D], r: &[V; D], regular: V) -> [V; D] {
    scaled(dot(vector, r) / regular, r)
}

/// The explained part of r·v_ab, r·½(∇v_a + ∇v_b) r `[m²/s]`, from the coefficients of r_i r_j in ½ r·∇v r, i ≤ j.
#[inline(always)]
pub fn explained_along<V: Real, const D: usize>(half_a: &[[V; D]; D], half_b: &[[V; D]; D], r: &[V; D]) -> V {
    let mut explained = (half_a[0][0] + half_b[0][0]) * (r[0] * r[0]);
    for i in 1..D {
        explained = explained + (half_a[i][i] + half_b[i][i]) * (r[i] * r[i]);
    }
    for i in 0..D {
        for j in i + 1..D {
            explained = explained + (half_a[i][j] + half_b[i][j]) * (r[i] * r[j]);
        }
    }
    explained
}

/// The unexplained velocity difference at a wall along its normal `[m/s]`: `slip` is β (v_a − v_wall) `[m/s]`, and the wall's gradient
/// is that of a. Along a rough wall it would act as a friction of the bed on curved flow.
#[inline(always)]
pub fn unexplained_at_wall<V: Real, const D: usize>(
    slip: &[V; D],
    gradient_a: &[[V; D]; D],
    r: &[V; D],
    normal: &[V; D],
) -> [V; D] {
    let mut unexplained = difference(slip, &product(gradient_a, r));
    let along_normal = dot(&unexplained, normal);
    for i in 0..D {
        // this rounding is that of stored results
        unexplained[i] = unexplained[i] + (along_normal * normal[i] - unexplained[i]);
    }
    unexplained
}
