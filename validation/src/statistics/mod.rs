//! Fits and their uncertainty.

mod fit;

pub use fit::{Exponent, LinearFit, linear_fit, log_log_slope, power_law};
