//! The inverse shear rate 1/|γ̇| of a yield term made finite at rest: by an exponential (Papanastasiou 1987, J. Rheol. 31) or
//! by a root.

/// (1 − exp(−|γ̇|/γ_r))/|γ̇| `[s]` for a shear rate |γ̇| and a regularisation rate γ_r, both `[1/s]`.
///
/// Tends to 1/|γ̇| for |γ̇| ≫ γ_r and to 1/γ_r at rest; falls monotonically in between.
#[inline]
pub(super) fn inverse_shear_rate(shear_rate: f64, regularisation_rate: f64) -> f64 {
    let ratio = shear_rate / regularisation_rate;
    if ratio == 0.0 {
        return 1.0 / regularisation_rate;
    }
    // 1 − exp(−x) loses all digits below x = 1e-16; expm1 keeps them.
    -libm::expm1(-ratio) / ratio / regularisation_rate
}

/// The same function by one division instead of two, and 1/γ_r below 10⁻⁶ γ_r, which is 5·10⁻⁷ more at most.
///
/// It stands beside [`inverse_shear_rate`] for its rounding alone: a bed of single grains is chaotic, and the last digit of
/// its viscosities decides which grains jump in a run whose values are accepted as they are.
#[inline]
pub(super) fn inverse_shear_rate_by_one_division(shear_rate: f64, regularisation_rate: f64) -> f64 {
    let ratio = shear_rate / regularisation_rate;
    if ratio < 1e-6 { 1.0 / regularisation_rate } else { -libm::expm1(-ratio) / shear_rate }
}

/// √(|γ̇|² + γ_r²) `[1/s]`, whose inverse takes the place of 1/|γ̇|: below it by ½ (γ_r/|γ̇|)² in flow, where the exponential
/// has no error left, but smooth and cheap.
#[inline]
pub(super) fn root_shear_rate(shear_rate: f64, regularisation_rate: f64) -> f64 {
    (shear_rate * shear_rate + regularisation_rate * regularisation_rate).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tends_to_the_inverse_of_the_larger_rate() {
        assert!((inverse_shear_rate(100.0, 0.01) * 100.0 - 1.0).abs() < 1e-15);
        assert!((inverse_shear_rate(0.0, 0.01) * 0.01 - 1.0).abs() < 1e-15);
        assert!((inverse_shear_rate(5e-324, 0.01) * 0.01 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn small_rates_follow_the_taylor_series() {
        for x in [1e-18, 1e-12, 1e-8, 1e-4] {
            let series = 1.0 - x / 2.0 + x * x / 6.0 - x * x * x / 24.0;
            assert!((inverse_shear_rate(0.01 * x, 0.01) * 0.01 - series).abs() < 4e-16, "x = {x}");
        }
    }

    #[test]
    fn both_roundings_are_one_function() {
        for k in -80..80 {
            let rate = libm::pow(1.3, f64::from(k));
            let (one, other) = (inverse_shear_rate(rate, 0.01), inverse_shear_rate_by_one_division(rate, 0.01));
            let tolerance = if rate < 1e-8 { 5e-7 } else { 5e-16 };
            assert!((other / one - 1.0).abs() <= tolerance, "{rate}: {one} and {other}");
        }
        assert_eq!(inverse_shear_rate_by_one_division(0.0, 0.01), 1.0 / 0.01);
    }

    #[test]
    fn falls_with_the_shear_rate() {
        let mut previous = inverse_shear_rate(0.0, 0.01);
        for k in 0..120 {
            let value = inverse_shear_rate(1e-8 * libm::pow(1.2, f64::from(k)), 0.01);
            assert!(value <= previous && value > 0.0);
            previous = value;
        }
    }
}
