//! Viscosity of a fluid between grains: what a suspension of them adds to that of the clear fluid.
//!
//! η_s = 1 + a φ/(1 − min(φ, φ_b)/φ_m), the viscous part of Boyer, Guazzelli & Pouliquen (2011), Phys. Rev. Lett. 107,
//! 188301, as two-phase Eulerian codes take it: Einstein's 1 + 5/2 φ for few grains, and a pole at φ_m that φ_b keeps
//! away from. Only the law's own grains count; friction between them is a rheology.

use crate::parameter::{ParameterProblem, between, range_problem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Relative viscosity of a suspension.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SuspensionViscosity {
    /// Intrinsic viscosity a `[-]`, ≥ 0: 5/2 of spheres (Einstein 1906); 0 for a fluid that does not feel the grains.
    #[schemars(transform = between(0.0, 100.0, "give 2.5 for spheres"))]
    pub intrinsic: f64,
    /// Solid fraction φ_m `[-]` of the pole, above φ_b.
    #[schemars(transform = between(0.1, 1.0, "give 0.62 for grains"))]
    pub largest_fraction: f64,
    /// Solid fraction φ_b `[-]` from which on the denominator no longer falls.
    pub bounded_from: f64,
}

impl Default for SuspensionViscosity {
    fn default() -> Self {
        Self { intrinsic: 2.5, largest_fraction: 0.62, bounded_from: 0.59 }
    }
}

impl SuspensionViscosity {
    /// Viscosity over that of the clear fluid `[-]` at a solid fraction φ `[-]`.
    #[inline]
    #[must_use]
    pub fn relative(&self, solid_fraction: f64) -> f64 {
        1.0 + self.intrinsic * solid_fraction / (1.0 - solid_fraction.min(self.bounded_from) / self.largest_fraction)
    }

    /// The first parameter outside its range, if any.
    #[must_use]
    pub fn parameter_problem(&self) -> Option<ParameterProblem> {
        range_problem(self).or_else(|| self.pole_problem())
    }

    /// The rule between the fractions.
    #[must_use]
    pub fn pole_problem(&self) -> Option<ParameterProblem> {
        let bounded = (0.0..=0.999 * self.largest_fraction).contains(&self.bounded_from);
        let (rule, remedy) = ("at least 0 and below `largest_fraction`", "give 0.59 for a `largest_fraction` of 0.62");
        (!bounded).then(|| ParameterProblem::new("bounded_from", self.bounded_from, rule, remedy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_einstein_for_few_grains_and_bounded_for_many() {
        let law = SuspensionViscosity::default();
        assert_eq!(law.relative(0.0), 1.0);
        assert!((law.relative(1e-4) - 1.000_25).abs() < 1e-7);
        // 1 + 2.5 · 0.31/(1 − ½)
        assert!((law.relative(0.31) - 2.55).abs() < 1e-12);
        // at and beyond φ_b the denominator is 3/62
        assert!((law.relative(0.6) - (1.0 + 1.5 * 62.0 / 3.0)).abs() < 1e-12);
    }

    #[test]
    fn grows_with_the_solid_fraction() {
        let law = SuspensionViscosity::default();
        let values: Vec<f64> = (0..64).map(|k| law.relative(f64::from(k) * 0.01)).collect();
        assert!(values.is_sorted_by(|a, b| a < b));
    }

    #[test]
    fn a_pole_within_the_range_is_refused() {
        let law = SuspensionViscosity::default();
        assert!(law.parameter_problem().is_none());
        let field = |law: SuspensionViscosity| law.parameter_problem().map(|problem| problem.field);
        assert_eq!(field(SuspensionViscosity { bounded_from: 0.62, ..law }), Some("bounded_from".to_owned()));
        assert_eq!(field(SuspensionViscosity { intrinsic: f64::NAN, ..law }), Some("intrinsic".to_owned()));
        assert_eq!(field(SuspensionViscosity { largest_fraction: 0.0, ..law }), Some("largest_fraction".to_owned()));
    }
}
