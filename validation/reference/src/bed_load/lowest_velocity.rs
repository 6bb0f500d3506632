//! The lowest part of a measured sheet flow (Sumer et al. 1996), `reference-data/bed-load/sheet-flow-lowest-velocity.csv`: a power law.

use crate::metric::Confidence;
use crate::points::MeasuredPoints;
use crate::statistics::{Exponent, power_law};
use std::sync::LazyLock;

/// Height over the grain diameter up to which the points are taken for the layer of grains `[-]`: from there on the velocity
/// follows the logarithm of the height more closely.
pub const LOWEST_LAYER_TOP: f64 = 13.0;

/// Points and the power law through those of the layer of grains.
#[derive(Debug, Clone, PartialEq)]
pub struct LowestVelocity {
    /// (height over the grain diameter, velocity over the friction velocity) `[-]`, upwards.
    pub points: Vec<(f64, f64)>,
    /// The power law.
    pub law: Exponent,
    /// Source of the points.
    pub source: String,
    /// Confidence in the points.
    pub confidence: Confidence,
}

/// The sheet flow at a Shields number of 1.4.
pub static SHEET_FLOW_LOWEST_VELOCITY: LazyLock<LowestVelocity> = LazyLock::new(|| {
    let MeasuredPoints { points, source, confidence } = MeasuredPoints::read(
        "bed-load/sheet-flow-lowest-velocity.csv",
        "height over diameter",
        "velocity over friction velocity",
    );
    let layer: Vec<(f64, f64)> = points.iter().copied().filter(|point| point.0 <= LOWEST_LAYER_TOP).collect();
    let none = Exponent { value: f64::NAN, standard_error: f64::NAN, coefficient: f64::NAN };
    LowestVelocity { law: power_law(&layer).unwrap_or(none), points, source, confidence }
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measured_velocity_is_a_power_of_the_height_and_no_logarithm() {
        let measured = &*SHEET_FLOW_LOWEST_VELOCITY;
        // from 4.00 at 1.72 d to 13.53 at 12.84 d: 1.219/2.013
        assert!((measured.law.value - 0.61).abs() < 0.03, "{:?}", measured.law);
        assert!(measured.law.standard_error < 0.03);
    }
}
