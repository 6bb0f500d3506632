//! Drag of spheres as tables that do not know the program's laws: the standard drag curve, and slips of suspensions computed
//! from the printed laws outside of it. A reference that calls the law it judges agrees with any error in it.

use crate::evidence::read_shipped;
use crate::metric::Confidence;
use std::sync::LazyLock;

/// The standard drag curve of a smooth sphere.
pub struct StandardDrag {
    /// Confidence in the curve.
    pub confidence: Confidence,
    /// Reynolds numbers and drag coefficients `[-]`.
    pub points: Vec<(f64, f64)>,
}

/// The slip of a suspension of one law.
#[derive(Debug, Clone, PartialEq)]
pub struct HinderedSlip {
    /// Name of the law.
    pub law: String,
    /// Archimedes number |ρ_s/ρ_f − 1| g d³/ν² `[-]`.
    pub archimedes_number: f64,
    /// Solid fraction φ `[-]`.
    pub solid_fraction: f64,
    /// Slip as a Reynolds number |u_r| d/ν `[-]`.
    pub reynolds: f64,
}

/// Clift, Grace & Weber's recommended correlations at round Reynolds numbers.
pub static STANDARD_DRAG: LazyLock<StandardDrag> = LazyLock::new(|| {
    read_shipped("settling/standard-drag.csv", |table| {
        let (reynolds, drag) = (table.numbers("Reynolds number")?, table.numbers("drag coefficient")?);
        let points = reynolds.iter().copied().zip(drag.iter().copied()).collect();
        Ok(StandardDrag { confidence: table.metadata.confidence, points })
    })
});

/// Every law over three Archimedes numbers, from Stokes' to Newton's regime, and three solid fractions.
pub static HINDERED_SLIPS: LazyLock<Vec<HinderedSlip>> = LazyLock::new(|| {
    read_shipped("settling/hindered-slip.csv", |table| {
        let numbers = |name| table.numbers(name);
        let (archimedes, fractions) = (numbers("Archimedes number")?, numbers("solid fraction")?);
        let (laws, slips) = (table.labels("law")?, numbers("slip Reynolds number")?);
        let row = |k: usize| HinderedSlip {
            law: laws[k].clone(),
            archimedes_number: archimedes[k],
            solid_fraction: fractions[k],
            reynolds: slips[k],
        };
        Ok((0..laws.len()).map(row).collect())
    })
});
