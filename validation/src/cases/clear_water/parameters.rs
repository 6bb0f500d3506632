//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier};
use crate::cases::channel::{Channel, ChannelObservation, Lattice, TurbulenceClosure, Until};
use crate::cases::rules;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::{RoughChannel, roughness_ratio};
use bagnold_solver::incompressible::{Bed, ProjectionNumerics, SolidFraction};
use bagnold_solver::material::turbulence::{MixingLengthShape, RoughWall};
use bagnold_solver::parameter::{between, each, filled, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How long a flow is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Period {
    /// For a fixed time; nothing is claimed about stationarity.
    Fixed {
        /// Simulated time `[s]`.
        #[schemars(transform = between(0.5, 1e4, "a few seconds, more to be stationary"))]
        duration: f64,
        /// Averaging window before the end `[s]`.
        averaging_time: f64,
    },
    /// Until the depth mean changes little over U/(2 g i), then for an averaging window.
    Stationary {
        /// Largest relative change `[-]`.
        #[schemars(transform = between(1e-5, 0.1, "0.005 is half a per cent"))]
        tolerance: f64,
        /// Times in a row.
        #[schemars(transform = between(1.0, 20.0, "3 tells a steady flow from a turning point"))]
        checks: usize,
        /// Time at which averaging begins all the same, over U/(2 g i) of the logarithmic law `[-]`.
        at_most: f64,
        /// Averaging window over the same `[-]`.
        #[schemars(transform = between(0.5, 1e3, "8 hold as many blocks"))]
        averaging_times: f64,
    },
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClearWaterParameters {
    /// Depth h `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Slopes i of the bed, tangents, one run each `[-]`; 0.03 is 3 %.
    #[schemars(transform = each(rules::driving_slope()))]
    #[schemars(transform = unique("name every slope once"))]
    #[schemars(transform = filled("at least one slope", "3 % is 0.03"))]
    pub slopes: Vec<f64>,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Kinematic viscosity `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Equivalent sand roughness k_s of the bed `[m]`, about the grain diameter.
    #[schemars(transform = positive("give it in metres; about the grain diameter"))]
    pub sand_roughness: f64,
    /// Depth z_off of the wall law's origin below the bed `[m]`.
    pub origin_offset: f64,
    /// Closure of the turbulence; the logarithmic law belongs to the parabolic mixing length.
    pub turbulence: TurbulenceClosure,
    /// Rows of particles over the depth.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.1 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Initial velocity over the logarithmic law's `[-]`.
    #[schemars(transform = between(0.1, 3.0, "1 starts from the logarithmic law"))]
    pub start_share: f64,
    /// How long.
    pub period: Period,
    /// Numerics.
    pub numerics: ProjectionNumerics,
}

impl Parameters for ClearWaterParameters {
    type Run = ClearWaterRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            depth: 0.046,
            slopes: vec![0.03],
            gravity: 9.81,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            sand_roughness: 5e-3,
            origin_offset: 6e-4,
            turbulence: TurbulenceClosure::MixingLength { shape: MixingLengthShape::Parabolic },
            resolution: 23,
            columns: 12,
            jitter: 0.1,
            seed: 1,
            start_share: 1.0,
            period: Period::Fixed { duration: 3.0, averaging_time: 1.0 },
            numerics: ProjectionNumerics::default(),
        };
        let paper = Self {
            slopes: vec![0.02, 0.03, 0.05],
            columns: 20,
            start_share: 0.8,
            period: Period::Stationary { tolerance: 0.005, checks: 3, at_most: 25.0, averaging_times: 8.0 },
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
        rules::between("origin_offset", self.origin_offset, 0.0, 0.1 * self.depth, "a fraction of a grain diameter")?;
        let first_row = 0.5 * self.depth / self.resolution as f64 + self.origin_offset;
        let remedy = "the logarithmic law begins at k_s/30, which must lie below the first row of particles";
        rules::between("sand_roughness", self.sand_roughness, 0.0, roughness_ratio() * first_row, remedy)?;
        rules::channel_columns("columns", self.columns, &self.numerics)?;
        match self.period {
            Period::Fixed { duration, averaging_time } => {
                let field = "period.fixed.averaging_time";
                rules::between(field, averaging_time, 0.2, 0.5 * duration, "the window lies in the second half")?;
            }
            Period::Stationary { checks, at_most, .. } => {
                let field = "period.stationary.at_most";
                rules::between(field, at_most, checks as f64, 1e3, "25 suffice from 80 % of the law")?;
            }
        }
        rules::projection("numerics", &self.numerics)
    }

    fn runs(&self) -> Vec<ClearWaterRun> {
        let new = |&slope: &f64| ClearWaterRun {
            slope,
            resolution: self.resolution,
            period: self.period,
            depth: self.depth,
            gravity: self.gravity,
            density: self.density,
            kinematic_viscosity: self.kinematic_viscosity,
            sand_roughness: self.sand_roughness,
            origin_offset: self.origin_offset,
            turbulence: self.turbulence,
            columns: self.columns,
            jitter: self.jitter,
            seed: self.seed,
            start_share: self.start_share,
            numerics: self.numerics,
        };
        self.slopes.iter().map(new).collect()
    }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct ClearWaterRun {
    /// Slope i `[-]`.
    pub slope: f64,
    /// Rows over the depth.
    pub resolution: usize,
    /// How long.
    pub period: Period,
    depth: f64,
    gravity: f64,
    density: f64,
    kinematic_viscosity: f64,
    sand_roughness: f64,
    origin_offset: f64,
    turbulence: TurbulenceClosure,
    columns: usize,
    jitter: f64,
    seed: u64,
    start_share: f64,
    numerics: ProjectionNumerics,
}

impl Run for ClearWaterRun {
    type Observation = ChannelObservation;

    fn variant(&self) -> Variant {
        Variant::of("slope", self.slope).and("resolution", self.resolution)
    }

    fn particle_steps(&self) -> f64 {
        self.channel(&|_| 0.0).expected_steps() * (self.resolution * self.columns) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        let law = self.reference();
        Ok(self.channel(&|z| self.start_share * law.velocity(z)).run(progress)?)
    }
}

impl ClearWaterRun {
    /// The flow that it is compared with.
    #[must_use]
    pub fn reference(&self) -> RoughChannel {
        RoughChannel {
            depth: self.depth,
            slope: self.slope,
            gravity: self.gravity,
            density: self.density,
            sand_roughness: self.sand_roughness,
            origin_offset: self.origin_offset,
        }
    }

    fn channel<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let time = self.reference().adjustment_time();
        let (until, window) = match self.period {
            Period::Fixed { duration, averaging_time } => (Until::Time(duration), averaging_time),
            Period::Stationary { tolerance, checks, at_most, averaging_times } => {
                (Until::Stationary { tolerance, checks, at_most: at_most * time }, averaging_times * time)
            }
        };
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
            kinematic_viscosity: self.kinematic_viscosity,
            turbulence: self.turbulence.over(self.depth, self.origin_offset),
            bed: Bed::Rough {
                level: 0.0,
                origin_offset: self.origin_offset,
                law: RoughWall { sand_roughness: self.sand_roughness },
            },
            jitter: self.jitter,
            seed: self.seed,
            velocity,
            sediment: None,
            solid_fraction: SolidFraction::Overlapping,
            numerics: self.numerics,
            until,
            window,
            interval: 0.01,
            frames: 2,
            may_diverge: false,
        }
    }
}
