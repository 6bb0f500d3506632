//! The loop of a run: steps until an end time, with an observer on the way.

use crate::run::{Divergence, Observer, RunProgress, StopReason};

/// What can be run.
pub(crate) trait Stepping<const D: usize> {
    /// Time `[s]`.
    fn now(&self) -> f64;
    /// Steps taken.
    fn steps_taken(&self) -> u64;
    /// Length of the next step as far as it is known `[s]`.
    fn next_step(&self) -> f64;
    /// Takes one step.
    fn take_one(&mut self) -> Result<(), Divergence<D>>;
}

/// Runs along a course, showing the observer the state at the start, then at the first step after every multiple of its
/// interval, and at the end.
pub(crate) fn run<S: Stepping<D>, const D: usize>(
    simulation: &mut S,
    course: &mut RunProgress,
    observer: &mut impl Observer<S>,
) -> StopReason<D> {
    let origin = match course.origin {
        Some(origin) => origin,
        None => {
            let origin = *course.origin.insert(simulation.now());
            course.observed_step = simulation.steps_taken();
            if observer.observe(simulation).is_break() {
                return StopReason::Stopped;
            }
            origin
        }
    };
    // half a step of slack, so that rounding does not add a step
    while simulation.now() < course.end - 0.5 * simulation.next_step() {
        if observer.pause(simulation, course).is_break() {
            return StopReason::Interrupted;
        }
        if let Err(divergence) = simulation.take_one() {
            return StopReason::Diverged(divergence);
        }
        let due = ((simulation.now() - origin) / course.interval + 1e-9).floor() as u64;
        if due > course.observed {
            course.observed = due;
            course.observed_step = simulation.steps_taken();
            if observer.observe(simulation).is_break() {
                return StopReason::Stopped;
            }
        }
    }
    if course.observed_step < simulation.steps_taken() && observer.observe(simulation).is_break() {
        return StopReason::Stopped;
    }
    StopReason::Finished
}
