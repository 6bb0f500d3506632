//! Fits and their uncertainty.

mod fit;

pub use fit::{LinearFit, linear_fit, log_log_slope};
