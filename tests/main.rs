//! The physics regression suite, one program: `cargo test -p bagnold-tests --test suite physics::falling` runs a part of it.

mod calibration;
mod command_line;
mod convergence;
mod determinism;
mod documentation;
mod inputs;
mod invariants;
mod physics;
mod snapshots;
mod structure;
mod threads;
