//! One simulation: how it starts, and what it ought to come to.

use super::channel::{Channel, ChannelGrains, Motion, UpperBoundary};
use super::flow::{ExactShear, ShearFlow, ShearedGrains};
use super::probe::{ShearObservation, ShearProbe};
use crate::case::recording::{SimulationStage, watch};
use crate::case::{ParameterError, Progress, Run};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::setup::acoustic_step;
use bagnold_solver::material::rheology::Rheology;
use serde::Serialize;
use std::ops::ControlFlow;

/// Samples of a run.
const SAMPLES: f64 = 200.0;
/// Part of a run that is averaged over, the last `[-]`.
const WINDOW: f64 = 0.5;
/// Velocity of the start over that of the steady flow `[-]`: a run that stayed as it began would not pass.
const HASTE: f64 = 1.1;

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct ShearRun {
    /// The flow.
    pub flow: ShearFlow,
    /// Its particles.
    pub grains: ChannelGrains,
    /// Particles per grain diameter.
    pub particles_per_diameter: usize,
    /// Mean pressure in a chute, pressure below a plate; on a heap there is none `[Pa]`.
    pub load: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Simulated time `[s]`.
    pub duration: f64,
}

impl Run for ShearRun {
    type Observation = ShearObservation;

    fn variant(&self) -> Variant {
        Variant::of("flow", self.flow.name()).and("particles_per_diameter", self.particles_per_diameter)
    }

    fn laws(&self) -> Vec<Rheology> {
        vec![self.flow.law(self.grains.law)]
    }

    fn particles(&self) -> f64 {
        (self.grains.rows * self.grains.columns) as f64
    }

    fn particle_steps(&self) -> f64 {
        self.with_channel(|channel| {
            let sound = channel.equation_of_state().sound_speed();
            self.duration / acoustic_step(&self.grains.numerics, channel.spacing(), sound) * self.particles()
        })
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<ShearObservation>, ParameterError> {
        self.with_channel(|channel| {
            let stage = SimulationStage {
                progress,
                end: self.duration,
                interval: self.duration / SAMPLES,
                window: 0.0,
                context: &(),
            };
            let watched = watch(
                stage,
                |beginning| channel.scene(beginning),
                |_| ShearProbe::new(channel, self.duration - self.window()),
                |probe, snapshot| {
                    probe.observe(snapshot);
                    ControlFlow::Continue(())
                },
            )?;
            Ok(watched.ending.record(&watched.simulation, |_| watched.kept.finish()))
        })
    }
}

impl ShearRun {
    /// Length of the window before the end that is averaged over `[s]`.
    #[must_use]
    pub fn window(&self) -> f64 {
        WINDOW * self.duration
    }

    /// The grains as the run is made for.
    pub(super) fn nominal(&self) -> ShearedGrains {
        let (law, density) = (self.grains.law, self.grains.density());
        ShearedGrains { law, load: self.load, density, gravity: self.gravity }
    }

    /// The grains and the flow as they were found: at the pressure and the density of the run.
    #[must_use]
    pub fn found(&self, seen: &ShearObservation) -> (ShearedGrains, ShearFlow) {
        let (density, pressure) = (seen.density, seen.mean_pressure());
        let grains = |load| ShearedGrains { load, density, ..self.nominal() };
        match self.flow {
            ShearFlow::Chute { half_width, .. } => {
                let driving = self.flow.gravity(&self.nominal())[0];
                let wall_friction = density * driving * half_width / pressure;
                (grains(pressure), ShearFlow::Chute { half_width, wall_friction })
            }
            ShearFlow::DraggedBed { depth, .. } => (grains(pressure - 0.5 * density * self.gravity * depth), self.flow),
            ShearFlow::Heap { .. } => (grains(0.0), self.flow),
        }
    }

    /// The steady flow without particles at the pressure that was found; none where nothing flows.
    #[must_use]
    pub fn exact(&self, seen: &ShearObservation) -> Option<ExactShear> {
        let (grains, flow) = self.found(seen);
        flow.steady(&grains)
    }

    /// Calls with the channel of particles that the run begins with.
    fn with_channel<T>(&self, call: impl FnOnce(&Channel<'_>) -> T) -> T {
        let grains = self.nominal();
        let steady = self.flow.steady(&grains);
        let start = |height: f64| {
            let Some(steady) = &steady else { return Motion::default() };
            let velocity = HASTE * steady.velocity(height);
            Motion {
                velocity,
                shear_rate: HASTE * steady.shear_rate(height),
                shear_stress: steady.shear_stress(height),
            }
        };
        let pressure = |height: f64| self.flow.pressure(&grains, height);
        let above = match self.flow {
            ShearFlow::Chute { .. } => UpperBoundary::Wall(0.0),
            ShearFlow::DraggedBed { plate_velocity, .. } => UpperBoundary::Wall(plate_velocity),
            ShearFlow::Heap { side_walls, .. } => UpperBoundary::Surface(side_walls),
        };
        call(&Channel {
            grains: self.grains,
            rheology: self.flow.law(self.grains.law),
            width: self.flow.width(),
            gravity: self.flow.gravity(&grains),
            pressure: &pressure,
            above,
            start: &start,
        })
    }
}
