//! Runs of one or many cases on the threads at hand: longest first, results in fixed order.
//!
//! Every run gets a rayon pool of its own. In one shared pool a thread that waits for the last slice
//! of its own loop may pick up a whole other run, which would delay its own and spoil its timing.

use crate::case::given::error::ParameterError;
use crate::case::{CaseResult, Conditions, PreparedCase, StateOutput};
use crate::checkpoint::{Checkpoints, is_interrupted};
use crate::store::Store;
use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

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

    const fn of(monitor: &'a dyn Monitor, run: usize) -> Self {
        Self { run, monitor, checkpoints: None, ends: None, conditions: None }
    }

    /// `simulated` of `total` seconds are done, with `particle_steps` particle-steps so far. Called often, must be cheap.
    pub fn advance(&self, simulated: f64, total: f64, particle_steps: f64) {
        self.monitor.advanced(self.run, simulated, total, particle_steps);
    }

    /// News of the run for its user: where it resumes, or why it begins anew.
    pub fn tell(&self, news: &str) {
        self.monitor.told(self.run, news);
    }

    /// Receiver of states during the run; none if no states are requested.
    #[must_use]
    pub fn output(&self) -> Option<&'a dyn StateOutput> {
        self.monitor.output(self.run)
    }
}

/// State that the worker threads share.
struct Queue<J, R, E> {
    /// Jobs not yet begun with their places, the last first: the next one is popped off the end.
    waiting: Vec<(usize, J)>,
    /// Threads that no job uses.
    free: usize,
    /// Results by place.
    done: BTreeMap<usize, R>,
    /// The first error; it stops the rest.
    error: Option<E>,
}

/// The results of jobs, in the order of the jobs, begun in that order on the current rayon pool's number of threads: one thread
/// each while there are more jobs than threads, a fair share for the last few. Every job finds a pool of its own as the current one.
///
/// # Errors
/// The first job that fails; jobs that have not begun are then left.
pub fn share_out<J: Send, R: Send, E: From<ParameterError> + Send>(
    jobs: Vec<J>,
    work: impl Fn(J) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let threads = rayon::current_num_threads();
    let workers = threads.min(jobs.len());
    let waiting = jobs.into_iter().enumerate().rev().collect();
    let queue = Mutex::new(Queue { waiting, free: threads, done: BTreeMap::new(), error: None });
    let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
    let worker = || {
        loop {
            let ((place, job), share) = {
                let mut state = lock();
                // A share leaves enough for the others, so a worker that finds a job also finds a thread.
                let share = (state.free / state.waiting.len().max(1)).max(1);
                let Some(job) = state.waiting.pop() else { return };
                state.free = state.free.saturating_sub(share);
                (job, share)
            };
            let outcome = rayon::ThreadPoolBuilder::new()
                .num_threads(share)
                .build()
                .map_err(|error| ParameterError::Threads { threads: share, reason: error.to_string() }.into())
                .and_then(|pool| pool.install(|| work(job)));
            let mut state = lock();
            state.free += share;
            match outcome {
                Ok(result) => drop(state.done.insert(place, result)),
                Err(error) => {
                    state.waiting.clear();
                    state.error.get_or_insert(error);
                }
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(worker);
        }
    });
    let Queue { done, error, .. } = queue.into_inner().unwrap_or_else(PoisonError::into_inner);
    error.map_or_else(|| Ok(done.into_values().collect()), Err)
}

/// Simulates all runs of all cases on the current rayon pool's number of threads and judges them.
///
/// # Errors
/// The first run whose parameters give no valid scene; an interruption. Runs that have not begun are then left.
pub fn execute(
    cases: Vec<Box<dyn PreparedCase>>,
    store: &Store,
    monitor: &dyn Monitor,
) -> Result<Vec<CaseResult>, ParameterError> {
    let places = |(case, own): (usize, &Box<dyn PreparedCase>)| (0..own.run_count()).map(move |run| (case, run));
    let runs = cases.iter().enumerate().flat_map(places);
    // each with its position over all cases, which the monitor knows it by
    let mut jobs: Vec<(usize, (usize, usize))> = runs.enumerate().collect();
    let cost = |&(_, (case, run)): &(usize, (usize, usize))| cases[case].estimate(run).particle_steps;
    // The longest first; of equal cost the first first.
    jobs.sort_by(|a, b| cost(b).total_cmp(&cost(a)));
    share_out(jobs, |(number, (case, run))| {
        monitor.started(number);
        let outcome = cases[case].simulate(run, store, &Progress::of(monitor, number));
        monitor.finished(number);
        outcome
    })?;
    let results = cases.into_iter().map(PreparedCase::finish).collect::<Result<_, _>>()?;
    // a reference that was cut short is none
    if is_interrupted() { Err(ParameterError::Interrupted) } else { Ok(results) }
}
