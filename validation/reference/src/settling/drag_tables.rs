//! Drag of spheres as tables that do not know the program's laws: the standard drag curve, and slips of suspensions computed
//! from the printed laws outside of it. A reference that calls the law it judges agrees with any error in it.

use crate::evidence::read_shipped;
use crate::points::MeasuredPoints;
use std::sync::LazyLock;

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

/// The standard drag curve of a smooth sphere, drag coefficients over Reynolds numbers `[-]`: Clift, Grace & Weber's recommended
/// correlations at round numbers.
pub static STANDARD_DRAG: LazyLock<MeasuredPoints> =
    LazyLock::new(|| MeasuredPoints::read("settling/standard-drag.csv", "Reynolds number", "drag coefficient"));

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
