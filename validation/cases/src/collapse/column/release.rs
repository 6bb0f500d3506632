//! How columns are released.

use crate::setup::rules;
use bagnold_solver::parameter::between;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How columns are released and simulated: what all runs of a case share.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Release {
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.05 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time over √(h_0/g) `[-]`; a deposit at rest ends a run before.
    #[schemars(transform = between(0.1, 1000.0, "a column has come to rest after 5 to 12"))]
    pub duration: f64,
    /// Numerics.
    pub numerics: Numerics,
}

impl Release {
    /// As in the collapse paper, with these numerics.
    pub(crate) fn with(numerics: Numerics) -> Self {
        Self { gravity: 9.81, jitter: 0.05, seed: 1, duration: 15.0, numerics }
    }
}
