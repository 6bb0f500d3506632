//! The formulations of the two-phase model that know single grains.

use bagnold_solver::incompressible::ProjectionNumerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A formulation of the two-phase model that knows single grains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GrainFormulation {
    /// The bed-load paper's operators, drag from the slip of each pair.
    Paper,
    /// The case's numerics, drag from the slip against the mean of the fluid around.
    Stabilised,
}

impl GrainFormulation {
    /// Its name in parameters and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Stabilised => "stabilised",
        }
    }

    pub(super) fn numerics(self, of_case: ProjectionNumerics) -> ProjectionNumerics {
        let ProjectionNumerics { smoothing_ratio, time_step, pressure_tolerance, velocity_tolerance, .. } = of_case;
        match self {
            Self::Stabilised => of_case,
            Self::Paper => ProjectionNumerics {
                smoothing_ratio,
                time_step,
                pressure_tolerance,
                velocity_tolerance,
                ..ProjectionNumerics::paper()
            },
        }
    }
}
