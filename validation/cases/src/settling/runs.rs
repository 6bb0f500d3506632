//! The runs of the case: single grains and suspensions.

use super::experiment::Experiment;
use super::grain::GrainRun;
use super::probe::{Probe, SettlingObservation};
use super::suspension::SuspensionRun;
use crate::case::{ParameterError, Progress, Run, cost};
use crate::metric::Variant;
use crate::observation::Recorded;
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

impl Run for SettlingRun {
    type Observation = SettlingObservation;

    fn variant(&self) -> Variant {
        let of = |formulation: &str| Variant::of("formulation", formulation).and("law", self.experiment().law.name());
        match self {
            Self::Grain(run) => of(run.formulation.name()),
            Self::Suspension(run) => of("continuum").and("solid_fraction", run.solid_fraction),
        }
    }

    fn particles(&self) -> f64 {
        let cells = self.experiment().vessel.lattice().len();
        let particles = match self {
            Self::Grain(_) => cells + 1,
            Self::Suspension(_) => 2 * cells,
        };
        particles as f64
    }

    fn seconds_per_particle_step(&self) -> f64 {
        cost::INCOMPRESSIBLE
    }

    fn particle_steps(&self) -> f64 {
        let Experiment { duration, numerics, .. } = self.experiment();
        duration / numerics.time_step * self.particles()
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SettlingObservation>, ParameterError> {
        let scene = match self {
            Self::Grain(run) => run.scene(),
            Self::Suspension(run) => run.scene(),
        };
        Probe::run(&scene, self.experiment(), progress)
    }
}

impl SettlingRun {
    /// The grains in their vessel.
    #[must_use]
    pub fn experiment(&self) -> &Experiment {
        match self {
            Self::Grain(run) => &run.experiment,
            Self::Suspension(run) => &run.experiment,
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
