//! A compact SPH kernel for granular and sediment flows: no I/O, knows no case, SI units throughout.
//!
//! Reading order: [`vector`], the leaves ([`kernel`], [`rheology`], [`equation_of_state`], [`turbulence`], [`drag`]),
//! then [`neighbours`], [`operators`], [`terms`] and [`boundary`], and last the step in `weakly_compressible` and the
//! loop in [`simulation`]. Equation numbers are those of Salehizadeh & Shafiei (2018). [`incompressible`] is a model of its own,
//! with the equation numbers of its own paper.

pub mod vector;

pub mod drag;
pub mod equation_of_state;
pub mod kernel;
pub mod lanes;
pub mod numerics;
pub mod rheology;
pub mod turbulence;

pub mod boundary;
pub mod neighbours;
pub mod operators;
pub mod particles;
mod records;
pub mod terms;

pub mod divergence;
pub mod incompressible;
mod linear;
mod observed_run;
pub mod scene;
pub mod simulation;
pub mod snapshot;
pub mod time_step;
mod viscous_solve;
mod weakly_compressible;
