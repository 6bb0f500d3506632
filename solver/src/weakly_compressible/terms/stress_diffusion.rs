//! Diffusion of the stress ratio s/p among yielding particles.
//!
//! Local μ(I) is ill-posed at small inertial numbers (Barker et al. 2015): below the friction angle of a thick layer a
//! wave as long as the layer grows, and its swings of the pressure let the bulk creep for ever. Each step therefore
//! adds, before the return mapping,
//!
//! Δs_a = Δt δ c h Σ_b V_b F 4 w_a w_b (s_a p_b − s_b p_a)/(p_a + p_b),
//!
//! near to Δt δ c h p ∇²(s/p), with w 1 where a particle yields and 0 where it is elastic or without pressure. It
//! vanishes for a uniform stress ratio, such as Bagnold's flow, at walls and in a heap at rest; antisymmetric up to V.
//! At rest the waves grow with C = μ_s² (Barker et al. 2015): δ of a steep law counts by 1 + 16 √(μ_s² − 0.35), at most 6.
//! Not in the paper.

use crate::lanes::Real;

/// w `[-]`: what of a particle yields, from its elasticity and its pressure `[Pa]`.
#[inline(always)]
pub fn yielding<R: Real>(elasticity: R, pressure: R) -> R {
    (R::splat(1.0) - elasticity).where_less(R::splat(0.0), pressure)
}

/// C = μ_s² `[-]` up to which δ is enough, by layers of 40 rows.
const GENTLE: f64 = 0.35;
/// Growth of the factor of δ with the root of what C is above it `[-]`: by trials μ_s = 0.6 and 0.7 need 0.2 and 0.4 over periods of 12
/// columns, and μ_s = 0.644 needs 0.3, over 48 columns 0.5.
const GROWTH: f64 = 16.0;
/// Largest factor of δ `[-]`: 10 disturbs the start.
const LARGEST: f64 = 6.0;

/// Static friction `[-]` up to which that holds layers from rest within 3 % of their law; those of 0.8 flow 5 % too fast.
pub const STEEPEST: f64 = 0.72;

/// Factor of δ `[-]` for a law of a static friction `[-]`.
#[must_use]
pub fn steepness(static_friction: f64) -> f64 {
    let above = (static_friction * static_friction - GENTLE).max(0.0);
    (1.0 + GROWTH * above.sqrt()).min(LARGEST)
}

/// Least sum of two pressures that divides `[Pa]`: a number of single precision too.
const LEAST_PRESSURE: f64 = 1e-30;

/// 4 w_a w_b/(p_a + p_b) `[1/Pa]`, the factor of s_a p_b − s_b p_a; 0 without pressure.
#[inline(always)]
pub fn pair_factor<V: Real>(yielding_a: V, yielding_b: V, pressure_sum: V) -> V {
    V::splat(4.0) * yielding_a * yielding_b / pressure_sum.max(V::splat(LEAST_PRESSURE))
}

/// Adds f (s_a p_b − s_b p_a) to the upper triangle of a sum, without the last entry of the diagonal.
#[inline(always)]
pub fn accumulate_bracket<V: Real, const D: usize>(
    sum: &mut [[V; D]; D],
    factor: V,
    stress_a: (&[[V; D]; D], V),
    stress_b: (&[[V; D]; D], V),
) {
    let (from_a, from_b) = (factor * stress_b.1, factor * stress_a.1);
    for i in 0..D - 1 {
        for j in i..D {
            sum[i][j] = sum[i][j] + (from_a * stress_a.0[i][j] - from_b * stress_b.0[i][j]);
        }
    }
}

/// Adds f s_b to the upper triangle of a sum, without the last entry of the diagonal. With Σ f p_b the brackets are made of it at the
/// end: (Σ f p_b) s_a − p_a Σ f s_b, the form of single precision.
#[inline(always)]
pub fn accumulate_stress<V: Real, const D: usize>(sum: &mut [[V; D]; D], factor: V, stress: &[[V; D]; D]) {
    for i in 0..D - 1 {
        for j in i..D {
            sum[i][j] = sum[i][j] + factor * stress[i][j];
        }
    }
}

/// Fills what [`accumulate_bracket`] leaves out: the lower triangle, and the last entry of a tensor without trace.
#[inline(always)]
pub fn complete<V: Real, const D: usize>(deviator: &mut [[V; D]; D]) {
    let mut rest = V::splat(0.0);
    for i in 0..D - 1 {
        rest = rest - deviator[i][i];
        for j in i + 1..D {
            deviator[j][i] = deviator[i][j];
        }
    }
    deviator[D - 1][D - 1] = rest;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contribution of particle b to the diffusion at particle a.
    fn bracket(a: (&[[f64; 3]; 3], f64), b: (&[[f64; 3]; 3], f64)) -> [[f64; 3]; 3] {
        let mut sum = [[0.0; 3]; 3];
        accumulate_bracket(&mut sum, pair_factor(1.0, 1.0, a.1 + b.1), a, b);
        complete(&mut sum);
        sum
    }

    const STRESS: [[f64; 3]; 3] = [[0.5, -1.75, 1.0], [-1.75, 2.0, 0.25], [1.0, 0.25, -2.5]];
    const OTHER: [[f64; 3]; 3] = [[-1.0, 0.5, 0.0], [0.5, 0.75, -2.0], [0.0, -2.0, 0.25]];

    #[test]
    fn a_steep_law_has_more_diffusion_and_the_sand_of_columns_has_not() {
        assert_eq!([0.0, 0.382, 0.589].map(steepness), [1.0; 3]);
        assert!((steepness(0.644) - 5.0712).abs() < 1e-3 && steepness(0.6) > 2.5, "{}", steepness(0.644));
        assert_eq!([1.0, 5.0].map(steepness), [LARGEST; 2]);
    }

    #[test]
    fn a_uniform_stress_ratio_does_not_diffuse() {
        let doubled = STRESS.map(|row| row.map(|component| 2.0 * component));
        assert_eq!(bracket((&STRESS, 8.0), (&doubled, 16.0)), [[0.0; 3]; 3]);
    }

    #[test]
    fn pair_exchange_is_antisymmetric_and_traceless() {
        let (given, taken) = (bracket((&STRESS, 8.0), (&OTHER, 2.0)), bracket((&OTHER, 2.0), (&STRESS, 8.0)));
        for i in 0..3 {
            for j in 0..3 {
                assert_eq!(given[i][j], -taken[i][j]);
                assert_eq!(given[i][j], given[j][i]);
            }
        }
        assert!(given[0][1] != 0.0 && given[0][0] + given[1][1] + given[2][2] == 0.0);
    }

    #[test]
    fn only_what_yields_under_pressure_takes_part() {
        assert_eq!((yielding(0.0, 5.0), yielding(1.0, 5.0), yielding(0.0, 0.0)), (1.0, 0.0, 0.0));
        assert_eq!(pair_factor(0.0, 0.0, 0.0), 0.0);
        let rate = 1.0 / 8.0 * 4.0;
        assert_eq!(pair_factor(1.0, 1.0, 8.0), rate);
    }
}
