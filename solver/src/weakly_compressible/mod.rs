//! Model A: weakly compressible SPH.
//!
//! `step` is one symplectic Euler step with the explicit stress update. An implicit viscous solve belongs beside it,
//! between the forces and the new velocity.

mod model;
mod step;

pub(crate) use model::Model;
