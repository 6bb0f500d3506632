//! Fits and their uncertainty.

mod fit;

pub use fit::{
    Estimate, Exponent, LinearFit, Regression, common_slope, linear_fit, linear_regression, log_log_slope, power_law,
};
