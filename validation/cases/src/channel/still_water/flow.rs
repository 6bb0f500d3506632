//! The flow: a column of water at rest.

use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::channel::{AveragingWindowEnd, Channel, ChannelObservation, Water};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::setup::rules;
use bagnold_solver::parameter::{between, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A displaced column of water that comes to rest; without stabilisation of the pressure it blows up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StillWaterFlow {
    /// Depth, resolution and density of the water.
    #[serde(flatten)]
    pub water: Water,
    /// Kinematic viscosity `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.1 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.1, 1e4, "give 20 s for water at rest; an instability shows within 0.5 s"))]
    pub duration: f64,
    /// Averaging window before the end `[s]`.
    pub averaging_time: f64,
}

impl Default for StillWaterFlow {
    fn default() -> Self {
        Self { water: Water::of_rows(23), kinematic_viscosity: 1e-6, jitter: 0.1, duration: 5.0, averaging_time: 1.0 }
    }
}

impl Flow for StillWaterFlow {
    const RUNS: &'static str = include_str!("../../../runs/still-water.toml");
    type Observation = ChannelObservation;

    fn check(&self) -> Result<(), ParameterError> {
        let longest = 0.5 * self.duration;
        rules::between("averaging_time", self.averaging_time, 0.01, longest, "give at most half of the duration")?;
        self.water.check()
    }

    fn variant(&self) -> Variant {
        Variant::of("jitter", self.jitter)
            .and("stabilisation", self.water.numerics.stabilisation)
            .and("resolution", self.water.resolution)
    }

    fn cost(&self) -> RunCost {
        RunCost::incompressible(self.water.particles(), self.channel().expected_steps())
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, ..self.clone() })
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        self.channel().run(progress)
    }
}

impl StillWaterFlow {
    /// Whether it is run to show that it fails.
    pub fn is_unstabilised(&self) -> bool {
        self.water.numerics.stabilisation == 0.0
    }

    fn channel(&self) -> Channel<'static> {
        Channel {
            kinematic_viscosity: self.kinematic_viscosity,
            jitter: self.jitter,
            until: AveragingWindowEnd::Time(self.duration),
            window: self.averaging_time,
            // a column that blows up does so within a few steps
            interval: if self.is_unstabilised() { self.water.numerics.time_step } else { 5e-3 },
            may_diverge: self.is_unstabilised(),
            ..self.water.channel(&|_| 0.0)
        }
    }
}
