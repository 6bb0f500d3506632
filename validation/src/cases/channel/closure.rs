//! The closure of a channel's turbulence, as a case file chooses it.

use crate::case::ParameterError;
use crate::cases::rules;
use bagnold_solver::incompressible::Turbulence;
use bagnold_solver::material::turbulence::{MixingLength, MixingLengthShape, Smagorinsky};
use serde::{Deserialize, Serialize};

/// What mixes beyond the particles' own motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum TurbulenceClosure {
    /// Prandtl's mixing length over the height above the bed.
    MixingLength {
        /// Shape over the depth.
        shape: MixingLengthShape,
    },
    /// Mixing below the particles' scale only: what is larger must be in their motion.
    Smagorinsky(Smagorinsky),
}

impl TurbulenceClosure {
    /// The closure in a flow of a depth `[m]` above the level 0, whose origin lies `origin_offset` `[m]` below it.
    #[must_use]
    pub fn over(self, depth: f64, origin_offset: f64) -> Turbulence {
        match self {
            Self::MixingLength { shape } => {
                Turbulence::MixingLength { level: 0.0, depth, law: MixingLength { shape, origin_offset } }
            }
            Self::Smagorinsky(law) => Turbulence::Smagorinsky(law),
        }
    }

    /// Checks the coefficient.
    ///
    /// # Errors
    /// A coefficient out of range.
    pub fn check(self, field: &str) -> Result<(), ParameterError> {
        match self {
            Self::MixingLength { .. } => Ok(()),
            Self::Smagorinsky(law) => {
                let field = format!("{field}.smagorinsky.coefficient");
                rules::between(&field, law.coefficient, 0.0, 1.0, "0.07 to 0.25 are usual; 0 is laminar flow")
            }
        }
    }
}
