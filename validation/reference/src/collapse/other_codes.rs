//! Collapses under μ(I) as other codes compute them, over time: tables `other-codes.csv` of `reference-data/column-planar`, `column-round` and
//! `incline-collapse`.

use crate::evidence::{MeasuredData, read_shipped};
use crate::input::FieldError;
use crate::metric::Confidence;
use std::sync::LazyLock;

/// Quantities that codes tell of a collapse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodeQuantity {
    /// Kinetic energy over ½ M g h_0 `[-]`.
    KineticEnergy,
    /// Front at a thickness of 0.05 r_0, over r_0 `[-]`.
    Front,
    /// Front of the deposit at that thickness, from the initial edge over r_0 `[-]`.
    FrontAtRest,
    /// Run-out by the centroid of the deposit `[-]`.
    CentroidAtRest,
}

/// Time over √(h_0/g) `[-]` at which tables have what rests.
pub const AT_REST: f64 = 10.0;

/// A quantity over time by one code.
#[derive(Debug, Clone, PartialEq)]
pub struct CodeSeries {
    /// Name of the code.
    pub code: String,
    /// The quantity.
    pub quantity: CodeQuantity,
    /// Aspect ratio `[-]` or slope `[°]`.
    pub flow: f64,
    /// (t/√(h_0/g), value, standard uncertainty) `[-]`.
    pub points: Vec<(f64, f64, f64)>,
}

/// The series of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherCodes {
    /// Series by series.
    pub series: Vec<CodeSeries>,
    /// Origin of the values.
    pub source: String,
    /// Confidence in the values.
    pub confidence: Confidence,
}

/// Planar columns of Lagrée's grains, by aspect ratio.
pub static PLANAR_CODES: LazyLock<OtherCodes> =
    LazyLock::new(|| read_shipped("column-planar/other-codes.csv", OtherCodes::read));
/// Round columns of Lagrée's grains, by aspect ratio.
pub static ROUND_CODES: LazyLock<OtherCodes> =
    LazyLock::new(|| read_shipped("column-round/other-codes.csv", OtherCodes::read));
/// Glass beads behind a gate of 1.3 m/s, by slope.
pub static SLOPE_CODES: LazyLock<OtherCodes> =
    LazyLock::new(|| read_shipped("incline-collapse/other-codes.csv", OtherCodes::read));

impl OtherCodes {
    fn read(table: &MeasuredData) -> Result<Self, FieldError> {
        let (codes, quantities) = (table.labels("code")?, table.labels("quantity")?);
        let (flows, times) = (table.numbers("flow")?, table.numbers("time")?);
        let (values, uncertainties) = (table.numbers("value")?, table.numbers("uncertainty")?);
        let mut series: Vec<CodeSeries> = Vec::new();
        for row in 0..codes.len() {
            let quantity = match quantities[row].as_str() {
                "kinetic energy" => CodeQuantity::KineticEnergy,
                "front at rest" => CodeQuantity::FrontAtRest,
                "centroid at rest" => CodeQuantity::CentroidAtRest,
                _ => CodeQuantity::Front,
            };
            let flow = flows[row];
            let point = (times[row], values[row], uncertainties[row]);
            match series.last_mut() {
                Some(last) if last.code == codes[row] && (last.quantity, last.flow) == (quantity, flow) => {
                    last.points.push(point);
                }
                _ => series.push(CodeSeries { code: codes[row].clone(), quantity, flow, points: vec![point] }),
            }
        }
        Ok(Self { series, source: table.metadata.source.clone(), confidence: table.metadata.confidence })
    }

    /// The series of a flow.
    pub fn of(&self, flow: f64, quantity: CodeQuantity) -> impl Iterator<Item = &CodeSeries> {
        self.series.iter().filter(move |series| (series.flow, series.quantity) == (flow, quantity))
    }

    /// Mean over the codes at a time over √(h_0/g), and its standard uncertainty: the codes' own, or how far they are from it where
    /// that is more `[-]`. None where no code tells.
    pub fn at(&self, flow: f64, quantity: CodeQuantity, time: f64) -> Option<(f64, f64)> {
        let at_time = |series: &CodeSeries| series.points.iter().find(|point| point.0 == time).copied();
        let points: Vec<(f64, f64, f64)> = self.of(flow, quantity).filter_map(at_time).collect();
        let mean = points.iter().map(|point| point.1).sum::<f64>() / points.len() as f64;
        let off = points.iter().map(|point| point.2.max((point.1 - mean).abs()));
        (!points.is_empty()).then(|| (mean, off.fold(0.0, f64::max)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_are_read_by_flow() {
        for codes in [&PLANAR_CODES, &ROUND_CODES, &SLOPE_CODES] {
            for series in &codes.series {
                assert!(series.points.is_sorted_by(|one, other| one.0 < other.0), "{series:?}");
                assert!(series.points.iter().all(|point| point.1 > 0.0 && point.2 > 0.0), "{series:?}");
            }
        }
        let fronts: Vec<&CodeSeries> = PLANAR_CODES.of(1.0, CodeQuantity::Front).collect();
        let at = |series: &CodeSeries| series.points.iter().find(|point| point.0 == 2.0).expect("a point").1;
        let (points, gerris) = (at(fronts[0]), at(fronts[1]));
        let (mean, uncertainty) = PLANAR_CODES.at(1.0, CodeQuantity::Front, 2.0).expect("two codes");
        assert!((mean - 0.5 * (gerris + points)).abs() < 1e-12);
        assert!(uncertainty >= 0.5 * (gerris - points).abs() - 1e-12);
        assert_eq!(PLANAR_CODES.at(2.0, CodeQuantity::KineticEnergy, 2.0), None);
    }
}
