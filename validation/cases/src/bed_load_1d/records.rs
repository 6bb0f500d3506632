//! Records by what they were computed for.

use super::BedLoad1dRecord;
use super::run::{BedLoad1dRun, LayerPurpose};
use crate::observation::Outcome;
use crate::reference::one_dimension::bed_load::LayerState;

/// Layers from rest with the case's closures, that became steady.
pub(super) fn literature(records: &[BedLoad1dRecord]) -> impl Iterator<Item = (&BedLoad1dRun, &LayerState)> {
    of(records, |purpose| *purpose == LayerPurpose::Literature)
}

/// Steady layers of a purpose.
pub(super) fn of(
    records: &[BedLoad1dRecord],
    wanted: impl Fn(&LayerPurpose) -> bool,
) -> impl Iterator<Item = (&BedLoad1dRun, &LayerState)> {
    records
        .iter()
        .filter(move |(run, record)| wanted(&run.purpose) && !matches!(record.outcome, Outcome::Diverged { .. }))
        .map(|(run, record)| (run, &record.data.state))
}
