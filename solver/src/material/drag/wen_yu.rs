//! Wen & Yu (1966): K = ¾ C_d φ ρ_f |u_r| ε^−1.65/d, C_d of Schiller–Naumann at R = ε |u_r| d/ν.
//!
//! Computed as ¾ (C_d R) φ μ/d² · ε^−2.65, whose limit without slip is 18 φ μ ε^−2.65/d². With the balance
//! φ ε (ρ_s − ρ_f) g = K |u_r| grains in Stokes' regime settle at ε |u_r| = u_t ε^4.65: Richardson and Zaki's exponent.

use super::{Suspension, schiller_naumann};

/// K `[kg/(m³ s)]`.
#[inline]
pub(super) fn exchange_coefficient(suspension: &Suspension) -> f64 {
    let alone = schiller_naumann::drag_times_reynolds(suspension.superficial_reynolds());
    suspension.exchange(alone) * libm::pow(suspension.voidage(), -2.65)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_the_formula_with_the_drag_coefficient() {
        let suspension = Suspension {
            solid_fraction: 0.3,
            slip: 0.05,
            grain_diameter: 2e-3,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
        };
        // R = 0.7 · 0.05 · 2e-3/1e-6 = 70; ¾ · C_d · 0.3 · 1000 · 0.05 · 0.7^−1.65/2e-3
        let drag_coefficient = 24.0 / 70.0 * (1.0 + 0.15 * 70f64.powf(0.687));
        let exact = 5625.0 * drag_coefficient * 0.7f64.powf(-1.65);
        assert!((exchange_coefficient(&suspension) / exact - 1.0).abs() < 1e-12);
    }
}
