//! The onset of motion: Shields' curve in the form of Soulsby & Whitehouse (1997),
//! τ*_c = 0.30/(1 + 1.2 D*) + 0.055 (1 − exp(−0.020 D*)), whose numbers `reference-data/bed-load/onset.csv` holds.

use crate::evidence::read_shipped;
use std::sync::LazyLock;

/// Factor by which experiments scatter about the curve `[-]`.
pub const ONSET_SCATTER: f64 = 1.5;

/// Source of the curve.
pub const ONSET_SOURCE: &str = "Shields' curve, Soulsby & Whitehouse 1997";

static COEFFICIENTS: LazyLock<[f64; 4]> = LazyLock::new(|| {
    read_shipped("bed-load/onset.csv", |table| {
        let value = |name| table.number_of("coefficient", name, "value");
        Ok([value("a")?, value("b")?, value("c")?, value("e")?])
    })
});

/// Critical Shields number τ*_c `[-]` at a dimensionless diameter D* = d ((s − 1) g/ν²)^⅓ `[-]`.
pub fn critical_shields_number(dimensionless_diameter: f64) -> f64 {
    let [a, b, c, e] = *COEFFICIENTS;
    a / (1.0 + b * dimensionless_diameter) + c * (1.0 - libm::exp(-e * dimensionless_diameter))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_has_its_limits_and_its_dip() {
        // D* = 10: 0.3/13 + 0.055 (1 − e^−0.2) = 0.023077 + 0.009970
        assert!((critical_shields_number(10.0) - 0.033_047).abs() < 1e-6);
        assert!((critical_shields_number(1e4) - 0.055).abs() < 1e-4);
        assert!((critical_shields_number(0.0) - 0.30).abs() < 1e-15);
        let dip = critical_shields_number(18.0);
        assert!(dip < critical_shields_number(8.0) && dip < critical_shields_number(60.0) && dip > 0.028);
    }
}
