//! Do calibrations keep their promise? Synthetic experiments of known truth, repeated.
//!
//! The cheap part runs always; the full study is ignored: `cargo test --test suite calibration:: -- --ignored --nocapture`.
//! `profile.py` compares the ends of intervals with SciPy's own profile likelihood.

mod coverage;
mod film;
mod findings;
mod held_out;
mod laws;
mod layer;
mod minima;
mod particles;
mod scattering;
mod simulated;
mod strangers;
mod two_valleys;
