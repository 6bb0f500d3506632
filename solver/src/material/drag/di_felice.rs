//! Di Felice (1994), Int. J. Multiphase Flow 20, 153: K = ¾ C_d φ ρ_f |u_r| ε^{2−χ}/d, R = ε |u_r| d/ν, with
//! C_d = (0.63 + 4.8/√R)² (Dallavalle) and χ = 3.7 − 0.65 exp(−½ (1.5 − log₁₀ R)²).
//!
//! Computed as ¾ (C_d R) φ μ/d² · ε^{1−χ} with C_d R = (0.63 √R + 4.8)². Without slip C_d R = 23.04, 4 % below Stokes' 24,
//! and χ = 3.7; χ is least, 3.05, at R = 10^1.5 = 31.6.

use super::suspension::Suspension;

/// C_d R `[-]` at a Reynolds number `[-]`.
#[inline]
pub(super) fn drag_times_reynolds(reynolds: f64) -> f64 {
    let root = 0.63 * reynolds.sqrt() + 4.8;
    root * root
}

/// Exponent χ `[-]` at a Reynolds number `[-]`; log₁₀ 0 = −∞ gives its limit 3.7.
#[inline]
fn voidage_exponent(reynolds: f64) -> f64 {
    let distance = 1.5 - libm::log10(reynolds);
    3.7 - 0.65 * libm::exp(-0.5 * distance * distance)
}

/// K `[kg/(m³ s)]`.
#[inline]
pub(super) fn exchange_coefficient(suspension: &Suspension) -> f64 {
    let reynolds = suspension.superficial_reynolds();
    let hindrance = libm::pow(suspension.voidage(), 1.0 - voidage_exponent(reynolds));
    suspension.exchange(drag_times_reynolds(reynolds)) * hindrance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drag_coefficient_by_hand() {
        // R = 64: 0.63 · 8 + 4.8 = 9.84; R → ∞: C_d → 0.63² = 0.3969
        assert!((drag_times_reynolds(64.0) - 96.8256).abs() < 1e-12);
        assert!((drag_times_reynolds(0.0) - 23.04).abs() < 1e-14);
        assert!((drag_times_reynolds(1e14) / 1e14 - 0.3969).abs() < 1e-5);
    }

    #[test]
    fn exponent_has_its_limits_and_its_minimum() {
        assert_eq!(voidage_exponent(0.0), 3.7);
        assert!((voidage_exponent(1e-8) - 3.7).abs() < 1e-12);
        assert!((voidage_exponent(1e11) - 3.7).abs() < 1e-12);
        assert!((voidage_exponent(libm::pow(10.0, 1.5)) - 3.05).abs() < 1e-12);
        // one decade beside: 3.7 − 0.65 e^−½ = 3.7 − 0.394245
        assert!((voidage_exponent(libm::pow(10.0, 2.5)) - 3.305_755).abs() < 1e-6);
    }

    #[test]
    fn is_the_formula_with_the_drag_coefficient() {
        // R = 0.5 · 0.128 · 1e-3/1e-6 = 64 and χ = 3.08 …: ¾ C_d · 0.5 · 1000 · 0.128 · 0.5^{2−χ}/1e-3
        let suspension = Suspension {
            solid_fraction: 0.5,
            slip: 0.128,
            grain_diameter: 1e-3,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
        };
        let exponent = 3.7 - 0.65 * (-0.5 * (1.5 - 64f64.log10()).powi(2)).exp();
        let exact = 48_000.0 * (96.8256 / 64.0) * 0.5f64.powf(2.0 - exponent);
        assert!((exchange_coefficient(&suspension) / exact - 1.0).abs() < 1e-12);
    }
}
