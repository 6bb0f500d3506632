//! Settling of a uniform suspension: the slip at which drag carries the weight of the grains in the fluid,
//! φ (1 − φ)(ρ_s − ρ_f) g = K |u_r|, and the velocity (1 − φ) |u_r| at which grains without a net flux then sink.

use super::DragLaw;

/// Halvings that exhaust the digits of the slip.
const HALVINGS: usize = 60;

impl DragLaw {
    /// Settling velocity (1 − φ) |u_r| `[m/s]` of a suspension of a solid fraction φ `[-]` in (0, 1), whose grains weigh
    /// `submerged_weight` (ρ_s − ρ_f) g > 0 `[N/m³]` in the fluid. The other arguments are those of
    /// [`DragLaw::exchange_coefficient`].
    #[must_use]
    pub fn settling_velocity(
        self,
        solid_fraction: f64,
        submerged_weight: f64,
        grain_diameter: f64,
        fluid_density: f64,
        kinematic_viscosity: f64,
    ) -> f64 {
        let weight = solid_fraction * (1.0 - solid_fraction) * submerged_weight;
        let sinks_faster = |slip: f64| {
            let exchange =
                self.exchange_coefficient(solid_fraction, slip, grain_diameter, fluid_density, kinematic_viscosity);
            exchange * slip < weight
        };
        // drag rises with the slip: a power of two above the root, then halvings
        let mut high = kinematic_viscosity / grain_diameter;
        while sinks_faster(high) {
            high *= 2.0;
        }
        let mut low = 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if sinks_faster(middle) { low = middle } else { high = middle }
        }
        (1.0 - solid_fraction) * high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_grains_settle_by_stokes_and_large_ones_by_newton() {
        // (ρ_s − ρ_f) g d²/(18 μ) of 1 μm, and √(4 (s − 1) g d/(3 · 0.44)) of 50 mm
        let small = DragLaw::WenYu.settling_velocity(1e-9, 16_186.5, 1e-6, 1000.0, 1e-6);
        let stokes = 16_186.5 * 1e-12 / 18e-3;
        assert!((small / stokes - 1.0).abs() < 1e-3, "{small} for {stokes} m/s");
        let large = DragLaw::WenYu.settling_velocity(1e-9, 16_186.5, 0.05, 1000.0, 1e-6);
        let newton = (4.0 * 16.1865 * 0.05 / (3.0 * 0.44_f64)).sqrt();
        assert!((large / newton - 1.0).abs() < 1e-3, "{large} for {newton} m/s");
    }

    #[test]
    fn the_drag_of_the_slip_is_the_weight() {
        for law in DragLaw::ALL {
            for fraction in [1e-6, 0.05, 0.3, 0.59] {
                let slip = law.settling_velocity(fraction, 1883.5, 1.5e-3, 1000.0, 1e-6) / (1.0 - fraction);
                let drag = law.exchange_coefficient(fraction, slip, 1.5e-3, 1000.0, 1e-6) * slip;
                let weight = fraction * (1.0 - fraction) * 1883.5;
                // Gidaspow's law jumps at φ = 0.2, and no slip has a drag in between
                assert!((drag / weight - 1.0).abs() < 1e-9, "{}, φ {fraction}: {drag} for {weight}", law.name());
            }
        }
    }
}
