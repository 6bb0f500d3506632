//! Progress of runs, and who watches it.

use crate::case::{Conditions, StateOutput};
use crate::checkpoint::Checkpoints;
use std::sync::OnceLock;

/// Watches the work, for a progress bar. Called from several threads.
pub trait Monitor: Sync {
    /// A run begins; `run` counts over all cases in report order.
    fn started(&self, _run: usize) {}
    /// `simulated` of `total` seconds of the run are done, with `particle_steps` particle-steps so far.
    fn advanced(&self, _run: usize, _simulated: f64, _total: f64, _particle_steps: f64) {}
    /// News of the run: where it resumes, or why it begins anew.
    fn told(&self, _run: usize, _news: &str) {}
    /// The run is done, or was taken from the store.
    fn finished(&self, _run: usize) {}
    /// Receiver of states during the run; a run with a receiver is never taken from the store.
    fn output(&self, _run: usize) -> Option<&dyn StateOutput> {
        None
    }
}

/// A monitor that does nothing.
#[derive(Debug, Clone, Copy)]
pub struct Silent;

impl Monitor for Silent {}

/// Progress of a run: who watches it, and what is kept of it.
#[derive(Clone, Copy)]
pub struct Progress<'a> {
    pub(super) run: usize,
    pub(super) monitor: &'a dyn Monitor,
    /// Checkpoints of the run; none if nothing is kept.
    pub checkpoints: Option<&'a Checkpoints>,
    /// States near the end of finished runs that this one may continue, and the place of its own; none if nothing is kept.
    pub ends: Option<&'a Checkpoints>,
    /// Place for boundaries and start of the run, which then ends before its first step; none for a run that is simulated.
    pub conditions: Option<&'a OnceLock<Conditions>>,
}

impl<'a> Progress<'a> {
    /// Progress without a monitor.
    pub const SILENT: Progress<'static> = Progress::of(&Silent, 0);

    pub(super) const fn of(monitor: &'a dyn Monitor, run: usize) -> Self {
        Self { run, monitor, checkpoints: None, ends: None, conditions: None }
    }

    /// `simulated` of `total` seconds are done, with `particle_steps` particle-steps so far. Called often, must be cheap.
    pub fn advance(&self, simulated: f64, total: f64, particle_steps: f64) {
        self.monitor.advanced(self.run, simulated, total, particle_steps);
    }

    /// Message about the run: where it resumes, or why it starts from the beginning.
    pub fn tell(&self, news: &str) {
        self.monitor.told(self.run, news);
    }

    /// Receiver of states during the run; none if no states are requested.
    pub fn output(&self) -> Option<&'a dyn StateOutput> {
        self.monitor.output(self.run)
    }
}
