//! Pair sums: one physical term a file, fused into as few loops as the data flow allows.

pub mod artificial_viscosity;
pub(crate) mod continuity;
pub mod density_coupling;
pub mod hourglass;
pub(crate) mod momentum;
pub(crate) mod pairwise;
