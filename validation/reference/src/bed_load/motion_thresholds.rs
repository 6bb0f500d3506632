//! Measured thresholds of motion in flumes over the size of the grains, `reference-data/bed-load/measured-thresholds.csv`: what
//! an onset may be, whatever an experimenter called one.

use crate::evidence::read_shipped;
use crate::points::{MeasuredBand, MeasuredPoints};
use std::sync::LazyLock;

/// Water, in which they were measured: gravity `[m/s²]`, density `[kg/m³]`, kinematic viscosity `[m²/s]`.
const WATER: (f64, f64, f64) = (9.81, 1000.0, 1e-6);
/// Factor on the dimensionless diameter within which experiments count as of the same size `[-]`.
const SAME_SIZE: f64 = 2.0;
/// Fewest experiments that make a band.
const FEWEST: usize = 20;

/// The thresholds: (D*, τ*_c) `[-]`, D* = d ((s − 1) g/ν²)^⅓.
pub static MOTION_THRESHOLDS: LazyLock<MeasuredPoints> = LazyLock::new(|| {
    read_shipped("bed-load/measured-thresholds.csv", |table| {
        let (shields, diameters) = (table.numbers("Shields number")?, table.numbers("grain diameter")?);
        let densities = table.numbers("grain density")?;
        let (gravity, density, viscosity) = WATER;
        let size = |row: usize| {
            let buoyant = (densities[row] / density - 1.0) * gravity / (viscosity * viscosity);
            1e-3 * diameters[row] * libm::cbrt(buoyant)
        };
        Ok(MeasuredPoints {
            points: (0..shields.len()).map(|row| (size(row), shields[row])).collect(),
            source: table.metadata.source.clone(),
            confidence: table.metadata.confidence,
        })
    })
});

/// The band of the thresholds from experiments with grains within a factor of two of a dimensionless diameter `[-]`, Shields
/// numbers `[-]`; none for too few.
pub fn thresholds_about(dimensionless_diameter: f64) -> Option<MeasuredBand> {
    let range = dimensionless_diameter / SAME_SIZE..=dimensionless_diameter * SAME_SIZE;
    let own = MOTION_THRESHOLDS.points.iter().filter(|point| range.contains(&point.0));
    MeasuredBand::of(own.map(|point| point.1), FEWEST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bed_load::critical_shields_number;

    #[test]
    fn the_curve_runs_through_the_measured_thresholds() {
        assert_eq!(MOTION_THRESHOLDS.points.len(), 511);
        for size in [5.0, 12.5, 25.0, 50.0, 150.0, 400.0] {
            let band = thresholds_about(size).expect("experiments");
            let ratio = critical_shields_number(size) / band.median;
            assert!((0.7..1.5).contains(&ratio), "D* = {size}: {ratio} of {band:?}");
            assert!(band.bounds.0 < band.median && band.median < band.bounds.1 && band.number >= FEWEST, "{band:?}");
            assert!(band.deviation > 0.1 * band.median && band.deviation < band.median, "{band:?}");
        }
        assert_eq!(thresholds_about(1e6), None);
    }

    #[test]
    fn the_dimensionless_diameter_is_that_of_quartz_in_water() {
        // 15 mm of 2650 kg/m³, the first row: 0.015 (1.65 · 9.81 · 1e12)^⅓ = 379.4
        assert!((MOTION_THRESHOLDS.points[0].0 - 379.4).abs() < 0.1, "{}", MOTION_THRESHOLDS.points[0].0);
    }
}
