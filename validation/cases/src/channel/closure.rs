//! The closure of a channel's turbulence, as a case file chooses it.

use bagnold_solver::incompressible::Turbulence;
use bagnold_solver::material::turbulence::{MixingLength, MixingLengthShape, Smagorinsky};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cause of mixing beyond the particles' own motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
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
    pub fn over(self, depth: f64, origin_offset: f64) -> Turbulence {
        match self {
            Self::MixingLength { shape } => {
                Turbulence::MixingLength { level: 0.0, depth, law: MixingLength { shape, origin_offset } }
            }
            Self::Smagorinsky(law) => Turbulence::Smagorinsky(law),
        }
    }
}
