//! The flow: clear water over a rough bed.

use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::channel::{AveragingWindowEnd, Channel, ChannelObservation, TurbulenceClosure, Water};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::water::{RoughChannel, roughness_ratio};
use crate::setup::rules;
use bagnold_solver::incompressible::Bed;
use bagnold_solver::material::turbulence::{MixingLengthShape, RoughWall};
use bagnold_solver::parameter::{between, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Duration of a simulated flow.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Period {
    /// For a fixed time; nothing is claimed about stationarity.
    Fixed {
        /// Simulated time `[s]`.
        #[schemars(transform = between(0.5, 1e4, "give a few seconds, or more for a stationary flow"))]
        duration: f64,
        /// Averaging window before the end `[s]`.
        averaging_time: f64,
    },
    /// Until the depth mean changes little over U/(2 g i), then for an averaging window.
    Stationary {
        /// Largest relative change `[-]`.
        #[schemars(transform = between(1e-5, 0.1, "give 0.005 for half a per cent"))]
        tolerance: f64,
        /// Times in a row.
        #[schemars(transform = between(1.0, 20.0, "give 3 to tell a steady flow from a turning point"))]
        checks: usize,
        /// Time at which averaging begins all the same, over U/(2 g i) of the logarithmic law `[-]`.
        at_most: f64,
        /// Averaging window over the same `[-]`.
        #[schemars(transform = between(0.5, 1e3, "give 8, which hold as many blocks"))]
        averaging_times: f64,
    },
}

/// Water that flows over its bed, and how long it is watched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClearWaterFlow {
    /// Depth, resolution and density of the water.
    #[serde(flatten)]
    pub water: Water,
    /// Slope i of the bed, a tangent `[-]`; 0.03 is 3 %.
    #[schemars(transform = rules::driving_slope())]
    pub slope: f64,
    /// Kinematic viscosity `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Equivalent sand roughness k_s of the bed `[m]`, about the grain diameter.
    #[schemars(transform = positive("give it in metres; about the grain diameter"))]
    pub sand_roughness: f64,
    /// Depth z_off of the wall law's origin below the bed `[m]`.
    #[schemars(transform = not_negative("give it in metres, a fraction of a grain diameter, such as 0.0006"))]
    pub origin_offset: f64,
    /// Closure of the turbulence; the logarithmic law belongs to the parabolic mixing length.
    pub turbulence: TurbulenceClosure,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.1 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Initial velocity over the logarithmic law's `[-]`.
    #[schemars(transform = between(0.1, 3.0, "give 1 to start from the logarithmic law"))]
    pub start_share: f64,
    /// Duration.
    pub period: Period,
}

impl Default for ClearWaterFlow {
    fn default() -> Self {
        Self {
            water: Water::of_rows(23),
            slope: 0.03,
            kinematic_viscosity: 1e-6,
            sand_roughness: 5e-3,
            origin_offset: 6e-4,
            turbulence: TurbulenceClosure::MixingLength { shape: MixingLengthShape::Parabolic },
            jitter: 0.1,
            start_share: 1.0,
            period: Period::Fixed { duration: 3.0, averaging_time: 1.0 },
        }
    }
}

impl Flow for ClearWaterFlow {
    const RUNS: &'static str = include_str!("../../../runs/clear-water.toml");
    type Observation = ChannelObservation;

    fn check(&self) -> Result<(), ParameterError> {
        let Self { water, origin_offset, sand_roughness, period, .. } = *self;
        rules::between("origin_offset", origin_offset, 0.0, 0.1 * water.depth, "give a fraction of a grain diameter")?;
        let first_row = 0.5 * water.depth / water.resolution as f64 + origin_offset;
        let remedy = "reduce it: the logarithmic law begins at k_s/30, which must lie below the first row of particles";
        rules::between("sand_roughness", sand_roughness, 0.0, roughness_ratio() * first_row, remedy)?;
        match period {
            Period::Fixed { duration, averaging_time } => {
                let field = "period.fixed.averaging_time";
                rules::between(field, averaging_time, 0.2, 0.5 * duration, "give at most half of the duration")?;
            }
            Period::Stationary { checks, at_most, .. } => {
                let field = "period.stationary.at_most";
                rules::between(field, at_most, checks as f64, 1e3, "give 25 or more")?;
            }
        }
        water.check()
    }

    fn variant(&self) -> Variant {
        Variant::of("slope", self.slope).and("resolution", self.water.resolution)
    }

    fn cost(&self) -> RunCost {
        RunCost::incompressible(self.water.particles(), self.channel(&|_| 0.0).expected_steps())
    }

    fn trajectory(&self) -> Option<Self> {
        let Period::Fixed { averaging_time, .. } = self.period else { return None };
        let period = Period::Fixed { duration: 0.0, averaging_time };
        Some(Self { period, ..self.clone() })
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        let law = self.reference();
        self.channel(&|z| self.start_share * law.velocity(z)).run(progress)
    }
}

impl ClearWaterFlow {
    /// The flow that it is compared with.
    pub fn reference(&self) -> RoughChannel {
        RoughChannel {
            depth: self.water.depth,
            slope: self.slope,
            gravity: self.water.gravity,
            density: self.water.density,
            sand_roughness: self.sand_roughness,
            origin_offset: self.origin_offset,
        }
    }

    fn channel<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let time = self.reference().adjustment_time();
        let Self { slope, kinematic_viscosity, sand_roughness, origin_offset, turbulence, jitter, period, .. } = *self;
        let (until, window) = match period {
            Period::Fixed { duration, averaging_time } => (AveragingWindowEnd::Time(duration), averaging_time),
            Period::Stationary { tolerance, checks, at_most, averaging_times } => {
                (AveragingWindowEnd::Stationary { tolerance, checks, at_most: at_most * time }, averaging_times * time)
            }
        };
        Channel {
            slope,
            kinematic_viscosity,
            turbulence: turbulence.over(self.water.depth, origin_offset),
            bed: Bed::Rough { level: 0.0, origin_offset, law: RoughWall { sand_roughness } },
            jitter,
            until,
            window,
            interval: 0.01,
            ..self.water.channel(velocity)
        }
    }
}
