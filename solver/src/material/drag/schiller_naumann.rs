//! Schiller & Naumann (1933): C_d = 24/R (1 + 0.15 R^0.687) of a sphere alone, 0.44 above R = 1000.
//!
//! R → 0 is Stokes' drag, C_d R = 24. At R = 1000 the fit gives 0.4383, 0.4 % below the constant.

/// Reynolds number `[-]` above which the drag coefficient is constant.
const NEWTON_START: f64 = 1000.0;
/// The constant drag coefficient `[-]` of Newton's regime.
const NEWTON: f64 = 0.44;

/// C_d R `[-]` at a Reynolds number `[-]`: 24 (1 + 0.15 R^0.687).
#[inline]
pub(super) fn drag_times_reynolds(reynolds: f64) -> f64 {
    if reynolds > NEWTON_START { NEWTON * reynolds } else { 24.0 * (1.0 + 0.15 * libm::pow(reynolds, 0.687)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gives_values_computed_by_hand() {
        assert_eq!(drag_times_reynolds(0.0), 24.0);
        assert!((drag_times_reynolds(1.0) - 27.6).abs() < 1e-14);
        // 100^0.687 = 10^1.374 = 23.65920
        assert!((drag_times_reynolds(100.0) - 109.173_1).abs() < 1e-3);
        assert_eq!(drag_times_reynolds(20_000.0), 8800.0);
    }

    #[test]
    fn meets_newtons_constant() {
        // 1000^0.687 = 10^2.061 = 115.0800: 0.024 (1 + 17.2620) = 0.438288
        let fitted = drag_times_reynolds(1000.0) / 1000.0;
        assert!((fitted - 0.438_288).abs() < 1e-6);
        assert!((fitted / 0.44 - 1.0).abs() < 0.004);
    }
}
