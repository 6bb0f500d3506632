//! Runs of one or many cases on the threads at hand: longest first, results in fixed order.
//!
//! Every run gets a rayon pool of its own. In one shared pool a thread that waits for the last slice
//! of its own loop may pick up a whole other run, which would delay its own and spoil its timing.

use crate::case::given::error::ParameterError;
use crate::case::{CaseResult, PreparedCase, Progress, StateOutput};
use crate::checkpoint::is_interrupted;
use crate::store::Store;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Watches the work, for a progress bar. Called from several threads.
pub trait Monitor: Sync {
    /// A run begins; `run` counts over all cases in report order.
    fn started(&self, run: usize);
    /// `simulated` of `total` seconds of the run are done, with `particle_steps` particle-steps so far.
    fn advanced(&self, run: usize, simulated: f64, total: f64, particle_steps: f64);
    /// News of the run: where it resumes, or why it begins anew.
    fn told(&self, run: usize, news: &str);
    /// The run is done, or was taken from the store.
    fn finished(&self, run: usize);
    /// Receiver of states during the run; a run with a receiver is never taken from the store.
    fn output(&self, _run: usize) -> Option<&dyn StateOutput> {
        None
    }
}

/// A monitor that does nothing.
#[derive(Debug, Clone, Copy)]
pub struct Silent;

impl Monitor for Silent {
    fn started(&self, _run: usize) {}
    fn advanced(&self, _run: usize, _simulated: f64, _total: f64, _particle_steps: f64) {}
    fn told(&self, _run: usize, _news: &str) {}
    fn finished(&self, _run: usize) {}
}

/// No-op monitor.
impl Progress for Silent {
    fn advance(&self, _simulated: f64, _total: f64, _particle_steps: f64) {}
    fn tell(&self, _news: &str) {}
}

struct MonitoredRun<'a> {
    run: usize,
    monitor: &'a dyn Monitor,
}

impl Progress for MonitoredRun<'_> {
    fn advance(&self, simulated: f64, total: f64, particle_steps: f64) {
        self.monitor.advanced(self.run, simulated, total, particle_steps);
    }

    fn tell(&self, news: &str) {
        self.monitor.told(self.run, news);
    }

    fn output(&self) -> Option<&dyn StateOutput> {
        self.monitor.output(self.run)
    }
}

/// One run of one case.
#[derive(Debug, Clone, Copy)]
struct ScheduledRun {
    case: usize,
    run: usize,
    /// Position over all cases, which the monitor knows it by.
    number: usize,
}

/// State that the worker threads share.
struct Queue<J, E> {
    /// Jobs not yet begun, the last first: the next one is popped off the end.
    waiting: Vec<J>,
    /// Threads that no job uses.
    free: usize,
    /// The first error; it stops the rest.
    error: Option<E>,
}

/// Does jobs, the first first, on the current rayon pool's number of threads: one thread each while there are more jobs
/// than threads, a fair share for the last few. Every job finds a pool of its own as the current one.
///
/// # Errors
/// The first job that fails; jobs that have not begun are then left.
pub fn share_out<J: Send, E: From<ParameterError> + Send>(
    mut jobs: Vec<J>,
    work: impl Fn(J) -> Result<(), E> + Sync,
) -> Result<(), E> {
    jobs.reverse();
    let threads = rayon::current_num_threads();
    let workers = threads.min(jobs.len());
    let queue = Mutex::new(Queue { waiting: jobs, free: threads, error: None });
    let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
    let worker = || {
        loop {
            let (job, share) = {
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
            if let Err(error) = outcome {
                state.waiting.clear();
                state.error.get_or_insert(error);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(worker);
        }
    });
    match queue.into_inner().unwrap_or_else(PoisonError::into_inner).error {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

/// The results of jobs, in the order of the jobs; else as [`share_out`].
///
/// # Errors
/// The first job that fails; jobs that have not begun are then left.
pub fn share_out_for<J: Send, R: Send, E: From<ParameterError> + Send>(
    jobs: Vec<J>,
    work: impl Fn(J) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    let given = Mutex::new(BTreeMap::new());
    share_out(jobs.into_iter().enumerate().collect(), |(place, job)| {
        let result = work(job)?;
        given.lock().unwrap_or_else(PoisonError::into_inner).insert(place, result);
        Ok::<(), E>(())
    })?;
    Ok(given.into_inner().unwrap_or_else(PoisonError::into_inner).into_values().collect())
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
    let mut jobs: Vec<ScheduledRun> = cases
        .iter()
        .enumerate()
        .flat_map(|(case, prepared)| (0..prepared.run_count()).map(move |run| (case, run)))
        .enumerate()
        .map(|(number, (case, run))| ScheduledRun { case, run, number })
        .collect();
    let cost = |job: &ScheduledRun| cases[job.case].particle_steps(job.run);
    // The longest first; of equal cost the first first.
    jobs.sort_by(|a, b| cost(b).total_cmp(&cost(a)).then(a.number.cmp(&b.number)));
    share_out(jobs, |job| {
        monitor.started(job.number);
        let progress = MonitoredRun { run: job.number, monitor };
        let outcome = cases[job.case].simulate(job.run, store, &progress);
        monitor.finished(job.number);
        outcome
    })?;
    let results = cases.into_iter().map(PreparedCase::finish).collect::<Result<_, _>>()?;
    // a reference that was cut short is none
    if is_interrupted() { Err(ParameterError::Interrupted) } else { Ok(results) }
}
