//! Ergun (1952): K = 150 φ² μ/(ε d²) + 1.75 φ ρ_f |u_r|/d of a packed bed.
//!
//! A law of beds: without neighbours it has no drag (K/φ → 1.75 ρ_f |u_r|/d is no sphere's), hence no drag coefficient.
//! In a bed at rest the fluid's balance −ε dp/dx = K u with the superficial velocity U = ε u gives Ergun's pressure drop
//! 150 φ² μ U/(ε³ d²) + 1.75 φ ρ_f U²/(ε³ d).

use super::suspension::Suspension;

/// K `[kg/(m³ s)]`.
#[inline]
pub(super) fn exchange_coefficient(suspension: &Suspension) -> f64 {
    let &Suspension { solid_fraction, slip, grain_diameter, fluid_density, .. } = suspension;
    let viscous = 150.0 * solid_fraction * solid_fraction * suspension.viscous_exchange() / suspension.voidage();
    viscous + 1.75 * solid_fraction * fluid_density * slip / grain_diameter
}

#[cfg(test)]
mod tests {
    use super::*;

    const BED: Suspension = Suspension {
        solid_fraction: 0.6,
        slip: 0.01,
        grain_diameter: 1e-3,
        fluid_density: 1000.0,
        kinematic_viscosity: 1e-6,
    };

    #[test]
    fn gives_the_packed_bed_by_hand() {
        // 150 · 0.36 · 1e-3/(0.4 · 1e-6) = 135 000 and 1.75 · 0.6 · 1000 · 0.01/1e-3 = 10 500
        assert!((exchange_coefficient(&BED) - 145_500.0).abs() < 1e-9);
        assert!((exchange_coefficient(&Suspension { slip: 0.0, ..BED }) - 135_000.0).abs() < 1e-9);
    }

    #[test]
    fn gives_the_pressure_drop_of_a_bed() {
        // U = 4 mm/s: 150 · 0.36 · 1e-3 · 4e-3/(0.064 · 1e-6) = 3375 Pa/m, 1.75 · 0.6 · 1000 · 1.6e-5/(0.064 · 1e-3) = 262.5 Pa/m
        let gradient = exchange_coefficient(&BED) * BED.slip / BED.voidage();
        assert!((gradient - 3637.5).abs() < 1e-9);
    }
}
