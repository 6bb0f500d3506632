//! The runs of the case: single grains and suspensions.

use super::grain::{self, GrainRun};
use super::parameters::SettlingParameters;
use super::probe::SettlingObservation;
use super::suspension::{self, SuspensionRun};
use crate::case::{ParameterError, Progress, Run};
use crate::metric::Variant;
use crate::observation::Recorded;
use bagnold_solver::material::drag::DragLaw;
use serde::Serialize;

/// One simulation.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SettlingRun {
    /// A grain alone.
    Grain(GrainRun),
    /// A uniform suspension.
    Suspension(SuspensionRun),
}

pub(super) fn all(parameters: &SettlingParameters) -> Vec<SettlingRun> {
    let grains = grain::runs(parameters).into_iter().map(SettlingRun::Grain);
    grains.chain(suspension::runs(parameters).into_iter().map(SettlingRun::Suspension)).collect()
}

impl Run for SettlingRun {
    type Observation = SettlingObservation;

    fn variant(&self) -> Variant {
        match self {
            Self::Grain(run) => run.variant(),
            Self::Suspension(run) => run.variant(),
        }
    }

    fn particle_steps(&self) -> f64 {
        match self {
            Self::Grain(run) => run.particle_steps(),
            Self::Suspension(run) => run.particle_steps(),
        }
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SettlingObservation>, ParameterError> {
        match self {
            Self::Grain(run) => run.simulate(progress),
            Self::Suspension(run) => run.simulate(progress),
        }
    }
}

impl SettlingRun {
    /// Drag law.
    #[must_use]
    pub fn law(&self) -> DragLaw {
        match self {
            Self::Grain(run) => run.experiment.law,
            Self::Suspension(run) => run.experiment.law,
        }
    }

    /// Root of the balance of weight and drag `[m/s]`: the slip.
    #[must_use]
    pub fn root(&self) -> f64 {
        match self {
            Self::Grain(run) => run.terminal_velocity(),
            Self::Suspension(run) => run.slip(),
        }
    }
}
