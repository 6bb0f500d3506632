//! Dilatancy of sheared grains: φ = φ_max/(1 + B I) with I = γ̇ d √(ρ_s/p) (Maurin et al. 2016 for bed load).

/// Dilatancy of sheared grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dilatancy {
    /// Dilation B `[-]`, ≥ 0.
    pub dilation: f64,
    /// Solid fraction φ_max `[-]` of grains without shear.
    pub packing: f64,
    /// Grain diameter d `[m]`.
    pub grain_diameter: f64,
    /// Density ρ_s `[kg/m³]` of a grain.
    pub grain_density: f64,
}

impl Dilatancy {
    /// φ `[-]` at an inertial number I `[-]`.
    #[inline]
    #[must_use]
    pub fn solid_fraction(&self, inertial_number: f64) -> f64 {
        self.packing / (1.0 + self.dilation * inertial_number)
    }

    /// φ `[-]` at a shear rate `[1/s]` under a load `[Pa]`: φ_max at rest, 0 without a load.
    #[inline]
    #[must_use]
    pub fn sheared_fraction(&self, shear_rate: f64, load: f64) -> f64 {
        if load <= 0.0 {
            return 0.0;
        }
        self.solid_fraction(shear_rate * self.grain_diameter * (self.grain_density / load).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAND: Dilatancy = Dilatancy { dilation: 0.31, packing: 0.6, grain_diameter: 5e-3, grain_density: 2600.0 };

    #[test]
    fn grains_are_looser_the_faster_and_the_lighter_they_are_sheared() {
        assert_eq!(SAND.sheared_fraction(0.0, 10.0), 0.6);
        assert_eq!(SAND.sheared_fraction(3.0, 0.0), 0.0);
        // I = 20/s · 5 mm · √(2600/26) = 1
        assert!((SAND.sheared_fraction(20.0, 26.0) - 0.6 / 1.31).abs() < 1e-14);
        assert!(SAND.sheared_fraction(40.0, 26.0) < SAND.sheared_fraction(20.0, 26.0));
        assert!(SAND.sheared_fraction(20.0, 2.6) < SAND.sheared_fraction(20.0, 26.0));
    }
}
