//! A fluid over a flat floor, periodic along it, alone or with a sediment: the scene and the probe that the cases of the
//! incompressible model share.
//!
//! - [`Water`]: the parameters that the cases without a sediment share.
//! - [`Channel`]: fluid, floor, body force, start, numerics and how long it runs. [`Channel::scene`] gives the scene,
//!   [`Channel::run`] the record; [`Channel::run_observed`] also shows the simulation at every sample, for what a case
//!   measures beside. A sediment is handed through as the solver takes it.
//! - [`AveragingWindowEnd`]: a fixed time, or until the depth mean of the velocity is stationary. In both cases the run ends with an
//!   averaging window.
//! - [`ChannelObservation`]: [`ChannelSeries`] over the whole run; over the window a [`BlockProfile`] in bins of one
//!   spacing, whose blocks of time give every average its statistical error, and the [`MomentumBalance`].
//! - [`BlockProfile::observe`] takes any set of particles, so that it also serves a sediment.
//!
//! x points along the floor and z, the last axis, away from it; a slope i is the tangent of the bed's angle, and the
//! body force is (g i, −g), as in the bed-load paper.

pub mod bed_load;
pub mod clear_water;
mod closure;
pub(crate) mod foreign;
mod metrics;
mod probe;
mod scene;
mod stationarity;
pub mod still_water;
mod tables;
#[cfg(test)]
mod tests;
mod water;
pub mod water_film;

pub use crate::statistics::{BlockProfile, ProfilePoint};
pub use closure::TurbulenceClosure;
pub(super) use metrics::{
    BED_SHEAR, HEIGHT_CHANGE, MOMENTUM_RESIDUAL, PARTICLES_LOST, PRESSURE_ITERATIONS, PRESSURE_L2, VELOCITY_ITERATIONS,
};
pub use metrics::{bed_shear, height_change, iterations, momentum_residual, observed, particles_lost, pressure_l2};
pub use probe::{ChannelObservation, ChannelSeries, MomentumBalance};
pub use tables::{tables, tables_of_runs};
pub use water::Water;

use crate::case::recording::{Ending, RestartableRun, SimulationStage, Stop, follow};
use crate::case::{ParameterError, Progress};
use crate::observation::{Frame, Recorded};
use crate::setup::Lattice;
use bagnold_solver::incompressible::{
    Bed, IncompressibleSimulation, IncompressibleSnapshot, ParticleSet, ProjectionNumerics, Sediment, SolidFraction,
    Turbulence,
};
use bagnold_solver::run::SceneError;
use probe::ChannelProbe;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// End of the averaging window of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum AveragingWindowEnd {
    /// At this time `[s]`.
    Time(f64),
    /// One window after the depth mean U of the velocity has become stationary: it changes by less than `tolerance`
    /// over U/(2 g i), `checks` times in a row.
    Stationary {
        /// Largest relative change `[-]`.
        tolerance: f64,
        /// Times in a row.
        checks: usize,
        /// Time at which the window begins all the same `[s]`.
        at_most: f64,
    },
}

/// A channel and how it is run. SI units throughout.
#[derive(Clone)]
pub struct Channel<'a> {
    /// The fluid's particles before they are displaced; the floor is the lattice's lower edge, and h its height.
    pub fluid: Lattice,
    /// Slope i of the bed `[-]`.
    pub slope: f64,
    /// Gravity g `[m/s²]`.
    pub gravity: f64,
    /// Density of the fluid `[kg/m³]`.
    pub density: f64,
    /// Kinematic viscosity of the fluid ν `[m²/s]`.
    pub kinematic_viscosity: f64,
    /// Turbulence model of the water.
    pub turbulence: Turbulence,
    /// Effect of the floor on the velocity along it.
    pub bed: Bed,
    /// Largest random displacement of a fluid particle along each axis, in spacings `[-]`.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Initial velocity of the fluid along the floor `[m/s]` at a height `[m]`.
    pub velocity: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Particles of the fluid in place of those of the lattice, where a run starts from another's state.
    pub particles: Option<ParticleSet<2>>,
    /// The sediment, if there is one.
    pub sediment: Option<Sediment<2>>,
    /// Partition of the space between water and sediment.
    pub solid_fraction: SolidFraction,
    /// Numerical scheme of the incompressible model.
    pub numerics: ProjectionNumerics,
    /// Duration of the run.
    pub until: AveragingWindowEnd,
    /// Length of the averaging window `[s]`.
    pub window: f64,
    /// Interval of the samples `[s]`.
    pub interval: f64,
    /// Number of snapshots, the last state included.
    pub frames: usize,
    /// Whether a divergence is a result of the run and not an error.
    pub may_diverge: bool,
}

impl<'a> Channel<'a> {
    /// Default channel: an inviscid fluid that slips along a level floor, with zero duration; a case changes what it needs.
    pub fn of(fluid: Lattice, density: f64, gravity: f64, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Self {
        Self {
            fluid,
            slope: 0.0,
            gravity,
            density,
            kinematic_viscosity: 0.0,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            jitter: 0.0,
            seed: 0,
            velocity,
            particles: None,
            sediment: None,
            solid_fraction: SolidFraction::Overlapping,
            numerics: ProjectionNumerics::default(),
            until: AveragingWindowEnd::Time(0.0),
            window: 0.0,
            interval: 5e-3,
            frames: 2,
            may_diverge: false,
        }
    }

    /// Longest time that the run may take `[s]`.
    pub fn longest(&self) -> f64 {
        match self.until {
            AveragingWindowEnd::Time(time) => time,
            AveragingWindowEnd::Stationary { at_most, .. } => at_most + self.window,
        }
    }

    /// Expected number of steps of the whole run.
    pub fn expected_steps(&self) -> f64 {
        self.longest() / self.numerics.time_step
    }

    /// Runs the channel and records what the probe sees.
    ///
    /// # Errors
    /// A scene that breaks a rule of the solver; an interruption.
    pub fn run(&self, progress: &Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        Ok(self.run_observed(progress, (), |(), _, _| {})?.0)
    }

    /// The same, showing the simulation to `observe` at every sample, with whether it lies in the averaging window, and
    /// what it keeps, which is given back.
    ///
    /// # Errors
    /// A scene that breaks a rule of the solver; an interruption.
    pub fn run_observed<O: Serialize + DeserializeOwned>(
        &self,
        progress: &Progress,
        beside: O,
        mut observe: impl FnMut(&mut O, &IncompressibleSimulation<2>, bool),
    ) -> Result<(Recorded<ChannelObservation>, O), ParameterError> {
        let longest = self.longest();
        let frame_interval = longest / (self.frames.max(2) - 1) as f64;
        // the bed's impulse is that of every step, so the probe sees every step
        let (interval, window) = (1e-3 * self.numerics.time_step, self.window + self.interval);
        let stage = SimulationStage { progress, end: longest, interval, window, context: &() };
        let begin = |simulation: &IncompressibleSimulation<2>| ChannelObserver {
            probe: ChannelProbe::new(self),
            last_good: simulation.snapshot(),
            frames: Vec::new(),
            beside,
        };
        let followed = follow(
            stage,
            None,
            |_| Ok::<_, SceneError>(self.scene()),
            begin,
            |seen: &mut ChannelObserver<O>, simulation| {
                let ChannelObserver { probe, last_good, frames, beside } = seen;
                if !probe.observe(simulation) {
                    return ControlFlow::Continue(());
                }
                observe(beside, simulation, probe.in_window());
                *last_good = simulation.snapshot();
                if last_good.time >= frame_interval * frames.len() as f64 && frames.len() + 1 < self.frames {
                    frames.push(Frame::of_phases(last_good));
                }
                let particles = simulation.free_particles() as f64;
                progress.advance(last_good.time, longest, simulation.steps() as f64 * particles);
                if probe.is_done() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
            |seen| {
                seen.probe.until = self.until;
                Ok(())
            },
        )?;
        let RestartableRun { simulation, stop, kept: ChannelObserver { probe, last_good, frames, beside }, started } =
            followed;
        // a fixed time is reached by the probe first, and no criterion of its own
        let stop = match (stop, self.until) {
            (Stop::Stopped, AveragingWindowEnd::Time(_)) => Stop::Finished,
            (Stop::Stopped, _) if !probe.is_stationary() => Stop::Finished,
            (stop, _) => stop,
        };
        let ending = Ending {
            stop,
            last_good,
            criterion: format!("averaged over {:.1} s after the depth mean had become stationary", self.window),
            may_diverge: self.may_diverge,
            frames,
            started,
        };
        Ok((ending.record(&simulation, |_| probe.finish()), beside))
    }
}

/// What has been seen of a run.
#[derive(Serialize, Deserialize)]
struct ChannelObserver<O> {
    probe: ChannelProbe,
    last_good: IncompressibleSnapshot<2>,
    frames: Vec<Frame>,
    beside: O,
}
