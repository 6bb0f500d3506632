//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier, cost};
use crate::channel::{AveragingWindowEnd, Channel, ChannelObservation, Water};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::setup::rules;
use bagnold_solver::incompressible::ProjectionNumerics;
use bagnold_solver::parameter::{between, each, filled, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct StillWaterParameters {
    /// The water.
    #[serde(flatten)]
    pub water: Water,
    /// Kinematic viscosity `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Largest random displacement of a particle in spacings, one run each `[-]`.
    #[schemars(transform = each(between(0.0, 0.5, "0.1 breaks the lattice without overlaps")))]
    #[schemars(transform = unique("name every displacement once"))]
    #[schemars(transform = filled("at least one displacement", "0.1 breaks the lattice"))]
    pub jitters: Vec<f64>,
    /// Displacements of the runs without stabilisation `[-]`; empty for none.
    #[schemars(transform = each(between(0.0, 0.5, "0.1 breaks the lattice without overlaps")))]
    #[schemars(transform = unique("name every displacement once"))]
    pub unstabilised_jitters: Vec<f64>,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.5, 1e4, "20 s bring the water to rest"))]
    pub duration: f64,
    /// Averaging window before the end `[s]`.
    pub averaging_time: f64,
    /// Simulated time without stabilisation `[s]`.
    #[schemars(transform = between(0.1, 1e3, "half a second is enough to blow up"))]
    pub unstabilised_duration: f64,
}

impl Parameters for StillWaterParameters {
    type Run = StillWaterRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            water: Water::of_rows(23),
            kinematic_viscosity: 1e-6,
            jitters: vec![0.1, 0.4],
            unstabilised_jitters: vec![0.4],
            duration: 5.0,
            averaging_time: 1.0,
            unstabilised_duration: 0.5,
        };
        let paper = Self {
            water: Water { columns: 20, ..quick.water },
            jitters: vec![0.02, 0.1, 0.2, 0.4],
            duration: 20.0,
            averaging_time: 4.0,
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self { water: paper.water.finer(), ..paper },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let longest = 0.5 * self.duration;
        rules::between("averaging_time", self.averaging_time, 0.2, longest, "the window lies in the second half")?;
        self.water.check()
    }

    fn runs(&self) -> Vec<StillWaterRun> {
        let Self { water, kinematic_viscosity, duration, averaging_time, .. } = *self;
        let stabilised = |&jitter: &f64| StillWaterRun {
            jitter,
            unstabilised: false,
            water,
            kinematic_viscosity,
            duration,
            averaging_time,
        };
        let unstabilised = |jitter: &f64| StillWaterRun {
            unstabilised: true,
            water: Water { numerics: ProjectionNumerics { stabilisation: 0.0, ..water.numerics }, ..water },
            duration: self.unstabilised_duration,
            averaging_time: 0.5 * self.unstabilised_duration,
            ..stabilised(jitter)
        };
        let mut runs: Vec<StillWaterRun> = self.jitters.iter().map(stabilised).collect();
        // where nothing is stabilised, there is nothing to compare
        if water.numerics.stabilisation > 0.0 {
            runs.extend(self.unstabilised_jitters.iter().map(unstabilised));
        }
        runs
    }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct StillWaterRun {
    /// Largest displacement in spacings `[-]`.
    pub jitter: f64,
    /// Whether it is run to show that it fails.
    pub unstabilised: bool,
    /// The water, with the numerics of this run.
    pub water: Water,
    /// Simulated time `[s]`.
    pub duration: f64,
    kinematic_viscosity: f64,
    averaging_time: f64,
}

impl Run for StillWaterRun {
    type Observation = ChannelObservation;

    fn variant(&self) -> Variant {
        Variant::of("jitter", self.jitter)
            .and("stabilisation", self.water.numerics.stabilisation)
            .and("resolution", self.water.resolution)
    }

    fn particles(&self) -> f64 {
        self.water.particles()
    }

    fn seconds_per_particle_step(&self) -> f64 {
        cost::INCOMPRESSIBLE
    }

    fn particle_steps(&self) -> f64 {
        self.channel().expected_steps() * self.water.particles()
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, ..self.clone() })
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<ChannelObservation>, ParameterError> {
        self.channel().run(progress)
    }
}

impl StillWaterRun {
    fn channel(&self) -> Channel<'static> {
        Channel {
            kinematic_viscosity: self.kinematic_viscosity,
            jitter: self.jitter,
            until: AveragingWindowEnd::Time(self.duration),
            window: self.averaging_time,
            // a column that blows up does so within a few steps
            interval: if self.unstabilised { self.water.numerics.time_step } else { 5e-3 },
            may_diverge: self.unstabilised,
            ..self.water.channel(&|_| 0.0)
        }
    }
}
