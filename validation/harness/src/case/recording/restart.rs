//! Runs that can be interrupted between two steps and continued by another program: simulation, where it stands between
//! its observations, and what its observer keeps are one checkpoint.

use crate::case::{Conditions, ParameterError, Progress};
use crate::checkpoint::{Checkpoints, StoredState, count_stopped, is_interrupted};
use crate::observation::Frame;
use bagnold_solver::run::{ContinueError, Observer, RunProgress, SceneError, StopReason};
use serde::{Serialize, de::DeserializeOwned};
use std::fmt::Display;
use std::marker::PhantomData;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Start state of a scene: new, or continued from a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StartState {
    /// A new run, with all that comes before its start.
    New,
    /// A run that is continued: of its flow only the number of particles counts.
    Continued,
    /// A run that is described and not simulated, without what comes before its start.
    Described,
}

/// A simulation that can be recorded, saved and continued.
pub trait Restartable: Sized {
    /// States.
    type State;
    /// Scene that the simulation is set up from.
    type Scene;
    /// Form in which the simulation is saved.
    type Saved: DeserializeOwned;
    /// Sets it up.
    ///
    /// # Errors
    /// A scene that breaks a rule.
    fn begin(scene: Self::Scene) -> Result<Self, SceneError>;
    /// Continues a saved one of the same scene.
    ///
    /// # Errors
    /// A state that is not one of the scene.
    fn continued(scene: Self::Scene, saved: Self::Saved) -> Result<Self, ContinueError>;
    /// Itself, to be written and read as [`Restartable::Saved`].
    fn saved(&self) -> impl Serialize;
    /// Runs along a course.
    ///
    /// # Errors
    /// An interruption.
    fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> Result<Stop, ParameterError>;
    /// A copy of the present state.
    fn state(&self) -> Self::State;
    /// Bits of a state in a fixed order.
    fn bits(state: &Self::State) -> Vec<u8>;
    /// A picture of a state, in the plane or in space.
    fn frame(state: &Self::State) -> Frame;
    /// The present state as other programs want to see it, and the particles of its walls; none where there are none.
    fn pictures(&self) -> (Frame, Option<Frame>);
    /// Particles that move.
    fn particles(&self) -> usize;
    /// Steps taken.
    fn steps(&self) -> u64;
    /// Time `[s]`.
    fn time(&self) -> f64;
}

/// One simulation of a run.
pub struct SimulationStage<'a, C> {
    /// Progress of the run, with its checkpoints.
    pub progress: &'a Progress<'a>,
    /// End `[s]`.
    pub end: f64,
    /// Time between two observations `[s]`.
    pub interval: f64,
    /// Time before the end in which observations depend on the end `[s]`.
    pub window: f64,
    /// Results of the run before this simulation; [`resumed`] gives those of an interrupted run.
    pub context: &'a C,
}

/// Reason for the end of a simulation.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// Reached its end time.
    Finished,
    /// The observer ended it.
    Stopped,
    /// Diverged, in words.
    Diverged(String),
}

impl Stop {
    /// End of the run with the solver's reason.
    pub(super) fn of<const D: usize>(reason: StopReason<D>) -> Result<Self, ParameterError> {
        match reason {
            StopReason::Finished => Ok(Self::Finished),
            StopReason::Stopped => Ok(Self::Stopped),
            StopReason::Diverged(divergence) => Ok(Self::Diverged(divergence.to_string())),
            StopReason::Interrupted => Err(ParameterError::Interrupted),
        }
    }
}

/// Simulation that was run or resumed, why it stopped, and what its observer has kept.
pub struct RestartableRun<S, O> {
    /// The simulation at its end.
    pub simulation: S,
    /// Reason for the end of the simulation.
    pub stop: Stop,
    /// Data that the observer has kept.
    pub kept: O,
    /// Start time of the simulation, as if it had not been interrupted.
    pub started: Instant,
}

/// Contents of a checkpoint: the context, which can be read alone, seconds spent, the course, what the observer keeps, the simulation.
type Contents<C, O, S> = (C, f64, RunProgress, O, S);

/// Results of an interrupted run before the simulation in which it was interrupted.
pub fn resumed<C: DeserializeOwned>(progress: &Progress) -> Option<C> {
    let context = |bytes: &[u8]| postcard::take_from_bytes(bytes).map(|(context, _)| context);
    progress.checkpoints?.look(|bytes| context(bytes).map_err(|error| error.to_string()))
}

/// Runs a simulation and shows it to `observe` at the start, at intervals and at the end, until that breaks, together with
/// what it keeps, which `keep` makes at the start of a new run. An interrupted run resumes at its last checkpoint; one that is
/// longer than a finished one continues near its end. `adopt` makes of what that run has kept what this one would have kept by
/// then, or says why not, as the rest of a sentence about that run. A new run may start from a stored state.
///
/// # Errors
/// A scene that breaks a rule or cannot be made; an interruption.
pub fn follow<S, O, C, E>(
    stage: SimulationStage<'_, C>,
    state: Option<&StoredState>,
    scene: impl Fn(StartState) -> Result<S::Scene, E>,
    keep: impl FnOnce(&S) -> O,
    observe: impl FnMut(&mut O, &S) -> ControlFlow<()>,
    mut adopt: impl FnMut(&mut O) -> Result<(), String>,
) -> Result<RestartableRun<S, O>, ParameterError>
where
    S: Restartable,
    O: Serialize + DeserializeOwned,
    C: Serialize + DeserializeOwned,
    E: Into<ParameterError> + Display,
    for<'scene> Conditions: From<&'scene S::Scene>,
{
    let now = Instant::now();
    let SimulationStage { progress, end, interval, .. } = stage;
    if let Some(conditions) = progress.conditions {
        let described = scene(StartState::Described).map_err(Into::into)?;
        conditions.get_or_init(|| Conditions::from(&described));
        return Err(ParameterError::Interrupted);
    }
    let restore = |bytes: &[u8]| {
        let (_, seconds, course, kept, saved): Contents<C, O, S::Saved> =
            postcard::from_bytes(bytes).map_err(|error| error.to_string())?;
        let scene = scene(StartState::Continued).map_err(|error| error.to_string())?;
        let simulation = S::continued(scene, saved).map_err(|error| error.to_string())?;
        Ok((simulation, course, kept, seconds))
    };
    let mut refused = None;
    let shorter = |bytes: &[u8]| {
        let (simulation, course, mut kept, seconds) = restore(bytes).ok()?;
        match course.prolonged(end, interval).and_then(|course| adopt(&mut kept).map(|()| course)) {
            Ok(course) => Some((simulation, course, kept, seconds)),
            Err(reason) => {
                refused.get_or_insert(reason);
                None
            }
        }
    };
    let left = progress.checkpoints.and_then(|checkpoints| checkpoints.take(restore));
    let left = left.or_else(|| progress.ends?.usable(shorter));
    let (mut simulation, mut course, kept, started) = match left {
        Some((simulation, course, kept, seconds)) => {
            progress.tell(&format!("resumes from its checkpoint at t = {:.4} s", simulation.time()));
            tracing::info!("resumed at t = {:.6} s, step {}", simulation.time(), simulation.steps());
            let spent = Duration::try_from_secs_f64(seconds).unwrap_or_default();
            (simulation, course, kept, now.checked_sub(spent).unwrap_or(now))
        }
        None => {
            if let Some(reason) = refused {
                progress.tell(&format!("simulated again from the start: the finished run {reason}"));
            }
            let simulation = match state {
                None => S::begin(scene(StartState::New).map_err(Into::into)?)?,
                Some(state) => {
                    let refused = |defect: String| {
                        let remedy = "start from a state of a scene with these bodies, walls and material";
                        ParameterError::field("from.file", defect, "", remedy)
                    };
                    let (simulation, ..) = restore(&state.contents).map_err(refused)?;
                    if simulation.time() >= end {
                        let rule = format!("later than {} s, the time of the stored state", simulation.time());
                        return Err(ParameterError::field("duration", format!("{end} s"), &rule, "raise it"));
                    }
                    simulation
                }
            };
            // what comes before the start may have been cut short
            if is_interrupted() {
                return Err(ParameterError::Interrupted);
            }
            let kept = keep(&simulation);
            (simulation, RunProgress::new(end, interval), kept, now)
        }
    };
    let mut watching =
        CheckpointingObserver { stage, ends: progress.ends, started, kept, observe, simulation: PhantomData };
    let stop = simulation.follow(&mut course, &mut watching)?;
    if let Some(output) = progress.output() {
        output.take(simulation.pictures());
    }
    Ok(RestartableRun { simulation, stop, kept: watching.kept, started })
}

/// Shows a simulation to the observer of a case and to who wants states on its way, and keeps checkpoints.
struct CheckpointingObserver<'a, S, O, C, F> {
    stage: SimulationStage<'a, C>,
    /// Place of a state near the end, until it is written.
    ends: Option<&'a Checkpoints>,
    started: Instant,
    kept: O,
    observe: F,
    simulation: PhantomData<S>,
}

impl<S, O, C, F> Observer<S> for CheckpointingObserver<'_, S, O, C, F>
where
    S: Restartable,
    O: Serialize,
    C: Serialize,
    F: FnMut(&mut O, &S) -> ControlFlow<()>,
{
    fn observe(&mut self, simulation: &S) -> ControlFlow<()> {
        (self.observe)(&mut self.kept, simulation)
    }

    fn pause(&mut self, simulation: &S, course: &RunProgress) -> ControlFlow<()> {
        let SimulationStage { progress, end, window, .. } = self.stage;
        if let Some(output) = progress.output().filter(|output| output.is_due(simulation.time())) {
            output.take(simulation.pictures());
        }
        let interrupted = is_interrupted();
        let wanted = progress.checkpoints.filter(|checkpoints| interrupted || checkpoints.is_due());
        let write = |checkpoints: &Checkpoints| {
            let seconds = self.started.elapsed().as_secs_f64();
            let written = (self.stage.context, seconds, course, &self.kept, simulation.saved());
            checkpoints.keep(|| postcard::to_stdvec(&written))
        };
        let is_kept = wanted.is_some_and(write);
        if course.nears(simulation.time(), end - window)
            && let Some(ends) = self.ends.take()
        {
            write(ends);
        }
        if !interrupted {
            return ControlFlow::Continue(());
        }
        count_stopped(is_kept);
        ControlFlow::Break(())
    }
}
