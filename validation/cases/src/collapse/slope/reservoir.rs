//! The reservoir of grains on a slope and its channel.

use crate::setup::rules;
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The reservoir, its channel and how they are simulated: what all runs of a case share.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Reservoir {
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Height of the reservoir h_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.14"))]
    pub initial_height: f64,
    /// Length of the reservoir r_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.2"))]
    pub reservoir_length: f64,
    /// Length of the channel from the back of the reservoir `[m]`.
    pub channel_length: f64,
    /// Particles over the length of the reservoir.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.05 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time `[s]`; a deposit at rest ends a run before.
    #[schemars(transform = between(0.01, 1000.0, "deposits on mild slopes rest after about 1.5 s"))]
    pub duration: f64,
    /// Numerics.
    pub numerics: Numerics,
}
