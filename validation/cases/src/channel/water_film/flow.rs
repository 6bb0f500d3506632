//! The flow: a laminar film on a slope.

use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::channel::{AveragingWindowEnd, Channel, ChannelObservation, Water};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::film::{Incline, NewtonianFilm};
use crate::setup::rules;
use crate::shared::{Arrangement, OverHeight};
use bagnold_solver::incompressible::{Bed, ProjectionNumerics};
use bagnold_solver::parameter::{between, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A film that starts from its exact profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaterFilmFlow {
    /// Depth, resolution and density of the water.
    #[serde(flatten)]
    pub water: Water,
    /// Slope i of the bed, a tangent `[-]`; 0.03 is 3 %.
    #[schemars(transform = rules::driving_slope())]
    pub slope: f64,
    /// Velocity u at the surface, which sets the viscosity g i h²/(2 u) `[m/s]`.
    #[schemars(transform = positive("give it in m/s, such as 0.5"))]
    pub surface_velocity: f64,
    /// Arrangement of the particles.
    pub arrangement: Arrangement,
    /// Largest random displacement of a jittered particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.1 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Simulated time over 4h²/(π²ν) `[-]`.
    #[schemars(transform = between(0.5, 1e3, "give 4, which leave 2 % of the initial error"))]
    pub relaxation_times: f64,
    /// Averaging window before the end over the same `[-]`.
    pub averaging_times: f64,
}

impl Default for WaterFilmFlow {
    fn default() -> Self {
        let water = Water::of_rows(20);
        Self {
            // rows that slide over each other stay rows: their density is the lattice's, not that of stirred water
            water: Water { numerics: ProjectionNumerics { reference_concentration: 1.0, ..water.numerics }, ..water },
            slope: 0.03,
            surface_velocity: 0.5,
            arrangement: Arrangement::Lattice,
            jitter: 0.1,
            relaxation_times: 2.0,
            averaging_times: 1.0,
        }
    }
}

impl Flow for WaterFilmFlow {
    const RUNS: &'static str = include_str!("../../../runs/water-film.toml");
    type Observation = ChannelObservation;

    fn check(&self) -> Result<(), ParameterError> {
        let longest = 0.5 * self.relaxation_times;
        rules::between("averaging_times", self.averaging_times, 0.2, longest, "give at most half of the duration")?;
        self.water.check()
    }

    fn variant(&self) -> Variant {
        Variant::of("particles", self.arrangement.name()).and("resolution", self.water.resolution)
    }

    fn cost(&self) -> RunCost {
        RunCost::incompressible(self.water.particles(), self.channel(&|_| 0.0).expected_steps())
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        let film = self.exact(self.water.depth);
        self.channel(&|z| film.velocity(z)).run(progress)
    }
}

impl WaterFilmFlow {
    /// Kinematic viscosity ν = g i h²/(2 u) `[m²/s]`.
    pub fn kinematic_viscosity(&self) -> f64 {
        let Water { depth, gravity, .. } = self.water;
        gravity * self.slope * depth * depth / (2.0 * self.surface_velocity)
    }

    /// Relaxation time of the slowest mode 4h²/(π²ν) `[s]`.
    pub fn relaxation_time(&self) -> f64 {
        4.0 * self.water.depth * self.water.depth / (std::f64::consts::PI.powi(2) * self.kinematic_viscosity())
    }

    /// The exact film of a depth `[m]`.
    pub fn exact(&self, depth: f64) -> NewtonianFilm {
        let incline = Incline {
            layer_height: depth,
            // the body force along the bed is g i: i is the sine here
            inclination: libm::asin(self.slope),
            gravity: self.water.gravity,
            density: self.water.density,
        };
        NewtonianFilm { incline, viscosity: self.water.density * self.kinematic_viscosity() }
    }

    fn channel<'a>(&self, velocity: OverHeight<'a>) -> Channel<'a> {
        let relaxation_time = self.relaxation_time();
        Channel {
            slope: self.slope,
            kinematic_viscosity: self.kinematic_viscosity(),
            bed: Bed::NoSlip(0.0),
            jitter: self.arrangement.displacement(self.jitter),
            until: AveragingWindowEnd::Time(self.relaxation_times * relaxation_time),
            window: self.averaging_times * relaxation_time,
            interval: relaxation_time / 200.0,
            ..self.water.channel(velocity)
        }
    }
}
