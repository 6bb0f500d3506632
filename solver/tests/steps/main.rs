//! Whole steps, in one program that links the library: its passes are compiled and optimised there.

mod model_a;
mod model_b;

// a file of the unit tests stands here too, with the paths that it has there
use bagnold_solver::{domain, incompressible, material, vector};
