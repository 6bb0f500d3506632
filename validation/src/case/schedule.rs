//! Runs of one or many cases on the threads at hand: longest first, results in fixed order.
//!
//! Every run gets a rayon pool of its own. In one shared pool a thread that waits for the last slice
//! of its own loop may pick up a whole other run, which would delay its own and spoil its timing.

use super::{CaseResult, Prepared, Progress};
use crate::error::InputError;
use crate::store::Store;
use std::sync::{Mutex, PoisonError};

/// Watches the work, for a progress bar. Called from several threads.
pub trait Monitor: Sync {
    /// A run begins; `run` counts over all cases in report order.
    fn started(&self, run: usize);
    /// `simulated` of `total` seconds of the run are done, with `particle_steps` particle-steps so far.
    fn advanced(&self, run: usize, simulated: f64, total: f64, particle_steps: f64);
    /// The run is done, or was taken from the store.
    fn finished(&self, run: usize);
}

/// A monitor that does nothing.
#[derive(Debug, Clone, Copy)]
pub struct Silent;

impl Monitor for Silent {
    fn started(&self, _run: usize) {}
    fn advanced(&self, _run: usize, _simulated: f64, _total: f64, _particle_steps: f64) {}
    fn finished(&self, _run: usize) {}
}

struct RunProgress<'a> {
    run: usize,
    monitor: &'a dyn Monitor,
}

impl Progress for RunProgress<'_> {
    fn advance(&self, simulated: f64, total: f64, particle_steps: f64) {
        self.monitor.advanced(self.run, simulated, total, particle_steps);
    }
}

/// One run of one case.
#[derive(Debug, Clone, Copy)]
struct Job {
    case: usize,
    run: usize,
    /// Position over all cases, which the monitor knows it by.
    number: usize,
}

/// What the workers share.
struct Queue {
    /// Jobs not yet begun, the shortest first: the next one is popped off the end.
    waiting: Vec<Job>,
    /// Threads that no run uses.
    free: usize,
    /// The first error; it stops the rest.
    error: Option<InputError>,
}

/// Simulates all runs of all cases on the current rayon pool's number of threads and judges them.
///
/// # Errors
/// The first run whose parameters give no valid scene; runs that have not begun are then left.
pub fn execute(
    cases: Vec<Box<dyn Prepared>>,
    store: &Store,
    monitor: &dyn Monitor,
) -> Result<Vec<CaseResult>, InputError> {
    let mut jobs: Vec<Job> = cases
        .iter()
        .enumerate()
        .flat_map(|(case, prepared)| (0..prepared.run_count()).map(move |run| (case, run)))
        .enumerate()
        .map(|(number, (case, run))| Job { case, run, number })
        .collect();
    let cost = |job: &Job| cases[job.case].particle_steps(job.run);
    // Later jobs of equal cost go first in the list, so that they are popped last.
    jobs.sort_by(|a, b| cost(a).total_cmp(&cost(b)).then(b.number.cmp(&a.number)));

    let threads = rayon::current_num_threads();
    let workers = threads.min(jobs.len());
    let queue = Mutex::new(Queue { waiting: jobs, free: threads, error: None });
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| work(&cases, &queue, store, monitor));
        }
    });
    match queue.into_inner().unwrap_or_else(PoisonError::into_inner).error {
        Some(error) => Err(error),
        None => Ok(cases.into_iter().map(Prepared::finish).collect()),
    }
}

/// One worker: takes the longest waiting run and a fair share of the free threads until nothing waits.
fn work(cases: &[Box<dyn Prepared>], queue: &Mutex<Queue>, store: &Store, monitor: &dyn Monitor) {
    let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
    loop {
        let (job, share) = {
            let mut state = lock();
            // One thread each while there are more runs than threads; only the last few run on several.
            // A share leaves enough for the others, so a worker that finds a run also finds a thread.
            let share = (state.free / state.waiting.len().max(1)).max(1);
            let Some(job) = state.waiting.pop() else { return };
            state.free = state.free.saturating_sub(share);
            (job, share)
        };
        monitor.started(job.number);
        let progress = RunProgress { run: job.number, monitor };
        let outcome = rayon::ThreadPoolBuilder::new()
            .num_threads(share)
            .build()
            .map_err(|error| InputError::Threads { threads: share, reason: error.to_string() })
            .and_then(|pool| pool.install(|| cases[job.case].simulate(job.run, store, &progress)));
        monitor.finished(job.number);

        let mut state = lock();
        state.free += share;
        if let Err(error) = outcome {
            state.waiting.clear();
            state.error.get_or_insert(error);
        }
    }
}
