//! The slope at which a layer of given thickness stops flowing, bisected.

use crate::case::recording::{Ending, RestartableRun, SimulationStage, follow, resumed};
use crate::case::{ParameterError, Progress};
use crate::layer::{Layer, PeriodicLayer};
use crate::observation::Recorded;
use bagnold_solver::weakly_compressible::{Simulation, Snapshot};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Depth mean of the velocity over √(gh) below which a layer has stopped `[-]`.
const STOPPED: f64 = 1e-4;
/// A flow is steady when its depth mean changes by less than this over [`STEADY_TIME`] `[-]`.
const STEADY: f64 = 5e-3;
/// `[s]`
const STEADY_TIME: f64 = 1.0;

/// A search for the slope at which a layer stops.
pub(super) struct SlopeSearch<'a> {
    /// The layer and its motion at the start; each trial has a slope of its own.
    pub layer: Layer<'a>,
    /// Slopes between which it is sought `[°]`: it must stop at the first and flow at the second.
    pub bracket: (f64, f64),
    /// Width of the bracket that ends the search `[°]`.
    pub tolerance: f64,
}

/// Outcome of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LayerFate {
    /// It came to rest.
    Stops,
    /// It reached a steady flow.
    Flows,
    /// Neither, when its time was up or it diverged.
    Undecided,
}

/// One layer of the search.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SlopeTrial {
    /// Slope `[°]`.
    pub slope_angle: f64,
    /// Outcome of the layer.
    pub fate: LayerFate,
    /// Time at which it stopped, was found steady or was given up `[s]`.
    pub time: f64,
    /// Depth mean of its velocity at that time `[m/s]`.
    pub mean_velocity: f64,
    /// Particles below the bed or far above the layer.
    pub lost: usize,
}

/// Results of the search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StartStop {
    /// All trials in their order.
    pub trials: Vec<SlopeTrial>,
}

impl StartStop {
    /// Steepest slope at which the layer stopped and gentlest at which it flowed `[°]`; none where the ends of the
    /// search do not bracket the change, or where a trial left open which it is.
    pub fn bracket(&self) -> Option<(f64, f64)> {
        let angles = |fate: LayerFate| self.trials.iter().filter(move |t| t.fate == fate).map(|t| t.slope_angle);
        let (steepest, gentlest) =
            (angles(LayerFate::Stops).reduce(f64::max)?, angles(LayerFate::Flows).reduce(f64::min)?);
        let decided = angles(LayerFate::Undecided).next().is_none();
        (decided && steepest < gentlest).then_some((steepest, gentlest))
    }
}

impl SlopeSearch<'_> {
    /// Bisects.
    pub(super) fn run(&self, progress: &Progress) -> Result<Recorded<StartStop>, ParameterError> {
        let (stopping, flowing) = self.bracket;
        let new = SlopeBisection { stopping, flowing, trials: Vec::new(), steps: 0, simulated_time: 0.0, seconds: 0.0 };
        let mut search: SlopeBisection = resumed(progress).unwrap_or(new);
        loop {
            let angle = search.next_angle();
            let (trial, simulation, ending) = self.attempt(angle, progress, &search)?;
            search.seconds += ending.started.elapsed().as_secs_f64();
            search.steps += simulation.steps();
            search.simulated_time += simulation.time();
            let goes_on = search.enter(trial);
            let is_narrow = search.flowing - search.stopping <= self.tolerance * (1.0 + 1e-9);
            if !goes_on || search.trials.len() > 1 && is_narrow {
                let SlopeBisection { trials, steps, simulated_time, seconds, .. } = search;
                let record = ending.record(&simulation, |_| StartStop { trials });
                return Ok(Recorded { steps, simulated_time, wall_seconds: seconds, ..record });
            }
        }
    }

    /// Layers that the search needs about.
    pub(super) fn rounds(&self) -> f64 {
        let (stopping, flowing) = self.bracket;
        2.0 + ((flowing - stopping) / self.tolerance).log2().ceil().max(0.0)
    }

    /// Runs one layer until it has stopped, is steady or its time is up.
    fn attempt(
        &self,
        angle: f64,
        progress: &Progress,
        search: &SlopeBisection,
    ) -> Result<(SlopeTrial, Simulation<2>, Ending<Snapshot<2>>), ParameterError> {
        let layer = Layer { inclination: angle.to_radians(), ..self.layer.clone() };
        let (round, rounds) = (search.trials.len() as f64, self.rounds());
        let Layer { layer: PeriodicLayer { layer_height: h, gravity, .. }, duration, interval, .. } = layer;
        let threshold = STOPPED * (gravity * h).sqrt();
        let lag = (STEADY_TIME / interval) as usize;
        let stage = SimulationStage { progress, end: duration, interval, window: 0.0, context: search };
        let fate = LayerFate::Undecided;
        let trial = SlopeTrial { slope_angle: angle, fate, time: 0.0, mean_velocity: f64::NAN, lost: 0 };
        let begin =
            |simulation: &Simulation<2>| LayerObserver { means: Vec::new(), trial, last_good: simulation.snapshot() };
        let followed = follow(
            stage,
            None,
            |beginning| layer.scene_for(beginning),
            begin,
            |seen, simulation| {
                let LayerObserver { means, trial, last_good } = seen;
                let snapshot = simulation.snapshot();
                let mass: f64 = snapshot.mass.iter().sum();
                let mean = snapshot.mass.iter().zip(&snapshot.velocity).map(|(m, v)| m * v[0]).sum::<f64>() / mass;
                means.push(mean);
                let steady = means.len() > lag && (mean / means[means.len() - 1 - lag] - 1.0).abs() < STEADY;
                let fate = match (mean < threshold, steady) {
                    (true, _) => LayerFate::Stops,
                    (false, true) => LayerFate::Flows,
                    (false, false) => LayerFate::Undecided,
                };
                let lost = snapshot.position.iter().filter(|x| !(x[1] > 0.0 && x[1] < 2.0 * h)).count();
                *trial = SlopeTrial { slope_angle: angle, fate, time: snapshot.time, mean_velocity: mean, lost };
                let work = simulation.steps() as f64 * snapshot.mass.len() as f64;
                progress.advance(round * duration + snapshot.time, rounds * duration, work);
                *last_good = snapshot;
                if fate == LayerFate::Undecided { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            },
            |_| Ok(()),
        )?;
        let RestartableRun { simulation, stop, kept: LayerObserver { trial, last_good, .. }, started } = followed;
        let criterion = "the slope at which the layer stops is bracketed".to_owned();
        Ok((trial, simulation, Ending { criterion, ..Ending::of(stop, last_good, started) }))
    }
}

/// What has been seen of a layer.
#[derive(Serialize, Deserialize)]
struct LayerObserver {
    /// Depth means of its velocity `[m/s]`.
    means: Vec<f64>,
    trial: SlopeTrial,
    last_good: Snapshot<2>,
}

/// How far a search has come.
#[derive(Serialize, Deserialize)]
struct SlopeBisection {
    /// Steepest slope at which a layer stopped, and gentlest at which one flowed `[°]`.
    stopping: f64,
    flowing: f64,
    trials: Vec<SlopeTrial>,
    /// Steps, simulated time and wall time `[s]` of all trials.
    steps: u64,
    simulated_time: f64,
    seconds: f64,
}

impl SlopeBisection {
    /// Slope of the next trial `[°]`.
    fn next_angle(&self) -> f64 {
        match self.trials.len() {
            0 => self.stopping,
            1 => self.flowing,
            _ => 0.5 * (self.stopping + self.flowing),
        }
    }

    /// Enters a trial; whether the change is still bracketed.
    fn enter(&mut self, trial: SlopeTrial) -> bool {
        self.trials.push(trial);
        match (self.trials.len(), trial.fate) {
            (_, LayerFate::Undecided) => return false,
            (1, fate) => return fate == LayerFate::Stops,
            (2, fate) => return fate == LayerFate::Flows,
            (_, LayerFate::Stops) => self.stopping = trial.slope_angle,
            (_, LayerFate::Flows) => self.flowing = trial.slope_angle,
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bracket_is_that_of_the_trials() {
        let trial = |slope_angle: f64, fate: LayerFate| SlopeTrial {
            slope_angle,
            fate,
            time: 1.0,
            mean_velocity: 0.0,
            lost: 0,
        };
        let search =
            |trials: &[(f64, LayerFate)]| StartStop { trials: trials.iter().map(|t| trial(t.0, t.1)).collect() };
        let found =
            [(19.0, LayerFate::Stops), (25.0, LayerFate::Flows), (22.0, LayerFate::Flows), (20.5, LayerFate::Stops)];
        assert_eq!(search(&found).bracket(), Some((20.5, 22.0)));
        assert_eq!(search(&[(19.0, LayerFate::Flows)]).bracket(), None);
        assert_eq!(search(&[(22.0, LayerFate::Stops), (21.0, LayerFate::Flows)]).bracket(), None);
        // a layer that is still slowing down when its time is up does not flow
        let undecided = [(19.0, LayerFate::Stops), (25.0, LayerFate::Flows), (22.0, LayerFate::Undecided)];
        assert_eq!(search(&undecided).bracket(), None);
    }
}
