//! Statements of the bed-load paper on its velocity profiles.

use crate::evidence::read_shipped;
use crate::metric::Confidence;
use std::sync::LazyLock;

/// A number of layers, each straight over the logarithm of the height, on a slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerStatement {
    /// Slope tanθ `[-]`.
    pub slope: f64,
    /// Number of layers.
    pub layers: f64,
    /// Confidence in the statement.
    pub confidence: Confidence,
}

/// The statements, from the gentlest slope on.
pub static LAYER_STATEMENTS: LazyLock<Vec<LayerStatement>> = LazyLock::new(|| {
    read_shipped("bed-load/statements.csv", |table| {
        let (slopes, layers) = (table.numbers("slope")?, table.numbers("layers")?);
        let rows = slopes.iter().zip(layers).zip(table.confidences()?);
        Ok(rows.map(|((&slope, &layers), confidence)| LayerStatement { slope, layers, confidence }).collect())
    })
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_are_two_layers_at_3_and_three_at_5_per_cent() {
        let read: Vec<(f64, f64)> = LAYER_STATEMENTS.iter().map(|row| (row.slope, row.layers)).collect();
        assert_eq!(read, [(0.03, 2.0), (0.05, 3.0)]);
    }
}
