//! Dilatancy of sheared grains: φ = φ_max/(1 + B I) with I = γ̇ d √(ρ_s/p) (Maurin et al. 2016 for bed load), and its
//! inverse, the pressure of grains that are sheared at a fraction,
//!
//! p = ρ_s (d γ̇ B φ/(φ_max − φ))².
//!
//! A model that computes p uses it as it stands. A model that computes φ and lets the grains' pressure carry a known load
//! p′ bounds it ([`PressureBounds`]): φ_max − φ has a least value, the pressure is at most a p′ + b, which is enough to
//! open a bed and keeps a single fast particle from exploding, and packed grains are elastic, p′ + K (φ − φ_max), if that
//! is more. At rest they so carry the load at φ_max, and none once they are looser by p′/K.

use crate::parameter::{ParameterProblem, between, range_problem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How grains dilate.
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
    /// Bounds of the pressure.
    pub bounds: PressureBounds,
}

/// What keeps the pressure of grains that carry a load within reason.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct PressureBounds {
    /// Stiffness K = dp/dφ of packed grains `[Pa]`, ≥ 0: under a load p′ a bed at rest is looser than φ_max by at most
    /// p′/K, some thousandths.
    #[schemars(transform = between(0.0, 1e9, "1e4 Pa for a bed of some centimetres"))]
    pub stiffness: f64,
    /// Least φ_max − φ `[-]` that the pressure is divided by, > 0.
    #[schemars(transform = between(1e-6, 0.5, "0.02 is three per cent of φ_max"))]
    pub least_room: f64,
    /// Largest pressure of sheared grains over the load, a `[-]`, ≥ 1.
    #[schemars(transform = between(1.0, 1e6, "2 opens a bed"))]
    pub largest_load_ratio: f64,
    /// Pressure b `[Pa]` that sheared grains may have beyond that, ≥ 0: what separates grains without a load.
    #[schemars(transform = between(0.0, 1e9, "20 Pa parts grains without a load"))]
    pub largest_excess: f64,
}

impl Default for PressureBounds {
    fn default() -> Self {
        Self { stiffness: 1e4, least_room: 0.02, largest_load_ratio: 2.0, largest_excess: 20.0 }
    }
}

impl PressureBounds {
    /// The first parameter outside its range, if any.
    #[must_use]
    pub fn parameter_problem(&self) -> Option<ParameterProblem> {
        range_problem(self)
    }
}

impl Dilatancy {
    /// φ `[-]` at an inertial number I `[-]`.
    #[inline]
    #[must_use]
    pub fn solid_fraction(&self, inertial_number: f64) -> f64 {
        self.packing / (1.0 + self.dilation * inertial_number)
    }

    /// ρ_s (d γ̇ B φ/(φ_max − φ))² `[Pa]` at a shear rate `[1/s]` and a solid fraction `[-]`, φ_max − φ not below its
    /// bound.
    #[inline]
    #[must_use]
    pub fn sheared_pressure(&self, shear_rate: f64, solid_fraction: f64) -> f64 {
        let room = (self.packing - solid_fraction).max(self.bounds.least_room);
        let root = self.grain_diameter * shear_rate * self.dilation * solid_fraction / room;
        self.grain_density * root * root
    }

    /// Pressure of grains `[Pa]` at a shear rate `[1/s]` and a solid fraction `[-]` under a load `[Pa]`.
    #[inline]
    #[must_use]
    pub fn pressure(&self, shear_rate: f64, solid_fraction: f64, load: f64) -> f64 {
        let PressureBounds { stiffness, largest_load_ratio, largest_excess, .. } = self.bounds;
        let sheared = self.sheared_pressure(shear_rate, solid_fraction).min(largest_load_ratio * load + largest_excess);
        let elastic = load + stiffness * (solid_fraction - self.packing);
        sheared.max(elastic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAND: Dilatancy = Dilatancy {
        dilation: 0.31,
        packing: 0.6,
        grain_diameter: 5e-3,
        grain_density: 2600.0,
        bounds: PressureBounds { stiffness: 1e4, least_room: 0.02, largest_load_ratio: 2.0, largest_excess: 20.0 },
    };

    #[test]
    fn sheared_grains_carry_their_load_at_the_fraction_of_their_inertia() {
        for (rate, load) in [(5.0, 10.0), (50.0, 10.0), (50.0, 100.0), (200.0, 30.0)] {
            let inertia = rate * 5e-3 * (2600.0_f64 / load).sqrt();
            let fraction = SAND.solid_fraction(inertia);
            assert!((fraction - 0.6 / (1.0 + 0.31 * inertia)).abs() < 1e-15);
            let pressure = SAND.pressure(rate, fraction, load);
            assert!((pressure / load - 1.0).abs() < 1e-12, "{rate} 1/s, {load} Pa: {pressure} Pa");
            assert!(SAND.pressure(rate, fraction + 0.01, load) > load);
            assert!(SAND.pressure(rate, fraction - 0.01, load) < load);
        }
    }

    #[test]
    fn grains_at_rest_carry_their_load_at_the_densest_packing() {
        for load in [1.0, 100.0] {
            assert_eq!(SAND.pressure(0.0, 0.6, load), load);
            assert_eq!(SAND.pressure(0.0, 0.58, load), 0.0);
            assert!(SAND.pressure(0.0, 0.601, load) > load);
        }
    }

    #[test]
    fn a_fast_grain_gets_no_more_than_its_bound() {
        assert_eq!(SAND.pressure(1e6, 0.55, 30.0), 80.0);
        assert_eq!(SAND.pressure(1e6, 0.55, 0.0), 20.0);
    }

    #[test]
    fn bounds_that_bound_nothing_are_refused() {
        let bounds = PressureBounds::default();
        assert!(bounds.parameter_problem().is_none());
        let field = |bounds: PressureBounds| bounds.parameter_problem().map(|problem| problem.field);
        assert_eq!(field(PressureBounds { least_room: 0.0, ..bounds }), Some("least_room".to_owned()));
        assert_eq!(field(PressureBounds { stiffness: f64::NAN, ..bounds }), Some("stiffness".to_owned()));
        assert_eq!(field(PressureBounds { largest_load_ratio: 0.5, ..bounds }), Some("largest_load_ratio".to_owned()));
        assert_eq!(field(PressureBounds { largest_excess: -1.0, ..bounds }), Some("largest_excess".to_owned()));
    }
}
