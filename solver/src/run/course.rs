//! Progress of a run between its observations.

use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Progress of a run: its end, and the observations already made. With the simulation and what its observer keeps, all
/// that the rest of the run follows from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RunProgress {
    /// End of the run `[s]`.
    pub(super) end: f64,
    /// Time between two observations `[s]`.
    pub(super) interval: f64,
    /// Time at its start `[s]`; none before it.
    pub(super) origin: Option<f64>,
    /// Observations that were due at this step.
    pub(super) observed: u64,
    /// Step of the last one.
    pub(super) observed_step: u64,
    /// Length of the next step as far as it is known `[s]`.
    pub(super) step: f64,
}

impl RunProgress {
    /// A run up to `end` `[s]`, observed at intervals `[s]`.
    #[must_use]
    pub fn new(end: f64, interval: f64) -> Self {
        Self { end, interval, origin: None, observed: 0, observed_step: 0, step: 0.0 }
    }

    /// Whether a time `[s]` lies within the last interval, or the last two steps, before another one `[s]`.
    #[must_use]
    pub fn nears(&self, time: f64, other: f64) -> bool {
        time < other && time >= other - self.interval.max(2.0 * self.step)
    }

    /// Course of the same run up to a later end `[s]`, observed at intervals `[s]`.
    ///
    /// # Errors
    /// An end that is not later, or another interval, as the rest of a sentence about the run.
    pub fn prolonged(self, end: f64, interval: f64) -> Result<Self, String> {
        if self.interval != interval {
            return Err(format!("was sampled every {} s, not every {interval} s", self.interval));
        }
        if self.end >= end {
            Err(format!("ended at {} s, not before {end} s", self.end))
        } else {
            Ok(Self { end, ..self })
        }
    }
}

/// Observer of a run, which may interrupt it between two steps.
pub trait Observer<S> {
    /// Sees a state that is due; [`ControlFlow::Break`] ends the run.
    fn observe(&mut self, simulation: &S) -> ControlFlow<()>;

    /// Called before every step. [`ControlFlow::Break`] interrupts the run, which the same course continues, with this
    /// simulation or with one that was saved here and has been continued.
    fn pause(&mut self, _simulation: &S, _course: &RunProgress) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// Observer made of a closure; it never interrupts.
pub(crate) struct Watching<F>(pub(crate) F);

impl<S, F: FnMut(&S) -> ControlFlow<()>> Observer<S> for Watching<F> {
    fn observe(&mut self, simulation: &S) -> ControlFlow<()> {
        (self.0)(simulation)
    }
}
