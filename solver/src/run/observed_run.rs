//! The loop of a run: steps until an end time, with an observer on the way.

use crate::run::{Divergence, StopReason};
use std::ops::ControlFlow;

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

/// Runs until `end` `[s]`, calling `observe` at the start, then at the first step after every multiple of `interval`
/// `[s]`, and at the end. The observer ends the run with [`ControlFlow::Break`].
pub(crate) fn run<S: Stepping<D>, const D: usize>(
    simulation: &mut S,
    end: f64,
    interval: f64,
    mut observe: impl FnMut(&S) -> ControlFlow<()>,
) -> StopReason<D> {
    let origin = simulation.now();
    let mut observed = 0u64;
    let mut observed_step = simulation.steps_taken();
    if observe(simulation).is_break() {
        return StopReason::Stopped;
    }
    // half a step of slack, so that rounding does not add a step
    while simulation.now() < end - 0.5 * simulation.next_step() {
        if let Err(divergence) = simulation.take_one() {
            return StopReason::Diverged(divergence);
        }
        let due = ((simulation.now() - origin) / interval + 1e-9).floor() as u64;
        if due > observed {
            observed = due;
            observed_step = simulation.steps_taken();
            if observe(simulation).is_break() {
                return StopReason::Stopped;
            }
        }
    }
    if observed_step < simulation.steps_taken() && observe(simulation).is_break() {
        return StopReason::Stopped;
    }
    StopReason::Finished
}
