//! Measured points of a table, and bands of measured values.

use crate::evidence::read_shipped;
use crate::metric::Confidence;
use crate::statistics::percentile;

/// Points of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPoints {
    /// (x, y) in the order of the table.
    pub points: Vec<(f64, f64)>,
    /// Source of the points.
    pub source: String,
    /// Confidence in the points.
    pub confidence: Confidence,
}

/// Band of measured values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredBand {
    /// Median: half of the values lie below.
    pub median: f64,
    /// Range that contains nine tenths of the values.
    pub bounds: (f64, f64),
    /// Half of the width of the middle two thirds, a standard deviation.
    pub deviation: f64,
    /// Number of values.
    pub number: usize,
}

impl MeasuredPoints {
    /// Points of two columns of a shipped table.
    pub(crate) fn read(file: &str, x: &str, y: &str) -> Self {
        read_shipped(file, |table| {
            let (source, confidence) = (table.metadata.source.clone(), table.metadata.confidence);
            Ok(Self { points: table.points(x, y)?, source, confidence })
        })
    }
}

impl MeasuredBand {
    /// The band of values in any order; none for fewer than `fewest`.
    pub(crate) fn of(values: impl Iterator<Item = f64>, fewest: usize) -> Option<Self> {
        let mut sorted: Vec<f64> = values.collect();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| percentile(&sorted, share);
        (sorted.len() >= fewest).then(|| Self {
            median: at(0.5),
            bounds: (at(0.05), at(0.95)),
            deviation: 0.5 * (at(5.0 / 6.0) - at(1.0 / 6.0)),
            number: sorted.len(),
        })
    }
}
