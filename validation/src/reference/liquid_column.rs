//! The front of a collapsing column of water (Martin & Moyce 1952).

use super::shipped::read_shipped;
use crate::metric::Confidence;
use std::sync::LazyLock;

/// A measured front.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredFront {
    /// (t/√(a/(2g)), x/a) `[-]`, in ascending order.
    pub points: Vec<(f64, f64)>,
    /// Where it is from.
    pub source: String,
    /// How sure the project is of it.
    pub confidence: Confidence,
}

/// Largest difference between readings of the figure, in x/a `[-]`; `reference-data/water-column/README.md` has it.
const READING: f64 = 0.03;

impl MeasuredFront {
    /// Standard uncertainty of reading the figure, relative to the place, root mean square over the points `[-]`: that of an
    /// even spread within the difference between readings.
    #[must_use]
    pub fn relative_reading(&self) -> f64 {
        let square = |&(_, place): &(f64, f64)| (READING / place).powi(2) / 3.0;
        (self.points.iter().map(square).sum::<f64>() / self.points.len() as f64).sqrt()
    }
}

/// That of a column twice as high as wide, from `reference-data/water-column`.
pub static WATER_FRONT: LazyLock<MeasuredFront> = LazyLock::new(|| {
    read_shipped("water-column/front.csv", |table| {
        let points = table.numbers("time")?.iter().copied().zip(table.numbers("front")?.iter().copied()).collect();
        let (source, confidence) = (table.metadata.source.clone(), table.metadata.confidence);
        Ok(MeasuredFront { points, source, confidence })
    })
});
