//! Avalanches of beads under a viscous liquid, measured by Pailha, Nicolas & Pouliquen (2008), and a layer without
//! particles by another implementation: tables of `reference-data/submerged-layer`.

use crate::evidence::{MeasuredData, ReferenceError};
use crate::evidence::{read_shipped, shipped_table};
use crate::metric::Confidence;
use crate::statistics::{Extrapolation, interpolated};
use std::sync::LazyLock;

/// A value over time: times `[s]` and values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimeCurve {
    /// (time `[s]`, value) in the order of time.
    pub points: Vec<(f64, f64)>,
}

impl TimeCurve {
    /// Value at a time, straight between points; the value of an end beyond it; NaN of a curve without points.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        let ends = (Extrapolation::EndValue, Extrapolation::EndValue);
        interpolated(&self.points, time, ends).unwrap_or(f64::NAN)
    }

    /// First time at which the value reaches a level, straight between points; none if it does not.
    #[must_use]
    pub fn time_to(&self, level: f64) -> Option<f64> {
        let next = self.points.iter().position(|point| point.1 >= level)?;
        let (time, value) = self.points[next];
        let Some(&(before, lower)) = next.checked_sub(1).and_then(|last| self.points.get(last)) else {
            return Some(time);
        };
        Some(before + (level - lower) / (value - lower) * (time - before))
    }

    /// Last point.
    #[must_use]
    pub fn end(&self) -> (f64, f64) {
        self.points.last().copied().unwrap_or((f64::NAN, f64::NAN))
    }
}

/// An avalanche from one initial solid fraction.
#[derive(Debug, Clone, PartialEq)]
pub struct SubmergedAvalanche {
    /// Initial solid fraction `[-]`.
    pub solid_fraction: f64,
    /// Surface velocity `[mm/s]` over the time since tilting.
    pub surface_velocity: TimeCurve,
    /// Excess pore pressure at the floor `[Pa]` over the time since tilting.
    pub pore_pressure: TimeCurve,
}

/// The avalanches of the experiment.
#[derive(Debug, Clone, PartialEq)]
pub struct SubmergedAvalanches {
    /// Avalanches in the order of their solid fractions.
    pub runs: Vec<SubmergedAvalanche>,
    /// Source.
    pub source: String,
    /// Confidence.
    pub confidence: Confidence,
}

impl SubmergedAvalanches {
    /// Avalanche from a solid fraction.
    #[must_use]
    pub fn of(&self, solid_fraction: f64) -> Option<&SubmergedAvalanche> {
        self.runs.iter().find(|run| (run.solid_fraction - solid_fraction).abs() < 1e-9)
    }
}

/// The experiment.
pub static SUBMERGED_AVALANCHES: LazyLock<SubmergedAvalanches> = LazyLock::new(|| {
    read_shipped("submerged-layer/measured-velocity.csv", |velocity| {
        let pressure = shipped_table("submerged-layer/measured-pressure.csv")?;
        let mut fractions = velocity.numbers("solid fraction")?.to_vec();
        fractions.dedup();
        let run = |solid_fraction| -> Result<SubmergedAvalanche, ReferenceError> {
            Ok(SubmergedAvalanche {
                solid_fraction,
                surface_velocity: curve(velocity, "surface velocity", solid_fraction)?,
                pore_pressure: curve(&pressure, "pore pressure", solid_fraction)?,
            })
        };
        Ok(SubmergedAvalanches {
            runs: fractions.into_iter().map(run).collect::<Result<_, _>>()?,
            source: velocity.metadata.source.clone(),
            confidence: velocity.metadata.confidence,
        })
    })
});

/// The rows of one solid fraction.
fn curve(table: &MeasuredData, column: &str, solid_fraction: f64) -> Result<TimeCurve, ReferenceError> {
    let fractions = table.numbers("solid fraction")?;
    let points = table.numbers("time")?.iter().copied().zip(table.numbers(column)?.iter().copied());
    let own = points.zip(fractions).filter(|(_, fraction)| **fraction == solid_fraction);
    Ok(TimeCurve { points: own.map(|(point, _)| point).collect() })
}

/// Layers by another implementation.
#[derive(Debug, Clone, PartialEq)]
pub struct IndependentLayers {
    /// Initial solid fraction `[-]` with times to 0.1 and 0.3 mm/s `[s]` (infinite where not reached), velocity at the end of the
    /// measured curve `[mm/s]`, pore pressure at the floor after 20 s and at the end of the measured curve `[Pa]`.
    pub rows: Vec<(f64, [f64; 5])>,
    /// Source.
    pub source: String,
}

/// The independent implementation.
pub static INDEPENDENT_LAYERS: LazyLock<IndependentLayers> = LazyLock::new(|| {
    read_shipped("submerged-layer/independent-layer.csv", |table| {
        let onset = table.numbers("onset")?;
        let acceleration = table.upper_ends("acceleration")?;
        let [end, early, last] =
            ["end velocity", "pore pressure at 20 s", "end pressure"].map(|name| table.numbers(name));
        let (end, early, last) = (end?, early?, last?);
        let row = |(k, &fraction): (usize, &f64)| (fraction, [onset[k], acceleration[k], end[k], early[k], last[k]]);
        let rows = table.numbers("solid fraction")?.iter().enumerate().map(row).collect();
        Ok(IndependentLayers { rows, source: table.metadata.source.clone() })
    })
});

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_measured_curves_have_the_onsets_and_pressures_of_the_recipe() {
        let avalanches = &*SUBMERGED_AVALANCHES;
        assert_eq!(avalanches.runs.len(), 7);
        let onset = |fraction| avalanches.of(fraction).and_then(|run| run.surface_velocity.time_to(0.1));
        for (fraction, expected) in [(0.578, 4.1), (0.584, 98.0), (0.588, 177.0), (0.592, 315.0)] {
            assert!(
                onset(fraction).is_some_and(|time| (time - expected).abs() < 0.5),
                "{fraction}: {:?}",
                onset(fraction)
            );
        }
        let pressure = avalanches.of(0.584).map(|run| run.pore_pressure.at(20.0));
        assert!(pressure.is_some_and(|pressure| (pressure + 2.45).abs() < 0.01), "{pressure:?}");
        assert_eq!(INDEPENDENT_LAYERS.rows.len(), avalanches.runs.len());
    }

    #[test]
    fn a_curve_is_straight_between_its_points() {
        let curve = TimeCurve { points: vec![(1.0, 0.0), (3.0, 4.0), (5.0, 4.0)] };
        assert_eq!((curve.at(2.0), curve.at(0.0), curve.at(9.0)), (2.0, 0.0, 4.0));
        assert_eq!((curve.time_to(1.0), curve.time_to(5.0), curve.time_to(-1.0)), (Some(1.5), None, Some(1.0)));
        assert_eq!(curve.end(), (5.0, 4.0));
    }
}
