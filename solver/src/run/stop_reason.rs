//! Reasons for the end of a run.

use super::Divergence;

/// Reason for the end of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum StopReason<const D: usize> {
    /// Reached its end time.
    Finished,
    /// The observer asked to stop.
    Stopped,
    /// The observer interrupted it between two steps; its course continues it.
    Interrupted,
    /// Diverged; the last good state is the last observed one.
    Diverged(Divergence<D>),
}
