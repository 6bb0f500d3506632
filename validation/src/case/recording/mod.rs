//! From a simulation that has ended to its record.
//!
//! [`record`] is all that a plain case needs; [`Ending`] is for those that observe on the way.

mod incompressible;
mod weakly_compressible;

use crate::case::Progress;
use crate::observation::{Frame, Outcome, Recorded, state_hash};
use bagnold_solver::run::StopReason;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use std::ops::ControlFlow;
use std::time::Instant;

/// A state of a simulation.
pub trait State {
    /// Its bits in a fixed order.
    fn bits(&self) -> Vec<u8>;
    /// A picture of it, in the plane or in space.
    fn frame(&self) -> Frame;
}

/// A simulation that can be recorded.
pub trait Recordable {
    /// Its states.
    type State: State;
    /// A copy of the present state.
    fn state(&self) -> Self::State;
    /// Particles that move.
    fn particles(&self) -> usize;
    /// Steps taken.
    fn steps(&self) -> u64;
    /// Time `[s]`.
    fn time(&self) -> f64;
}

/// Runs a weakly compressible simulation up to a time `[s]` and records it, with the data that `measure` takes from the
/// last state.
pub fn record<const D: usize, O>(
    simulation: &mut Simulation<D>,
    end: f64,
    progress: &dyn Progress,
    measure: impl FnOnce(&Snapshot<D>) -> O,
) -> Recorded<O>
where
    Simulation<D>: Compiled<D>,
{
    watch(simulation, (end, 0.01 * end), progress, |_| ControlFlow::Continue(())).record(simulation, measure)
}

/// Runs a weakly compressible simulation up to a time and shows its states to `observe` at intervals, until that breaks.
/// How it ended is told as of a run that has left no frames, that does not say why it was stopped, and whose divergence
/// would be an error.
pub fn watch<const D: usize>(
    simulation: &mut Simulation<D>,
    (end, interval): (f64, f64),
    progress: &dyn Progress,
    mut observe: impl FnMut(&Snapshot<D>) -> ControlFlow<()>,
) -> Ending<D>
where
    Simulation<D>: Compiled<D>,
{
    let started = Instant::now();
    let mut last_good = simulation.snapshot();
    let reason = simulation.run(end, interval, |simulation| {
        last_good = simulation.snapshot();
        progress.advance(last_good.time, end, simulation.steps() as f64 * last_good.mass.len() as f64);
        observe(&last_good)
    });
    Ending { reason, last_good, criterion: String::new(), may_diverge: false, frames: Vec::new(), started }
}

/// How a run ended, and what it left on its way.
pub struct Ending<const D: usize, S = Snapshot<D>> {
    /// Why it ended.
    pub reason: StopReason<D>,
    /// The state that was observed last.
    pub last_good: S,
    /// The criterion by which the observer stops a run, in words.
    pub criterion: String,
    /// Whether a divergence is a result and not an error.
    pub may_diverge: bool,
    /// Pictures on the way; the last state is added to them.
    pub frames: Vec<Frame>,
    /// When the run was started.
    pub started: Instant,
}

impl<const D: usize, S: State> Ending<D, S> {
    /// The record, with the data that `measure` takes from the last state: the last good one after a divergence.
    pub fn record<O>(self, simulation: &impl Recordable<State = S>, measure: impl FnOnce(&S) -> O) -> Recorded<O> {
        let (outcome, end) = match self.reason {
            StopReason::Finished => (Outcome::Finished, simulation.state()),
            StopReason::Stopped => (Outcome::Stopped { criterion: self.criterion }, simulation.state()),
            StopReason::Diverged(divergence) => {
                (Outcome::Diverged { message: divergence.to_string(), expected: self.may_diverge }, self.last_good)
            }
        };
        let mut frames = self.frames;
        frames.push(end.frame());
        Recorded {
            outcome,
            state_hash: state_hash(&end.bits()),
            particles: simulation.particles(),
            steps: simulation.steps(),
            simulated_time: simulation.time(),
            wall_seconds: self.started.elapsed().as_secs_f64(),
            threads: rayon::current_num_threads(),
            frames,
            data: measure(&end),
        }
    }
}
