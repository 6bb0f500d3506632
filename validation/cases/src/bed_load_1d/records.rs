//! Records by what they were computed for, and what a value is known to by inputs that were varied.

use super::BedLoad1dRecord;
use super::flow::{BedLoad1dFlow, LayerStart};
use super::run::BedLoadLayerObservation;
use crate::case::Flow;
use crate::metric::Variant;
use crate::observation::Outcome;
use crate::reference::bed_load::MeasuredBedLoad;
use crate::reference::one_dimension::bed_load::LayerState;

/// A run with its steady layer.
pub(super) type SolvedLayer<'a> = (&'a BedLoad1dFlow, &'a LayerState);

/// Steady layers.
pub(super) fn of(
    records: &[BedLoad1dRecord],
    wanted: impl Fn(&BedLoad1dFlow) -> bool,
) -> impl Iterator<Item = SolvedLayer<'_>> {
    records
        .iter()
        .filter(move |(run, record)| wanted(run) && !matches!(record.outcome, Outcome::Diverged { .. }))
        .map(|(run, record)| (run, &record.data.state))
}

/// Steady layers on the slope of a run.
pub(super) fn on_slope<'a>(
    records: &'a [BedLoad1dRecord],
    run: &'a BedLoad1dFlow,
    wanted: impl Fn(&BedLoad1dFlow) -> bool,
) -> impl Iterator<Item = SolvedLayer<'a>> {
    of(records, wanted).filter(|(other, _)| other.stream().slope == run.stream().slope)
}

/// Layers about the onset of motion.
pub(super) fn scans(records: &[BedLoad1dRecord]) -> impl Iterator<Item = (&BedLoad1dFlow, &BedLoadLayerObservation)> {
    records.iter().filter(|(run, _)| run.seeks_onset()).map(|(run, record)| (run, &record.data))
}

/// Layers from both starts with the stream of a measured one.
pub(super) fn measured_layers(
    records: &[BedLoad1dRecord],
) -> impl Iterator<Item = (&BedLoad1dRecord, MeasuredBedLoad)> {
    let judged = records.iter().filter(|(run, _)| run.start == LayerStart::Both);
    judged.filter_map(|record| Some((record, record.0.measured()?)))
}

/// The other state of a layer that has two.
pub(super) fn second_variant(run: &BedLoad1dFlow) -> Variant {
    run.variant().and("start", "fast")
}

/// (height above where grains begin to move, over d; u_f/u_*) of the cells among moving grains.
pub(super) fn lowest_layer(run: &BedLoad1dFlow, state: &LayerState, speed: f64) -> Vec<(f64, f64)> {
    let Some(bottom) = state.moves_above(speed) else { return Vec::new() };
    let top = state.top_of_grains();
    let stream = run.stream();
    let cells = state.height.iter().zip(&state.fluid_velocity).filter(|(z, u)| **z > bottom && **z < top && **u > 0.0);
    cells.map(|(z, u)| ((z - bottom) / stream.grain_diameter, u / stream.shear_velocity())).collect()
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

    /// Meaning of the ranges.
    pub(super) fn words(&self) -> String {
        let words = self.ranges.iter().map(|(name, low, high)| format!("{name} {low:.3} to {high:.3}"));
        format!("the value over the range of each input: {}", words.collect::<Vec<_>>().join(", "))
    }
}
