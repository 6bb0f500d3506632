//! Records by what they were computed for, and what a value is known to by inputs that were varied.

use super::BedLoad1dRecord;
use super::quantities::START_DIFFERENCE;
use super::run::{BedLoad1dRun, LayerPurpose, ONE_STATE, ONE_STATE_REASON};
use crate::case::Run;
use crate::metric::{Limit, Metric, Variant};
use crate::observation::Outcome;
use crate::reference::one_dimension::bed_load::LayerState;

/// A run with its steady layer.
pub(super) type SolvedLayer<'a> = (&'a BedLoad1dRun, &'a LayerState);

/// Layers from rest with the case's closures, that became steady.
pub(super) fn literature(records: &[BedLoad1dRecord]) -> impl Iterator<Item = SolvedLayer<'_>> {
    of(records, |purpose| *purpose == LayerPurpose::Literature)
}

/// Steady layers of a purpose.
pub(super) fn of(
    records: &[BedLoad1dRecord],
    wanted: impl Fn(&LayerPurpose) -> bool,
) -> impl Iterator<Item = SolvedLayer<'_>> {
    records
        .iter()
        .filter(move |(run, record)| wanted(&run.purpose) && !matches!(record.outcome, Outcome::Diverged { .. }))
        .map(|(run, record)| (run, &record.data.state))
}

/// Steady layers of a purpose on the slope of a run.
pub(super) fn on_slope<'a>(
    records: &'a [BedLoad1dRecord],
    run: &'a BedLoad1dRun,
    wanted: impl Fn(&LayerPurpose) -> bool,
) -> impl Iterator<Item = SolvedLayer<'a>> {
    of(records, wanted).filter(|(other, _)| other.stream.slope == run.stream.slope)
}

/// The other state of a layer that has two.
pub(super) fn second_variant(run: &BedLoad1dRun) -> Variant {
    run.variant().and("start", "fast")
}

/// The difference of the states from two starts, judged.
pub(super) fn one_state(variant: &Variant, difference: f64, source: &str) -> Metric {
    START_DIFFERENCE
        .of(variant, difference)
        .exactly(0.0, source)
        .gated(Limit::AtMost(ONE_STATE), ONE_STATE_REASON)
        .with_snapshot_tolerance(1.0, 0.1 * ONE_STATE)
}

/// Ranges of a value over inputs, each varied alone.
#[derive(Debug, Default)]
pub(super) struct InputSpread {
    ranges: Vec<(&'static str, f64, f64)>,
}

impl InputSpread {
    /// Adds the value with an input varied; the range of the input holds the own value.
    pub(super) fn add(&mut self, input: &'static str, own: f64, varied: f64) {
        match self.ranges.iter_mut().find(|range| range.0 == input) {
            Some(range) => (range.1, range.2) = (range.1.min(varied), range.2.max(varied)),
            None => self.ranges.push((input, own.min(varied), own.max(varied))),
        }
    }

    /// Standard uncertainty of even spreads over all ranges; 0 without any.
    pub(super) fn standard(&self) -> f64 {
        self.ranges.iter().map(|(_, low, high)| (high - low) * (high - low) / 12.0).sum::<f64>().sqrt()
    }

    /// What the ranges are.
    pub(super) fn words(&self) -> String {
        let words = self.ranges.iter().map(|(name, low, high)| format!("{name} {low:.3} to {high:.3}"));
        format!("the value over the range of each input: {}", words.collect::<Vec<_>>().join(", "))
    }
}
