//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier};
use crate::cases::Arrangement;
use crate::cases::channel::{Channel, ChannelObservation, Lattice, Until};
use crate::cases::rules;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::{Incline, NewtonianFilm};
use bagnold_solver::incompressible::{Bed, ProjectionNumerics, SolidFraction, Turbulence};
use bagnold_solver::parameter::{between, each, filled, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WaterFilmParameters {
    /// Depth h `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Slope i of the bed, a tangent `[-]`; 0.03 is 3 %.
    #[schemars(transform = rules::driving_slope())]
    pub slope: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Velocity u at the surface, which sets the viscosity g i h²/(2 u) `[m/s]`.
    #[schemars(transform = positive("give it in m/s, such as 0.5"))]
    pub surface_velocity: f64,
    /// Arrangements to run at `resolution`.
    #[schemars(transform = filled("one or both of \"lattice\" and \"jittered\"", "name every arrangement once"))]
    #[schemars(transform = unique("name every arrangement once"))]
    pub arrangements: Vec<Arrangement>,
    /// Rows of particles over the depth.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a jittered particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.1 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Rows of the convergence study on the lattice; empty for none.
    #[schemars(transform = each(rules::rows()))]
    #[schemars(transform = unique("name every number of rows once"))]
    pub convergence_resolutions: Vec<usize>,
    /// Simulated time over 4h²/(π²ν) `[-]`.
    #[schemars(transform = between(0.5, 1e3, "4 leave 2 % of the start's error"))]
    pub relaxation_times: f64,
    /// Averaging window before the end over the same `[-]`.
    pub averaging_times: f64,
    /// Numerics; the time step is that at `resolution` rows and goes with the spacing.
    pub numerics: ProjectionNumerics,
}

impl Parameters for WaterFilmParameters {
    type Run = WaterFilmRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            depth: 0.046,
            slope: 0.03,
            gravity: 9.81,
            density: 1000.0,
            surface_velocity: 0.5,
            arrangements: vec![Arrangement::Lattice],
            resolution: 20,
            columns: 12,
            jitter: 0.1,
            seed: 1,
            convergence_resolutions: Vec::new(),
            relaxation_times: 2.0,
            averaging_times: 1.0,
            // rows that slide over each other stay rows: their density is the lattice's, not that of stirred water
            numerics: ProjectionNumerics { reference_concentration: 1.0, ..ProjectionNumerics::default() },
        };
        let paper = Self {
            arrangements: vec![Arrangement::Lattice, Arrangement::Jittered],
            convergence_resolutions: vec![10, 20, 40],
            relaxation_times: 6.0,
            averaging_times: 2.0,
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self { columns: 24, convergence_resolutions: vec![10, 20, 40, 80], ..paper },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        rules::channel_columns("columns", self.columns, &self.numerics)?;
        let longest = 0.5 * self.relaxation_times;
        rules::between("averaging_times", self.averaging_times, 0.2, longest, "the window lies in the second half")?;
        rules::projection("numerics", &self.numerics)
    }

    fn runs(&self) -> Vec<WaterFilmRun> {
        let new = |particles, resolution: usize| WaterFilmRun {
            particles,
            resolution,
            depth: self.depth,
            slope: self.slope,
            gravity: self.gravity,
            density: self.density,
            surface_velocity: self.surface_velocity,
            columns: self.columns,
            jitter: if particles == Arrangement::Lattice { 0.0 } else { self.jitter },
            seed: self.seed,
            relaxation_times: self.relaxation_times,
            averaging_times: self.averaging_times,
            numerics: ProjectionNumerics {
                time_step: self.numerics.time_step * self.resolution as f64 / resolution as f64,
                ..self.numerics
            },
        };
        let mut runs: Vec<WaterFilmRun> =
            self.arrangements.iter().map(|&particles| new(particles, self.resolution)).collect();
        let is_run = |rows: usize| self.arrangements.contains(&Arrangement::Lattice) && rows == self.resolution;
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
    /// Rows over the depth.
    pub resolution: usize,
    /// Depth h `[m]`.
    pub depth: f64,
    /// Slope i `[-]`.
    pub slope: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Density `[kg/m³]`.
    pub density: f64,
    /// Velocity at the surface `[m/s]`.
    pub surface_velocity: f64,
    columns: usize,
    jitter: f64,
    seed: u64,
    relaxation_times: f64,
    averaging_times: f64,
    numerics: ProjectionNumerics,
}

impl Run for WaterFilmRun {
    type Observation = ChannelObservation;

    fn variant(&self) -> Variant {
        let particles = match self.particles {
            Arrangement::Lattice => "lattice",
            Arrangement::Jittered => "jittered",
        };
        Variant::of("particles", particles).and("resolution", self.resolution)
    }

    fn particle_steps(&self) -> f64 {
        self.channel(&|_| 0.0).expected_steps() * (self.resolution * self.columns) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        let film = self.film(self.depth);
        Ok(self.channel(&|z| film.velocity(z)).run(progress)?)
    }
}

impl WaterFilmRun {
    /// Kinematic viscosity ν = g i h²/(2 u) `[m²/s]`.
    #[must_use]
    pub fn kinematic_viscosity(&self) -> f64 {
        self.gravity * self.slope * self.depth * self.depth / (2.0 * self.surface_velocity)
    }

    /// Relaxation time of the slowest mode 4h²/(π²ν) `[s]`.
    #[must_use]
    pub fn relaxation_time(&self) -> f64 {
        4.0 * self.depth * self.depth / (std::f64::consts::PI.powi(2) * self.kinematic_viscosity())
    }

    /// The exact film of a depth `[m]`.
    #[must_use]
    pub fn film(&self, depth: f64) -> NewtonianFilm {
        let incline = Incline {
            layer_height: depth,
            // the body force along the bed is g i: i is the sine here
            slope_angle: libm::asin(self.slope),
            gravity: self.gravity,
            density: self.density,
        };
        NewtonianFilm { incline, viscosity: self.density * self.kinematic_viscosity() }
    }

    fn channel<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let relaxation_time = self.relaxation_time();
        Channel {
            fluid: Lattice {
                spacing: self.depth / self.resolution as f64,
                rows: self.resolution,
                columns: self.columns,
                bottom: 0.0,
            },
            slope: self.slope,
            gravity: self.gravity,
            density: self.density,
            kinematic_viscosity: self.kinematic_viscosity(),
            turbulence: Turbulence::Laminar,
            bed: Bed::NoSlip(0.0),
            jitter: self.jitter,
            seed: self.seed,
            velocity,
            sediment: None,
            solid_fraction: SolidFraction::Overlapping,
            numerics: self.numerics,
            until: Until::Time(self.relaxation_times * relaxation_time),
            window: self.averaging_times * relaxation_time,
            interval: relaxation_time / 200.0,
            frames: 2,
            may_diverge: false,
        }
    }
}
