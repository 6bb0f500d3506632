//! Uniform turbulent flow down a rough channel: the logarithmic law over the whole depth.
//!
//! With the body force g i along the bed the shear stress is ρ g i (h − z), on the bed ρ u_*², u_* = √(g h i). The
//! mixing length l = κ z′ √(1 − z′/H), z′ = z + z_off, H = h + z_off, carries
//! that stress, reduced by u_*² z_off/H at most, with exactly u/u_* = (1/κ) ln(z′/z_0), z_0 = k_s/30 (Nikuradse 1933).

use crate::evidence::read_shipped;
use std::sync::LazyLock;

/// Constants of the logarithmic law.
struct LogLaw {
    /// Von Kármán's κ `[-]`.
    karman: f64,
    /// k_s/z_0 `[-]`.
    roughness_ratio: f64,
}

static LOG_LAW: LazyLock<LogLaw> = LazyLock::new(|| {
    read_shipped("clear-water/log-law.csv", |table| {
        let constant = |name| table.number_of("constant", name, "value");
        Ok(LogLaw {
            karman: constant("Kármán constant")?,
            roughness_ratio: constant("sand roughness over roughness length")?,
        })
    })
});

/// k_s/z_0 `[-]`, the roughness of a wall of sand over the height at which the law begins.
pub fn roughness_ratio() -> f64 {
    LOG_LAW.roughness_ratio
}

/// A channel with a rough bed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoughChannel {
    /// Depth h `[m]`.
    pub depth: f64,
    /// Slope i `[-]`.
    pub slope: f64,
    /// Gravity g `[m/s²]`.
    pub gravity: f64,
    /// Density ρ `[kg/m³]`.
    pub density: f64,
    /// Equivalent sand roughness k_s `[m]`.
    pub sand_roughness: f64,
    /// Depth z_off of the law's origin below the bed `[m]`.
    pub origin_offset: f64,
}

impl RoughChannel {
    /// u_* = √(g h i) `[m/s]`.
    pub fn friction_velocity(&self) -> f64 {
        (self.gravity * self.depth * self.slope).sqrt()
    }

    /// Shear stress on the bed ρ g h i `[Pa]`.
    pub fn bed_shear_stress(&self) -> f64 {
        self.density * self.gravity * self.depth * self.slope
    }

    /// ln(z′/z_0) `[-]` at a height z `[m]` above the bed.
    pub fn logarithm(&self, height: f64) -> f64 {
        libm::log((height + self.origin_offset) * LOG_LAW.roughness_ratio / self.sand_roughness)
    }

    /// Velocity `[m/s]` at a height z `[m]` above the bed; 0 up to z_0.
    pub fn velocity(&self, height: f64) -> f64 {
        self.semi_logarithmic_slope() * self.logarithm(height).max(0.0)
    }

    /// Slope u_*/κ `[m/s]` of the velocity over ln z′.
    pub fn semi_logarithmic_slope(&self) -> f64 {
        self.friction_velocity() / LOG_LAW.karman
    }

    /// Depth mean U `[m/s]` of the law: (1/h) ∫ u dz from the bed, or from z_0 where that lies above it.
    pub fn mean_velocity(&self) -> f64 {
        // ∫ ln(z′/z_0) dz′ = z′ (ln(z′/z_0) − 1)
        let integral = |height: f64| (height + self.origin_offset) * (self.logarithm(height) - 1.0);
        let lowest = (self.sand_roughness / LOG_LAW.roughness_ratio - self.origin_offset).max(0.0);
        self.semi_logarithmic_slope() * (integral(self.depth) - integral(lowest)) / self.depth
    }

    /// U/(2 g i) `[s]`, in which a deviation of U decays by e under a friction that goes with U².
    pub fn adjustment_time(&self) -> f64 {
        self.mean_velocity() / (2.0 * self.gravity * self.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bed-load paper's flow at 3 %.
    const CHANNEL: RoughChannel = RoughChannel {
        depth: 0.046,
        slope: 0.03,
        gravity: 9.81,
        density: 1000.0,
        sand_roughness: 5e-3,
        origin_offset: 6e-4,
    };

    #[test]
    fn has_the_friction_velocity_and_the_stress_of_its_weight() {
        // √(9.81 · 0.046 · i): √0.0090252, √0.0135378, √0.022563
        for (slope, by_hand) in [(0.02, 0.095), (0.03, 0.116), (0.05, 0.150)] {
            let channel = RoughChannel { slope, ..CHANNEL };
            assert!((channel.friction_velocity() - by_hand).abs() < 5e-4);
            let stress = channel.density * channel.friction_velocity().powi(2);
            assert!((channel.bed_shear_stress() / stress - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn every_bed_of_grains_has_the_same_origin() {
        let origin = 0.12 * CHANNEL.sand_roughness;
        assert!((origin - CHANNEL.origin_offset).abs() < 1e-12);
        // the form without an origin would be half of u_* lower at half a grain above the bed
        let lower = RoughChannel { origin_offset: 0.0, ..CHANNEL };
        let difference = (CHANNEL.velocity(2.5e-3) - lower.velocity(2.5e-3)) / CHANNEL.friction_velocity();
        assert!((difference - 0.5247).abs() < 1e-3, "{difference}");
    }

    #[test]
    fn the_mean_is_the_integral_of_the_profile() {
        for origin_offset in [6e-4, 0.0] {
            let channel = RoughChannel { origin_offset, ..CHANNEL };
            let cells = 200_000;
            let cell = channel.depth / f64::from(cells);
            let sum: f64 = (0..cells).map(|k| channel.velocity((f64::from(k) + 0.5) * cell)).sum();
            assert!((channel.mean_velocity() / (sum / f64::from(cells)) - 1.0).abs() < 1e-7);
        }
    }

    #[test]
    fn profile_carries_the_stress_of_a_uniform_flow() {
        // l² (du/dz)² against u_*² (1 − z′/H), with du/dz by central differences of the profile
        let (whole, step) = (CHANNEL.depth + CHANNEL.origin_offset, 1e-7);
        for k in 1..46 {
            let height = f64::from(k) * 1e-3;
            let distance = height + CHANNEL.origin_offset;
            let rate = (CHANNEL.velocity(height + step) - CHANNEL.velocity(height - step)) / (2.0 * step);
            let length = 0.41 * distance * (1.0 - distance / whole).sqrt();
            let exact = CHANNEL.friction_velocity().powi(2) * (1.0 - distance / whole);
            assert!(((length * rate).powi(2) / exact - 1.0).abs() < 1e-7);
        }
    }
}
