//! Tests of the package, one module for each of its own, in one program that links the library.

mod inference;
mod sampling;
mod stand_in;
mod statistics;
