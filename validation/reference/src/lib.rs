//! References of results: exact profiles, layers in one dimension that check the particles independently, and
//! published or measured data, by the flow that they are about.
//!
//! Nothing here uses the particle solver, so that agreement with it means something. Of the solver only laws are used: drag,
//! viscosity of suspensions, roughness of grains, and the parameters of μ(I) as a record.

pub mod bed_load;
pub mod collapse;
pub mod film;
pub mod grains;
pub mod one_dimension;
pub mod points;
pub mod settling;
pub mod water;

use bagnold_harness::{evidence, input, metric};
use bagnold_inference::statistics;
