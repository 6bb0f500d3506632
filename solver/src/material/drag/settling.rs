//! Settling of a uniform suspension: the slip at which drag carries the weight of the grains in the fluid,
//! φ (1 − φ)(ρ_s − ρ_f) g = K |u_r|, and the velocity (1 − φ) |u_r| at which grains without a net flux then sink.

use super::DragLaw;

/// Intervals of a [`SettlingTable`]: straight lines are within 1e-4 of the law.
const INTERVALS: usize = 256;

/// Solid fraction that stands for a grain alone `[-]`.
const ALONE: f64 = 1e-9;

/// Grains that settle, and the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settling {
    /// (ρ_s − ρ_f) g > 0 `[N/m³]`.
    pub submerged_weight: f64,
    /// Diameter of the sphere that has the drag of a grain `[m]`.
    pub grain_diameter: f64,
    /// `[kg/m³]`
    pub fluid_density: f64,
    /// `[m²/s]`
    pub kinematic_viscosity: f64,
}

impl Settling {
    /// Settling velocity (1 − φ) |u_r| `[m/s]` of a suspension of a solid fraction φ `[-]` in (0, 1), to the last bit.
    #[must_use]
    pub fn velocity(&self, law: DragLaw, solid_fraction: f64) -> f64 {
        let Self { submerged_weight, grain_diameter, fluid_density, kinematic_viscosity } = *self;
        let weight = solid_fraction * (1.0 - solid_fraction) * submerged_weight;
        let sinks_faster = |slip: f64| {
            let exchange =
                law.exchange_coefficient(solid_fraction, slip, grain_diameter, fluid_density, kinematic_viscosity);
            exchange * slip < weight
        };
        // drag rises with the slip: a power of two above the root, then halvings
        let (mut low, mut high) = (0.0, kinematic_viscosity / grain_diameter);
        while sinks_faster(high) {
            (low, high) = (high, 2.0 * high);
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return (1.0 - solid_fraction) * middle;
            }
            if sinks_faster(middle) { low = middle } else { high = middle }
        }
    }
}

/// Settling velocity of a suspension over its solid fraction: the law needs a root at each φ.
#[derive(Debug, Clone)]
pub struct SettlingTable {
    /// `[m/s]`
    velocity: Vec<f64>,
    largest_fraction: f64,
}

impl SettlingTable {
    /// The table from 0 to a largest fraction `[-]`.
    #[must_use]
    pub fn new(settling: &Settling, law: DragLaw, largest_fraction: f64) -> Self {
        let fraction = |node: usize| (largest_fraction * node as f64 / INTERVALS as f64).max(ALONE);
        Self {
            velocity: (0..=INTERVALS).map(|node| settling.velocity(law, fraction(node))).collect(),
            largest_fraction,
        }
    }

    /// The same velocity `[m/s]` at every solid fraction.
    #[cfg(test)]
    pub(crate) fn uniform(velocity: f64, largest_fraction: f64) -> Self {
        Self { velocity: vec![velocity; INTERVALS + 1], largest_fraction }
    }

    /// w `[m/s]` at a solid fraction `[-]`.
    #[must_use]
    pub fn at(&self, fraction: f64) -> f64 {
        let place = (fraction / self.largest_fraction).clamp(0.0, 1.0) * INTERVALS as f64;
        let node = (place as usize).min(INTERVALS - 1);
        let part = place - node as f64;
        self.velocity[node] + part * (self.velocity[node + 1] - self.velocity[node])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quartz in water by its diameter `[m]`.
    fn quartz(grain_diameter: f64) -> Settling {
        Settling { submerged_weight: 16_186.5, grain_diameter, fluid_density: 1000.0, kinematic_viscosity: 1e-6 }
    }

    #[test]
    fn small_grains_settle_by_stokes_and_large_ones_by_newton() {
        // (ρ_s − ρ_f) g d²/(18 μ) of 1 μm, and √(4 (s − 1) g d/(3 · 0.44)) of 50 mm
        let small = quartz(1e-6).velocity(DragLaw::WenYu, 1e-9);
        let stokes = 16_186.5 * 1e-12 / 18e-3;
        assert!((small / stokes - 1.0).abs() < 1e-3, "{small} for {stokes} m/s");
        let large = quartz(0.05).velocity(DragLaw::WenYu, 1e-9);
        let newton = (4.0 * 16.1865 * 0.05 / (3.0 * 0.44_f64)).sqrt();
        assert!((large / newton - 1.0).abs() < 1e-3, "{large} for {newton} m/s");
    }

    #[test]
    fn the_drag_of_the_slip_is_the_weight() {
        let light = Settling { submerged_weight: 1883.5, ..quartz(1.5e-3) };
        for law in DragLaw::ALL {
            for fraction in [1e-6, 0.05, 0.3, 0.59] {
                let slip = light.velocity(law, fraction) / (1.0 - fraction);
                let drag = law.exchange_coefficient(fraction, slip, 1.5e-3, 1000.0, 1e-6) * slip;
                let weight = fraction * (1.0 - fraction) * 1883.5;
                // Gidaspow's law jumps at φ = 0.2, and no slip has a drag in between
                assert!((drag / weight - 1.0).abs() < 1e-9, "{}, φ {fraction}: {drag} for {weight}", law.name());
            }
        }
    }
}
