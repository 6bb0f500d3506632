//! Measured thresholds of motion in flumes over the size of the grains, `reference-data/bed-load/measured-thresholds.csv`: what
//! an onset may be, whatever an experimenter called one.

use crate::evidence::read_shipped;
use crate::metric::Confidence;
use std::sync::LazyLock;

/// Water, in which they were measured: gravity `[m/s²]`, density `[kg/m³]`, kinematic viscosity `[m²/s]`.
const WATER: (f64, f64, f64) = (9.81, 1000.0, 1e-6);
/// Factor on the dimensionless diameter within which experiments count as of the same size `[-]`.
const SAME_SIZE: f64 = 2.0;
/// Fewest experiments that make a band.
const FEWEST: usize = 20;

/// All thresholds.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionThresholds {
    /// (D*, τ*_c) `[-]` in the order of the table, D* = d ((s − 1) g/ν²)^⅓.
    pub points: Vec<(f64, f64)>,
    /// Source of the points.
    pub source: String,
    /// Confidence in the points.
    pub confidence: Confidence,
}

/// Band of the thresholds from experiments with grains of about one size, Shields numbers `[-]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThresholdBand {
    /// Half of them lie below.
    pub median: f64,
    /// Nine tenths lie between these.
    pub bounds: (f64, f64),
    /// Half of the width of the middle two thirds, a standard deviation.
    pub deviation: f64,
    /// Number of experiments.
    pub number: usize,
}

/// The thresholds.
pub static MOTION_THRESHOLDS: LazyLock<MotionThresholds> = LazyLock::new(|| {
    read_shipped("bed-load/measured-thresholds.csv", |table| {
        let (shields, diameters) = (table.numbers("Shields number")?, table.numbers("grain diameter")?);
        let densities = table.numbers("grain density")?;
        let (gravity, density, viscosity) = WATER;
        let size = |row: usize| {
            let buoyant = (densities[row] / density - 1.0) * gravity / (viscosity * viscosity);
            1e-3 * diameters[row] * libm::cbrt(buoyant)
        };
        Ok(MotionThresholds {
            points: (0..shields.len()).map(|row| (size(row), shields[row])).collect(),
            source: table.metadata.source.clone(),
            confidence: table.metadata.confidence,
        })
    })
});

impl MotionThresholds {
    /// The band of the experiments with grains within a factor of two of a dimensionless diameter `[-]`; none of too few.
    #[must_use]
    pub fn band(&self, dimensionless_diameter: f64) -> Option<ThresholdBand> {
        let range = dimensionless_diameter / SAME_SIZE..=dimensionless_diameter * SAME_SIZE;
        let mut own: Vec<f64> =
            self.points.iter().filter(|point| range.contains(&point.0)).map(|point| point.1).collect();
        own.sort_by(f64::total_cmp);
        let at = |share: f64| super::transport::quantile(&own, share);
        (own.len() >= FEWEST).then(|| ThresholdBand {
            median: at(0.5),
            bounds: (at(0.05), at(0.95)),
            deviation: 0.5 * (at(5.0 / 6.0) - at(1.0 / 6.0)),
            number: own.len(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bed_load::critical_shields_number;

    #[test]
    fn the_curve_runs_through_the_measured_thresholds() {
        let thresholds = &*MOTION_THRESHOLDS;
        assert_eq!(thresholds.points.len(), 511);
        for size in [5.0, 12.5, 25.0, 50.0, 150.0, 400.0] {
            let band = thresholds.band(size).expect("experiments");
            let ratio = critical_shields_number(size) / band.median;
            assert!((0.7..1.5).contains(&ratio), "D* = {size}: {ratio} of {band:?}");
            assert!(band.bounds.0 < band.median && band.median < band.bounds.1 && band.number >= FEWEST, "{band:?}");
            assert!(band.deviation > 0.1 * band.median && band.deviation < band.median, "{band:?}");
        }
        assert_eq!(thresholds.band(1e6), None);
    }

    #[test]
    fn the_dimensionless_diameter_is_that_of_quartz_in_water() {
        // 15 mm of 2650 kg/m³, the first row: 0.015 (1.65 · 9.81 · 1e12)^⅓ = 379.4
        assert!((MOTION_THRESHOLDS.points[0].0 - 379.4).abs() < 0.1, "{}", MOTION_THRESHOLDS.points[0].0);
    }
}
