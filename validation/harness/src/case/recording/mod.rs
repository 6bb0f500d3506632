//! From a simulation that has ended to its record.
//!
//! [`record`] is all that a plain case needs; [`watch`] and [`Ending`] are for those that observe on the way, and [`follow`]
//! for those that want to see more than states at intervals. All of them can be interrupted between two steps and
//! continued by another program, with what they have observed.

mod incompressible;
mod picture;
mod restart;
mod weakly_compressible;

pub use restart::{Restartable, RestartableRun, SimulationStage, StartState, Stop, follow, resumed};

use crate::case::{ParameterError, Progress};
use crate::observation::{Frame, Outcome, Recorded, state_hash};
use bagnold_solver::run::SceneError;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use serde::{Serialize, de::DeserializeOwned};
use std::ops::ControlFlow;
use std::time::Instant;

/// Runs a weakly compressible simulation of a scene up to a time `[s]` and records it, with the data that `measure` takes
/// from the last state.
///
/// # Errors
/// A scene that breaks a rule; an interruption.
pub fn record<const D: usize, O>(
    scene: impl Fn() -> Scene<D>,
    end: f64,
    progress: &Progress,
    measure: impl FnOnce(&Snapshot<D>) -> O,
) -> Result<Recorded<O>, ParameterError>
where
    Simulation<D>: Compiled<D>,
{
    let stage = SimulationStage { progress, end, interval: 0.01 * end, window: 0.0, context: &() };
    let watched = watch(stage, |_| Ok(scene()), |_| (), |(), _| ControlFlow::Continue(()))?;
    Ok(watched.ending.record(&watched.simulation, measure))
}

/// Simulation at its end, how it ended, and what its observer has kept.
pub struct ObservedRun<const D: usize, O> {
    /// The simulation at its end.
    pub simulation: Simulation<D>,
    /// End of the run with defaults: no frames, no criterion of the observer, and a divergence is an error.
    pub ending: Ending<Snapshot<D>>,
    /// Data that the observer has kept.
    pub kept: O,
}

/// Runs a weakly compressible simulation of a scene up to a time and shows its states to `observe` at intervals, until that
/// breaks, together with what it keeps: `keep` makes that at the start of a new run.
///
/// # Errors
/// A scene that breaks a rule; an interruption.
pub fn watch<const D: usize, O, C>(
    stage: SimulationStage<'_, C>,
    scene: impl Fn(StartState) -> Result<Scene<D>, SceneError>,
    keep: impl FnOnce(&Simulation<D>) -> O,
    mut observe: impl FnMut(&mut O, &Snapshot<D>) -> ControlFlow<()>,
) -> Result<ObservedRun<D, O>, ParameterError>
where
    Simulation<D>: Compiled<D>,
    O: Serialize + DeserializeOwned,
    C: Serialize + DeserializeOwned,
{
    let SimulationStage { progress, end, .. } = stage;
    let followed = follow(
        stage,
        None,
        scene,
        |simulation: &Simulation<D>| (simulation.snapshot(), keep(simulation)),
        |(last_good, kept), simulation| {
            *last_good = simulation.snapshot();
            progress.advance(last_good.time, end, simulation.steps() as f64 * last_good.mass.len() as f64);
            observe(kept, last_good)
        },
        |_| Ok(()),
    )?;
    let RestartableRun { simulation, stop, kept: (last_good, kept), started } = followed;
    Ok(ObservedRun { simulation, ending: Ending::of(stop, last_good, started), kept })
}

/// End of a run: reason, last state, and pictures taken during the run.
pub struct Ending<S> {
    /// Reason for the end.
    pub stop: Stop,
    /// The state that was observed last.
    pub last_good: S,
    /// The criterion by which the observer stops a run, in words.
    pub criterion: String,
    /// Whether a divergence is a result and not an error.
    pub may_diverge: bool,
    /// Pictures on the way; the last state is added to them.
    pub frames: Vec<Frame>,
    /// Start time of the run, as if it had not been interrupted.
    pub started: Instant,
}

impl<S> Ending<S> {
    /// End of a run without frames and without a stop criterion, whose divergence is an error.
    pub fn of(stop: Stop, last_good: S, started: Instant) -> Self {
        Self { stop, last_good, criterion: String::new(), may_diverge: false, frames: Vec::new(), started }
    }

    /// The record, with the data that `measure` takes from the last state: the last good one after a divergence.
    pub fn record<R: Restartable<State = S>, O>(self, simulation: &R, measure: impl FnOnce(&S) -> O) -> Recorded<O> {
        let now = simulation.state();
        let (outcome, end, first_bad) = match self.stop {
            Stop::Finished => (Outcome::Finished, now, None),
            Stop::Stopped => (Outcome::Stopped { criterion: self.criterion }, now, None),
            Stop::Diverged(message) => {
                let outcome = Outcome::Diverged { message, expected: self.may_diverge };
                (outcome, self.last_good, Some(R::frame(&now)))
            }
        };
        let mut frames = self.frames;
        frames.push(R::frame(&end));
        Recorded {
            outcome,
            state_hash: state_hash(&R::bits(&end)),
            particles: simulation.particles(),
            steps: simulation.steps(),
            simulated_time: simulation.time(),
            wall_seconds: self.started.elapsed().as_secs_f64(),
            threads: rayon::current_num_threads(),
            frames,
            first_bad,
            data: measure(&end),
        }
    }
}
