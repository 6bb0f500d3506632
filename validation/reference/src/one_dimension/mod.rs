//! Layers in one dimension, solved without particles: what the particle solver is verified against.
//!
//! A layer of dry grains on an incline has an exact steady profile ([`BagnoldProfile`]) and a motion towards it
//! ([`LayerTransient`]), and so has one under the nonlocal law ([`NonlocalLayer`]); chutes, heaps and plane
//! shear under gravity of that law have a steady flow whose stresses are known ([`NonlocalShear`]); a stream over a bed of grains has a steady state of both phases ([`bed_load`]). Finite volumes,
//! exact stresses where nothing flows, no particles, no files and no cases. Of the solver only laws are used (drag, viscosity of
//! suspensions, roughness of grains) and the parameters of μ(I), so that agreement verifies the discretisation.

mod bagnold_profile;
pub mod bed_load;
mod error;
mod fluidity_balance;
mod layer_transient;
mod nonlocal_layer;
mod nonlocal_shear;
#[cfg(test)]
mod nonlocal_transient;
mod steadiness;
mod table;
mod tridiagonal;

pub use bagnold_profile::BagnoldProfile;
pub use error::LayerError;
pub use layer_transient::{LayerProfile, LayerTransient, TransientHistory};
pub use nonlocal_layer::{NonlocalLayer, NonlocalProfile};
pub use nonlocal_shear::{NonlocalShear, NonlocalShearProfile, ShearStress};
pub use steadiness::time_to_steadiness;
