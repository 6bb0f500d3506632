//! The places that the particles of a layer start from.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Initial arrangement of the particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// On a square lattice.
    Lattice,
    /// Displaced at random from the lattice.
    Jittered,
}

impl Arrangement {
    /// Name in files and variants.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lattice => "lattice",
            Self::Jittered => "jittered",
        }
    }

    /// Largest displacement of a particle, where it is `jitter` for those that are displaced.
    pub fn displacement(self, jitter: f64) -> f64 {
        match self {
            Self::Lattice => 0.0,
            Self::Jittered => jitter,
        }
    }
}
