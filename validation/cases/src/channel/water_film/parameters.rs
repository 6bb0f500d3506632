//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier, cost};
use crate::channel::{AveragingWindowEnd, Channel, ChannelObservation, Water};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::film::{Incline, NewtonianFilm};
use crate::setup::rules;
use crate::shared::Arrangement;
use bagnold_solver::incompressible::{Bed, ProjectionNumerics};
use bagnold_solver::parameter::{between, each, filled, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The film, and how long it is watched.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmFlow {
    /// Slope i of the bed, a tangent `[-]`; 0.03 is 3 %.
    #[schemars(transform = rules::driving_slope())]
    pub slope: f64,
    /// Velocity u at the surface, which sets the viscosity g i h²/(2 u) `[m/s]`.
    #[schemars(transform = positive("give it in m/s, such as 0.5"))]
    pub surface_velocity: f64,
    /// Largest random displacement of a jittered particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.1 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Simulated time over 4h²/(π²ν) `[-]`.
    #[schemars(transform = between(0.5, 1e3, "4 leave 2 % of the start's error"))]
    pub relaxation_times: f64,
    /// Averaging window before the end over the same `[-]`.
    pub averaging_times: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaterFilmParameters {
    /// The water.
    #[serde(flatten)]
    pub water: Water,
    /// The film.
    #[serde(flatten)]
    pub film: FilmFlow,
    /// Arrangements to run at `resolution`.
    #[schemars(transform = filled("one or both of \"lattice\" and \"jittered\"", "name every arrangement once"))]
    #[schemars(transform = unique("name every arrangement once"))]
    pub arrangements: Vec<Arrangement>,
    /// Rows of the convergence study on the lattice, whose time steps go with the spacing; empty for none.
    #[schemars(transform = each(rules::rows()))]
    #[schemars(transform = unique("name every number of rows once"))]
    pub convergence_resolutions: Vec<usize>,
}

impl Parameters for WaterFilmParameters {
    type Run = WaterFilmRun;

    fn of_tier(tier: Tier) -> Self {
        let water = Water::of_rows(20);
        let quick = Self {
            film: FilmFlow {
                slope: 0.03,
                surface_velocity: 0.5,
                jitter: 0.1,
                relaxation_times: 2.0,
                averaging_times: 1.0,
            },
            arrangements: vec![Arrangement::Lattice],
            convergence_resolutions: Vec::new(),
            // rows that slide over each other stay rows: their density is the lattice's, not that of stirred water
            water: Water { numerics: ProjectionNumerics { reference_concentration: 1.0, ..water.numerics }, ..water },
        };
        let paper = Self {
            arrangements: vec![Arrangement::Lattice, Arrangement::Jittered],
            convergence_resolutions: vec![10, 20, 40],
            film: FilmFlow { relaxation_times: 6.0, averaging_times: 2.0, ..quick.film },
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self {
                water: Water { columns: 24, ..paper.water },
                convergence_resolutions: vec![10, 20, 40, 80],
                ..paper
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let (window, longest) = (self.film.averaging_times, 0.5 * self.film.relaxation_times);
        rules::between("averaging_times", window, 0.2, longest, "the window lies in the second half")?;
        self.water.check()
    }

    fn runs(&self) -> Vec<WaterFilmRun> {
        let Self { water, film, .. } = *self;
        let new = |particles, resolution: usize| {
            let time_step = water.numerics.time_step * water.resolution as f64 / resolution as f64;
            WaterFilmRun {
                particles,
                water: Water { resolution, numerics: ProjectionNumerics { time_step, ..water.numerics }, ..water },
                film: FilmFlow { jitter: particles.displacement(film.jitter), ..film },
            }
        };
        let mut runs: Vec<WaterFilmRun> =
            self.arrangements.iter().map(|&particles| new(particles, water.resolution)).collect();
        let is_run = |rows: usize| self.arrangements.contains(&Arrangement::Lattice) && rows == water.resolution;
        let study = self.convergence_resolutions.iter().filter(|&&rows| !is_run(rows));
        runs.extend(study.map(|&rows| new(Arrangement::Lattice, rows)));
        runs
    }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct WaterFilmRun {
    /// Arrangement of the particles.
    pub particles: Arrangement,
    /// The water, with the rows of this run.
    pub water: Water,
    /// The film, with the displacements of this run.
    pub film: FilmFlow,
}

impl Run for WaterFilmRun {
    type Observation = ChannelObservation;

    fn variant(&self) -> Variant {
        Variant::of("particles", self.particles.name()).and("resolution", self.water.resolution)
    }

    fn particles(&self) -> f64 {
        self.water.particles()
    }

    fn seconds_per_particle_step(&self) -> f64 {
        cost::INCOMPRESSIBLE
    }

    fn particle_steps(&self) -> f64 {
        self.channel(&|_| 0.0).expected_steps() * self.water.particles()
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        let film = self.exact(self.water.depth);
        self.channel(&|z| film.velocity(z)).run(progress)
    }
}

impl WaterFilmRun {
    /// Kinematic viscosity ν = g i h²/(2 u) `[m²/s]`.
    #[must_use]
    pub fn kinematic_viscosity(&self) -> f64 {
        let (Water { depth, gravity, .. }, FilmFlow { slope, surface_velocity, .. }) = (self.water, self.film);
        gravity * slope * depth * depth / (2.0 * surface_velocity)
    }

    /// Relaxation time of the slowest mode 4h²/(π²ν) `[s]`.
    #[must_use]
    pub fn relaxation_time(&self) -> f64 {
        4.0 * self.water.depth * self.water.depth / (std::f64::consts::PI.powi(2) * self.kinematic_viscosity())
    }

    /// The exact film of a depth `[m]`.
    #[must_use]
    pub fn exact(&self, depth: f64) -> NewtonianFilm {
        let incline = Incline {
            layer_height: depth,
            // the body force along the bed is g i: i is the sine here
            inclination: libm::asin(self.film.slope),
            gravity: self.water.gravity,
            density: self.water.density,
        };
        NewtonianFilm { incline, viscosity: self.water.density * self.kinematic_viscosity() }
    }

    fn channel<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let relaxation_time = self.relaxation_time();
        Channel {
            slope: self.film.slope,
            kinematic_viscosity: self.kinematic_viscosity(),
            bed: Bed::NoSlip(0.0),
            jitter: self.film.jitter,
            until: AveragingWindowEnd::Time(self.film.relaxation_times * relaxation_time),
            window: self.film.averaging_times * relaxation_time,
            interval: relaxation_time / 200.0,
            ..self.water.channel(velocity)
        }
    }
}
