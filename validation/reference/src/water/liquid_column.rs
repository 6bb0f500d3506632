//! Fronts of collapsing columns of water: released at once (Martin & Moyce 1952), or by a gate (Lobovský et al. 2014).

use crate::evidence::read_shipped;
use crate::metric::Confidence;
use crate::statistics::{Extrapolation, grouped, interpolated};
use std::sync::LazyLock;

/// A measured front.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredFront {
    /// (t/√(a/(2g)), x/a) `[-]`, in ascending order.
    pub points: Vec<(f64, f64)>,
    /// Source of the points.
    pub source: String,
    /// Confidence in the points.
    pub confidence: Confidence,
    /// Name in figures.
    pub name: &'static str,
    /// Half width of an even spread of readings, in x/a `[-]`.
    reading: f64,
}

/// Measured heights of the water at the wall.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredHeights {
    /// n², the height of the column over its width `[-]`.
    pub aspect_ratio: f64,
    /// (t/√(a/(2g)), height over that at first) `[-]`, in ascending order.
    pub points: Vec<(f64, f64)>,
    /// Source of the points.
    pub source: String,
    /// Confidence in the points.
    pub confidence: Confidence,
}

/// Half of the last digit of the heights `[-]`, as the deviation of an even spread.
pub const HEIGHT_READING: f64 = 0.005 / 1.732_050_807_568_877_2;

/// Heights of columns of water at their wall (Martin & Moyce 1952), from `reference-data/water-column/height.csv`.
pub static WATER_HEIGHTS: LazyLock<Vec<MeasuredHeights>> = LazyLock::new(|| {
    read_shipped("water-column/height.csv", |table| {
        let (columns, times, heights) = (table.numbers("column n²")?, table.numbers("time")?, table.numbers("height")?);
        let of = |aspect_ratio: f64| MeasuredHeights {
            aspect_ratio,
            points: (0..columns.len())
                .filter(|&row| columns[row] == aspect_ratio)
                .map(|row| (times[row] * std::f64::consts::SQRT_2, heights[row]))
                .collect(),
            source: table.metadata.source.clone(),
            confidence: table.metadata.confidence,
        };
        Ok(vec![of(1.0), of(2.0)])
    })
});

/// Name of a front's reader or experimenter, and its points (t/√(a/(2g)), x/a) `[-]`.
pub type NamedFront = (String, Vec<(f64, f64)>);

/// Fronts of columns twice as high as wide by other experimenters and readers, with their names: (t/√(a/(2g)), x/a) `[-]`.
pub static OTHER_WATER_FRONTS: LazyLock<Vec<NamedFront>> = LazyLock::new(|| {
    read_shipped("water-column/front-readings.csv", |table| {
        Ok(grouped(table.labels("reading")?.iter().cloned().zip(table.points("time", "front")?)))
    })
});

/// Relative standard deviation of the other fronts from that of the table, where both are known `[-]`: what experiments and readings of
/// them differ by, releases included.
pub fn spread_of_water_fronts() -> f64 {
    let inside = (Extrapolation::Nothing, Extrapolation::Nothing);
    let points = OTHER_WATER_FRONTS.iter().flat_map(|(_, points)| points);
    let squares: Vec<f64> = points
        .filter_map(|&(time, front)| Some((front / interpolated(&WATER_FRONT.points, time, inside)? - 1.0).powi(2)))
        .collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Largest difference between readings of Martin & Moyce's figure, in x/a `[-]`; `reference-data/water-column/README.md` has it.
const READING: f64 = 0.03;
/// Half a stroke of the vector figure, in x/a `[-]`: its points lie a hundredth apart.
const VECTOR_READING: f64 = 0.005;

impl MeasuredFront {
    /// Standard uncertainty of reading the figure, relative to the place, root mean square over the points `[-]`: that of an
    /// even spread within the difference between readings.
    pub fn relative_reading(&self) -> f64 {
        let square = |&(_, place): &(f64, f64)| (self.reading / place).powi(2) / 3.0;
        (self.points.iter().map(square).sum::<f64>() / self.points.len() as f64).sqrt()
    }
}

/// Front of a column twice as high as wide, from `reference-data/water-column`.
pub static WATER_FRONT: LazyLock<MeasuredFront> = LazyLock::new(|| {
    read_shipped("water-column/front.csv", |table| {
        let points = table.points("time", "front")?;
        let (source, confidence) = (table.metadata.source.clone(), table.metadata.confidence);
        Ok(MeasuredFront { points, source, confidence, name: "Martin & Moyce 1952", reading: READING })
    })
});

/// Front of a square column behind a gate, with its time converted from √(H/g) to √(a/(2g)).
pub static GATED_WATER_FRONT: LazyLock<MeasuredFront> = LazyLock::new(|| {
    read_shipped("water-column/front-gate.csv", |table| {
        let time = table.numbers("time")?.iter().map(|time| time * std::f64::consts::SQRT_2);
        let points = time.zip(table.numbers("front")?.iter().copied()).collect();
        let (source, confidence) = (table.metadata.source.clone(), table.metadata.confidence);
        Ok(MeasuredFront { points, source, confidence, name: "Lobovský et al. 2014", reading: VECTOR_READING })
    })
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_fall_and_other_fronts_lie_about_the_table() {
        for (heights, number) in WATER_HEIGHTS.iter().zip([8, 16]) {
            assert_eq!(heights.points.len(), number);
            assert!(heights.points.is_sorted_by(|one, other| one.0 < other.0 && one.1 > other.1));
        }
        assert_eq!(OTHER_WATER_FRONTS.len(), 4);
        let spread = spread_of_water_fronts();
        assert!((0.01..0.08).contains(&spread), "{spread}");
    }

    /// After the release the front of a square column tends to a constant speed, 1.3 to 1.6 √(g H) in experiments; twice that is
    /// the bound of shallow water.
    #[test]
    fn fronts_are_in_the_units_that_they_say() {
        for (front, height_over_width) in [(&WATER_FRONT, 2.0_f64), (&GATED_WATER_FRONT, 1.0)] {
            let last = &front.points[front.points.len() - 3..];
            let slope = (last[2].1 - last[0].1) / (last[2].0 - last[0].0);
            // x/a over t/√(a/2g), in √(g H)
            let speed = slope * (2.0 / height_over_width).sqrt();
            assert!((1.0..2.0).contains(&speed), "{}: {speed} √(g H)", front.name);
            assert!(front.points.is_sorted_by(|one, other| one.0 < other.0));
        }
    }
}
