//! Model A: weakly compressible SPH of one material, with the stress carried by each particle.
//!
//! `step` is one symplectic Euler step, readable on a page.

pub mod boundary;
pub mod divergence;
mod model;
pub mod neighbours;
pub mod numerics;
pub mod operators;
pub mod particles;
mod records;
pub mod scene;
pub mod simulation;
pub mod snapshot;
mod step;
pub mod terms;
pub mod time_step;
pub(crate) mod viscous_solve;
