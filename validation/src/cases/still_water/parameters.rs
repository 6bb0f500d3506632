//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier};
use crate::cases::channel::{Channel, ChannelObservation, Lattice, Until};
use crate::cases::rules;
use crate::metric::Variant;
use crate::observation::Recorded;
use bagnold_solver::incompressible::{Bed, ProjectionNumerics, SolidFraction, Turbulence};
use bagnold_solver::parameter::{between, each, filled, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StillWaterParameters {
    /// Depth h `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Kinematic viscosity `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Rows of particles over the depth.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings, one run each `[-]`.
    #[schemars(transform = each(between(0.0, 0.5, "0.1 breaks the lattice without overlaps")))]
    #[schemars(transform = unique("name every displacement once"))]
    #[schemars(transform = filled("at least one displacement", "0.1 breaks the lattice"))]
    pub jitters: Vec<f64>,
    /// Displacements of the runs without stabilisation `[-]`; empty for none.
    #[schemars(transform = each(between(0.0, 0.5, "0.1 breaks the lattice without overlaps")))]
    #[schemars(transform = unique("name every displacement once"))]
    pub unstabilised_jitters: Vec<f64>,
    /// Seed of the displacements.
    pub seed: u64,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.5, 1e4, "20 s bring the water to rest"))]
    pub duration: f64,
    /// Averaging window before the end `[s]`.
    pub averaging_time: f64,
    /// Simulated time without stabilisation `[s]`.
    #[schemars(transform = between(0.1, 1e3, "half a second is enough to blow up"))]
    pub unstabilised_duration: f64,
    /// Numerics.
    pub numerics: ProjectionNumerics,
}

impl Parameters for StillWaterParameters {
    type Run = StillWaterRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            depth: 0.046,
            gravity: 9.81,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            resolution: 23,
            columns: 12,
            jitters: vec![0.1, 0.4],
            unstabilised_jitters: vec![0.4],
            seed: 1,
            duration: 5.0,
            averaging_time: 1.0,
            unstabilised_duration: 0.5,
            numerics: ProjectionNumerics::default(),
        };
        let paper = Self {
            columns: 20,
            jitters: vec![0.02, 0.1, 0.2, 0.4],
            duration: 20.0,
            averaging_time: 4.0,
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self {
                resolution: 46,
                columns: 40,
                numerics: ProjectionNumerics { time_step: 1.25e-4, ..paper.numerics },
                ..paper
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        rules::channel_columns("columns", self.columns, &self.numerics)?;
        let longest = 0.5 * self.duration;
        rules::between("averaging_time", self.averaging_time, 0.2, longest, "the window lies in the second half")?;
        rules::projection("numerics", &self.numerics)
    }

    fn runs(&self) -> Vec<StillWaterRun> {
        let new = |jitter, unstabilised| StillWaterRun {
            jitter,
            resolution: self.resolution,
            depth: self.depth,
            gravity: self.gravity,
            density: self.density,
            duration: if unstabilised { self.unstabilised_duration } else { self.duration },
            unstabilised,
            kinematic_viscosity: self.kinematic_viscosity,
            columns: self.columns,
            seed: self.seed,
            averaging_time: if unstabilised { 0.5 * self.unstabilised_duration } else { self.averaging_time },
            numerics: if unstabilised {
                ProjectionNumerics { stabilisation: 0.0, ..self.numerics }
            } else {
                self.numerics
            },
        };
        let mut runs: Vec<StillWaterRun> = self.jitters.iter().map(|&jitter| new(jitter, false)).collect();
        // where nothing is stabilised, there is nothing to compare
        if self.numerics.stabilisation > 0.0 {
            runs.extend(self.unstabilised_jitters.iter().map(|&jitter| new(jitter, true)));
        }
        runs
    }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct StillWaterRun {
    /// Largest displacement in spacings `[-]`.
    pub jitter: f64,
    /// Rows over the depth.
    pub resolution: usize,
    /// Depth h `[m]`.
    pub depth: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Density `[kg/m³]`.
    pub density: f64,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Whether it is run to show that it fails.
    pub unstabilised: bool,
    kinematic_viscosity: f64,
    columns: usize,
    seed: u64,
    averaging_time: f64,
    numerics: ProjectionNumerics,
}

impl Run for StillWaterRun {
    type Observation = ChannelObservation;

    fn variant(&self) -> Variant {
        Variant::of("jitter", self.jitter)
            .and("stabilisation", self.numerics.stabilisation)
            .and("resolution", self.resolution)
    }

    fn particle_steps(&self) -> f64 {
        self.channel().expected_steps() * (self.resolution * self.columns) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        Ok(self.channel().run(progress)?)
    }
}

impl StillWaterRun {
    /// Particle spacing `[m]`.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.depth / self.resolution as f64
    }

    fn channel(&self) -> Channel<'static> {
        Channel {
            fluid: Lattice { spacing: self.spacing(), rows: self.resolution, columns: self.columns, bottom: 0.0 },
            slope: 0.0,
            gravity: self.gravity,
            density: self.density,
            kinematic_viscosity: self.kinematic_viscosity,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            jitter: self.jitter,
            seed: self.seed,
            velocity: &|_| 0.0,
            sediment: None,
            solid_fraction: SolidFraction::Overlapping,
            numerics: self.numerics,
            until: Until::Time(self.duration),
            window: self.averaging_time,
            // a column that blows up does so within a few steps
            interval: if self.unstabilised { self.numerics.time_step } else { 5e-3 },
            frames: 2,
            may_diverge: self.unstabilised,
        }
    }
}
