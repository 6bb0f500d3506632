//! Records by what they were computed for.

use super::Record;
use super::run::{BedLoad1dRun, Purpose};
use crate::observation::Outcome;
use crate::reference::bed_load_layer::LayerState;

/// Layers from rest with the case's closures, that became steady.
pub(super) fn literature(records: &[Record]) -> impl Iterator<Item = (&BedLoad1dRun, &LayerState)> {
    of(records, |purpose| *purpose == Purpose::Literature)
}

/// Steady layers of a purpose.
pub(super) fn of(
    records: &[Record],
    wanted: impl Fn(&Purpose) -> bool,
) -> impl Iterator<Item = (&BedLoad1dRun, &LayerState)> {
    records
        .iter()
        .filter(move |(run, record)| wanted(&run.purpose) && !matches!(record.outcome, Outcome::Diverged { .. }))
        .map(|(run, record)| (run, &record.data.state))
}
