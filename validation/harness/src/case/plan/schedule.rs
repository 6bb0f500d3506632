//! Runs of one or many cases on the threads at hand: longest first, results in fixed order.
//!
//! Every run gets a rayon pool of its own. In one shared pool a thread that waits for the last slice
//! of its own loop may pick up a whole other run, which would delay its own and spoil its timing.

use super::progress::{Monitor, Progress};
use crate::case::given::error::ParameterError;
use crate::case::{CaseResult, PreparedCase};
use crate::checkpoint::is_interrupted;
use crate::store::Store;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

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

/// A pool of a given number of threads; 0 stands for one per core, or what rayon's own variable says.
///
/// # Errors
/// Threads that cannot be started.
pub fn pool(threads: usize) -> Result<rayon::ThreadPool, ParameterError> {
    let built = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    built.map_err(|error| ParameterError::Threads { threads, reason: error.to_string() })
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
            let outcome = pool(share).map_err(E::from).and_then(|pool| pool.install(|| work(job)));
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
    let runs = cases.iter().enumerate().flat_map(|(case, own)| (0..own.run_count()).map(move |run| (case, run)));
    // each with its position over all cases, which the monitor knows it by
    let mut jobs: Vec<(usize, (usize, usize))> = runs.enumerate().collect();
    let cost = |&(_, (case, run)): &(usize, (usize, usize))| cases[case].estimate(run).core_seconds;
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
