//! A layer on an incline, periodic along the slope: the scene that hydrostatic, film and bagnold share.

pub mod bagnold;
pub mod film;
pub mod flow_thickness;
pub(crate) mod foreign;
pub mod hydrostatic;
mod metrics;
mod periodic;
mod preparation;
mod probe;
mod tables;

pub(crate) use metrics::{PARTICLES_LOST, particles_lost};
pub use periodic::PeriodicLayer;
pub use preparation::Preparation;
pub(crate) use preparation::{raised, settled};
pub use probe::{DepthProfile, LayerObservation, LayerProbe, TimeSeries};
pub use tables::tables_of_runs;

use crate::case::recording::{self, Ending, ObservedRun, SimulationStage, StartState};
use crate::case::{ParameterError, Progress, cost};
use crate::observation::{Frame, Recorded};
use crate::setup::{Lattice, displaced_flow, hydrostatic_pressure, wall_rows};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::walls::wall::fill;
use bagnold_solver::weakly_compressible::{Scene, Simulation, ViscousStep, Wall};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Boundary above a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Top {
    /// A free surface.
    Free,
    /// A mirror plane: the middle of a channel between two beds, which no shear crosses.
    Mirror,
}

/// A layer and how it is run. Lengths in `[m]`, angles in `[rad]`, SI units throughout.
#[derive(Clone)]
pub struct Layer<'a> {
    /// Size, its particles and their numerics.
    pub layer: PeriodicLayer,
    /// Slope θ `[rad]`; `slope_angle` is the same in degrees, as files and messages give it.
    pub inclination: f64,
    /// Reference density ρ0 `[kg/m³]`.
    pub reference_density: f64,
    /// Bulk modulus K `[Pa]`.
    pub bulk_modulus: f64,
    /// Boundary above the layer.
    pub top: Top,
    /// Whether it starts as compressed as its weight makes it at rest, or without pressure.
    pub compressed: bool,
    /// Constitutive law.
    pub rheology: Rheology,
    /// Initial velocity along the slope `[m/s]` at a height `[m]`.
    pub velocity: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Initial shear stress `[Pa]` at a height `[m]`.
    pub shear_stress: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Length of the averaging window before the end `[s]`.
    pub window: f64,
    /// Interval of the time series `[s]`.
    pub interval: f64,
    /// Depth mean of the velocity at which the run stops `[m/s]`; infinite for none.
    pub stop_above: f64,
    /// Number of snapshots, the first and last state included.
    pub frames: usize,
    /// Whether a divergence is a result of the run and not an error.
    pub may_diverge: bool,
}

/// Ratio of viscous to acoustic steps from which a run says how long it will take before it starts.
const WORTH_A_WARNING: f64 = 100.0;

/// Bins over the depth.
pub const BINS: usize = 20;

/// Stiffness K = ρ0 max(50 g H, (6 Ū)²) `[Pa]`, Ū the expected steady depth mean if there is one: one rule everywhere.
///
/// A fast layer is to be six times slower than sound. With a ratio of three the unevenness of the flow between particles
/// compresses it: fine grains at 34° sank by 5 % and were 3 % too fast, with six by 1 % and 1.2 %.
pub fn bulk_modulus(reference_density: f64, gravity: f64, height: f64, expected_mean: f64) -> f64 {
    reference_density * (50.0 * gravity * height).max((6.0 * expected_mean).powi(2))
}

impl Layer<'_> {
    /// Particle spacing Δ `[m]`.
    pub fn spacing(&self) -> f64 {
        self.layer.layer_height / self.layer.resolution as f64
    }

    /// Exact pressure `[Pa]` of the compressible layer at rest, K (exp(ρ0 g cosθ (H − y)/K) − 1).
    pub fn hydrostatic_pressure(&self, y: f64) -> f64 {
        let across = self.layer.gravity * libm::cos(self.inclination);
        hydrostatic_pressure(self.bulk_modulus, self.reference_density, across, self.layer.layer_height - y)
    }

    /// Expected number of steps for the whole run, from the acoustic bound.
    pub fn expected_steps(&self) -> f64 {
        let sound_speed = (self.bulk_modulus / self.reference_density).sqrt();
        let smoothing_length = self.layer.numerics.smoothing_ratio * self.spacing();
        let acoustic = self.layer.numerics.acoustic_courant * smoothing_length / sound_speed;
        let viscosity =
            self.rheology.largest_viscosity(self.reference_density * self.layer.gravity * self.layer.layer_height);
        let viscous = if viscosity > 0.0 && self.layer.numerics.viscous_step == ViscousStep::Explicit {
            self.layer.numerics.viscous_courant * smoothing_length * smoothing_length * self.reference_density
                / viscosity
        } else {
            f64::INFINITY
        };
        self.duration / acoustic.min(viscous)
    }

    /// The scene as a run starts from it: settled, with its velocities and shear stresses.
    ///
    /// # Errors
    /// A scene that breaks a rule of the solver.
    pub fn prepared_scene(&self) -> Result<Scene<2>, SceneError> {
        Ok(self.started(match self.layer.preparation {
            Preparation::Raised if self.top == Top::Free => {
                preparation::raised(preparation::settled(self.scene())?, self.layer.layer_height)
            }
            Preparation::Settled | Preparation::Raised => preparation::settled(self.scene())?,
            Preparation::None => self.scene(),
        }))
    }

    /// The scene with the initial velocities and shear stresses, and with what a law keeps of such a flow.
    fn started(&self, mut scene: Scene<2>) -> Scene<2> {
        let flow = &mut scene.flow;
        for (particle, position) in flow.position.iter().enumerate() {
            let shear = (self.shear_stress)(position[1]);
            flow.velocity[particle] = Vector::<2>::new((self.velocity)(position[1]), 0.0);
            flow.stress[particle] = Tensor::<2>::new(0.0, shear, shear, 0.0);
            let ratio = shear / self.hydrostatic_pressure(position[1]);
            let Some(field) = self.rheology.field_in_flow(self.shear_rate(position[1]), ratio) else { continue };
            flow.field.push(field);
            // what has dilated is looser under the same pressure, and its particles as large as before
            let loosening: f64 = self.rheology.loosening(field);
            flow.density[particle] /= loosening;
            flow.mass[particle] /= loosening;
        }
        scene
    }

    /// Initial shear rate `[1/s]` at a height `[m]`: a difference over a thousandth of the layer, inside of it.
    fn shear_rate(&self, height: f64) -> f64 {
        let (bottom, top) = (0.0, self.layer.layer_height);
        let reach = 5e-4 * top;
        let (below, above) = ((height - reach).max(bottom), (height + reach).min(top));
        if below < above { ((self.velocity)(above) - (self.velocity)(below)) / (above - below) } else { 0.0 }
    }

    /// The scene at rest, without shear stress.
    pub fn scene(&self) -> Scene<2> {
        let spacing = self.spacing();
        let PeriodicLayer { columns, resolution: rows, jitter, seed, numerics, .. } = self.layer;
        let lattice = Lattice { spacing, rows, columns, bottom: 0.0 };
        let length = lattice.length();
        let above = match self.top {
            Top::Free => AxisBoundary::Open,
            Top::Mirror => AxisBoundary::Mirror { lower: None, upper: Some(self.layer.layer_height) },
        };
        let domain = Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: length }, above] };
        let bed = Wall::still(1, 0.0, 1.0);
        let extent = (Vector::<2>::zeros(), Vector::<2>::new(length, self.layer.layer_height));
        let equation_of_state = EquationOfState {
            reference_density: self.reference_density,
            bulk_modulus: self.bulk_modulus,
            tension: Tension::Cut,
        };
        let flow = displaced_flow(
            lattice.sites(),
            (jitter * spacing, seed),
            |site| equation_of_state.density(if self.compressed { self.hydrostatic_pressure(site[1]) } else { 0.0 }),
            |density| density * spacing * spacing,
        );
        Scene {
            wall_particles: fill(&[bed], &domain, extent, spacing, wall_rows(numerics.smoothing_ratio)),
            walls: vec![bed],
            domain,
            gravity: Vector::<2>::new(libm::sin(self.inclination), -libm::cos(self.inclination)) * self.layer.gravity,
            numerics,
            ..Scene::unbounded(flow, spacing, equation_of_state, self.rheology)
        }
    }

    /// The scene that a run begins with or is continued in.
    ///
    /// # Errors
    /// A scene that breaks a rule of the solver.
    pub fn scene_for(&self, beginning: StartState) -> Result<Scene<2>, SceneError> {
        match beginning {
            StartState::New => self.prepared_scene(),
            StartState::Continued => Ok(self.scene()),
            StartState::Described => Ok(self.started(self.scene())),
        }
    }

    /// Says how long a run will take whose steps the viscosity bounds.
    fn announce(&self, simulation: &Simulation<2>) {
        let steps = simulation.estimated_steps(self.duration);
        let acoustic = self.duration / simulation.time_step_bounds().acoustic;
        if steps > WORTH_A_WARNING * acoustic {
            tracing::warn!(
                "slope angle {:.1}°, {} rows: the explicit viscous step needs about {steps:.1e} steps for {} s, {:.0} times \
                 as many as the sound speed alone would need; that is {:.1} h on one core. A larger regularisation rate shortens \
                 the run, but lets the material creep",
                self.inclination.to_degrees(),
                self.layer.resolution,
                self.duration,
                steps / acoustic,
                steps * self.layer.particles() * cost::WEAKLY_COMPRESSIBLE / 3600.0
            );
        } else if steps > acoustic {
            tracing::info!("explicit viscous step: about {steps:.1e} steps for {} s", self.duration);
        }
    }

    /// Runs the layer and records what the probe sees.
    ///
    /// # Errors
    /// A scene that breaks a rule of the solver; an interruption.
    pub fn run(&self, progress: &Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        let stage =
            SimulationStage { progress, end: self.duration, interval: self.interval, window: 0.0, context: &() };
        let begin = |simulation: &Simulation<2>| {
            self.announce(simulation);
            (LayerProbe::new(self), Vec::new())
        };
        let frame_interval = self.duration / (self.frames.max(2) - 1) as f64;
        let watched = recording::watch(
            stage,
            |beginning| self.scene_for(beginning),
            begin,
            |(probe, frames), snapshot| {
                probe.observe(snapshot);
                if snapshot.time >= frame_interval * frames.len() as f64 && frames.len() + 1 < self.frames.max(2) {
                    frames.push(Frame::of_flow(snapshot));
                }
                let stop = probe.mean_velocity() > self.stop_above;
                if stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        )?;
        let ObservedRun { simulation, ending, kept: (probe, frames) } = watched;
        let limit = self.stop_above;
        let criterion = format!("the depth mean of the velocity passed {limit:.3} m/s, half the sound speed");
        let ending = Ending { criterion, may_diverge: self.may_diverge, frames, ..ending };
        Ok(ending.record(&simulation, |_| probe.finish()))
    }
}
