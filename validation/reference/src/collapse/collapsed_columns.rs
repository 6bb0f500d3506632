//! Columns that experimenters let collapse, as points: the planar pile of aluminium bars of Bui et al. (2008) and run-outs of round
//! columns, tables of `reference-data/column-planar` and `column-round`.

use crate::evidence::{MeasuredData, read_shipped, shipped_table};
use crate::input::FieldError;
use crate::metric::Confidence;
use crate::statistics::{Extrapolation, interpolated, neighbour_scatter};
use std::sync::LazyLock;

/// A planar pile against a wall at x = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredPile {
    /// Length at first `[m]`.
    pub length: f64,
    /// Height at first `[m]`.
    pub height: f64,
    /// Friction angle of its grains `[°]`.
    pub friction_angle: f64,
    /// (x, height) of its final surface `[m]`, outwards.
    pub surface: Vec<(f64, f64)>,
    /// (x, height) of the line between what moved and what did not `[m]`, outwards.
    pub failure: Vec<(f64, f64)>,
    /// Standard uncertainty of a height of the surface `[m]`: scatter of the points about the line through their neighbours.
    pub reading: f64,
    /// Source of the values.
    pub source: String,
    /// Confidence in the values.
    pub confidence: Confidence,
}

/// Run-outs of round columns.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredRunOuts {
    /// (h_0/r_0, (r_∞ − r_0)/r_0) `[-]`, in ascending order.
    pub points: Vec<(f64, f64)>,
    /// Points of low confidence, which are drawn only.
    pub doubtful: Vec<(f64, f64)>,
    /// Relative standard deviation of the points about the line through their neighbours, in logarithms `[-]`.
    pub scatter: f64,
    /// Source of the points.
    pub source: String,
    /// Confidence in the points.
    pub confidence: Confidence,
}

/// The pile of aluminium bars.
pub static ALUMINIUM_BAR_PILE: LazyLock<MeasuredPile> = LazyLock::new(|| {
    read_shipped("column-planar/bars-surface.csv", |lines| {
        MeasuredPile::read(lines, &shipped_table("column-planar/bars.csv")?)
    })
});

/// The round columns.
pub static ROUND_COLUMN_RUN_OUTS: LazyLock<MeasuredRunOuts> =
    LazyLock::new(|| read_shipped("column-round/measured-run-out.csv", MeasuredRunOuts::read));

impl MeasuredPile {
    fn read(lines: &MeasuredData, pile: &MeasuredData) -> Result<Self, FieldError> {
        let (names, x, height) = (lines.labels("line")?, lines.numbers("x")?, lines.numbers("height")?);
        let of = |line: &str| -> Vec<(f64, f64)> {
            (0..names.len()).filter(|&row| names[row] == line).map(|row| (x[row], height[row])).collect()
        };
        let value = |what| pile.number_of("what", what, "value");
        let surface = of("surface");
        Ok(Self {
            length: value("length")?,
            height: value("height")?,
            friction_angle: value("friction angle")?,
            reading: neighbour_scatter(&surface).unwrap_or(f64::NAN),
            failure: of("failure"),
            surface,
            source: lines.metadata.source.clone(),
            confidence: lines.metadata.confidence,
        })
    }

    /// Front position of its surface at a thickness `[m]`, linear between its points `[m]`.
    pub fn front(&self, thickness: f64) -> f64 {
        let below = self.surface.windows(2).find(|pair| pair[0].1 >= thickness && pair[1].1 < thickness);
        below.map_or(f64::NAN, |pair| {
            let [(x0, h0), (x1, h1)] = [pair[0], pair[1]];
            x0 + (x1 - x0) * (h0 - thickness) / (h0 - h1)
        })
    }

    /// Standard uncertainty of that place from the reading: over the slope of the toe, a line through its last four points `[m]`.
    pub fn front_reading(&self) -> f64 {
        let toe = &self.surface[self.surface.len().saturating_sub(4)..];
        crate::statistics::linear_fit(toe).map_or(f64::NAN, |line| self.reading / line.slope.abs())
    }

    /// Area under its surface over that of the pile at first, less 1 `[-]`: how far heights are off as a whole.
    pub fn excess(&self) -> f64 {
        let first = self.surface.first().map_or(0.0, |point| point.0 * point.1);
        let area: f64 =
            self.surface.windows(2).map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1)).sum();
        (first + area) / (self.length * self.height) - 1.0
    }
}

impl MeasuredRunOuts {
    fn read(table: &MeasuredData) -> Result<Self, FieldError> {
        let (ratios, run_outs) = (table.numbers("aspect ratio")?, table.numbers("run-out")?);
        let confidences = table.confidences()?;
        let of = |doubtful: bool| -> Vec<(f64, f64)> {
            let rows = (0..ratios.len()).filter(|&row| (confidences[row] == Confidence::Low) == doubtful);
            rows.map(|row| (ratios[row], run_outs[row])).collect()
        };
        let points = of(false);
        let logarithms: Vec<(f64, f64)> = points.iter().map(|(a, x)| (libm::log(*a), libm::log(*x))).collect();
        Ok(Self {
            scatter: neighbour_scatter(&logarithms).unwrap_or(f64::NAN),
            points,
            doubtful: of(true),
            source: table.metadata.source.clone(),
            confidence: table.metadata.confidence,
        })
    }

    /// The run-out between the points, straight in logarithms `[-]`; none outside of them.
    pub fn at(&self, aspect_ratio: f64) -> Option<f64> {
        let logarithms: Vec<(f64, f64)> = self.points.iter().map(|(a, x)| (libm::log(*a), libm::log(*x))).collect();
        interpolated(&logarithms, libm::log(aspect_ratio), (Extrapolation::Nothing, Extrapolation::Nothing))
            .map(libm::exp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::{CollapseLawSource, ROUND_COLLAPSE};
    use crate::grains::ALUMINIUM_BARS;

    #[test]
    fn the_pile_keeps_its_volume_and_ends_where_its_table_does() {
        let pile = &*ALUMINIUM_BAR_PILE;
        assert_eq!((pile.surface.len(), pile.failure.len()), (23, 9));
        // 0.0203 of 0.02 m²
        assert!((pile.excess() - 0.015).abs() < 0.003, "{}", pile.excess());
        assert!((pile.reading * 1e3 - 0.6).abs() < 0.4, "{}", pile.reading);
        // between 0.3824 m, where it is 7.9 mm high, and 0.4022 m, where it is 3.7 mm
        let front = pile.front(0.02 * pile.length);
        assert!((front - 0.4009).abs() < 2e-4, "{front}");
        assert!(pile.front_reading() > 0.5 * pile.reading && pile.front_reading() < 0.02, "{}", pile.front_reading());
        assert!(pile.front(1.0).is_nan());
    }

    #[test]
    fn the_bars_have_the_friction_of_their_angle() {
        let friction = libm::tan(ALUMINIUM_BAR_PILE.friction_angle.to_radians());
        assert!((ALUMINIUM_BARS.law.static_friction - friction).abs() < 5e-6, "{friction}");
        assert_eq!(ALUMINIUM_BARS.law.limiting_friction, ALUMINIUM_BARS.law.static_friction);
    }

    #[test]
    fn round_run_outs_lie_about_lubes_law() {
        let measured = &*ROUND_COLUMN_RUN_OUTS;
        assert_eq!((measured.points.len(), measured.doubtful.len()), (11, 1));
        assert!(measured.points.is_sorted_by(|one, other| one.0 < other.0));
        let lube = CollapseLawSource::Lube.law(&ROUND_COLLAPSE.run_out);
        for (a, run_out) in &measured.points {
            let ratio = run_out / lube.value(*a).expect("a branch");
            assert!((0.78..1.02).contains(&ratio), "a = {a}: {ratio}");
        }
        assert!(measured.scatter > 0.01 && measured.scatter < 0.1, "{}", measured.scatter);
        assert_eq!(measured.at(0.5), None);
        assert!((measured.at(2.498).expect("a point") - 2.381).abs() < 1e-9);
    }
}
