//! A compact SPH kernel for granular and sediment flows: no I/O, knows no case, SI units throughout.
//!
//! Reading order: [`vector`], [`kernel`], [`domain`]; every law in [`material`]; then the two models, built alike:
//! [`weakly_compressible`] (equation numbers of Salehizadeh & Shafiei 2018) and [`incompressible`] (those of Kazemi et al.).
//! [`run`] has the loop of both.

pub mod domain;
pub mod kernel;
pub mod lanes;
pub mod parameter;
pub mod vector;

mod cell_order;
mod linear;
pub mod material;
mod parallel;

pub mod run;

pub mod incompressible;
pub mod weakly_compressible;

#[doc(hidden)]
pub mod internals;
