//! Student's t distribution.

use statrs::distribution::{ContinuousCDF, StudentsT};

/// t such that a share `confidence` of Student's distribution lies within ±t; not a number without freedom.
pub fn student_quantile(confidence: f64, degrees_of_freedom: usize) -> f64 {
    student_quantile_of(confidence, degrees_of_freedom as f64)
}

/// Quantile of Student's distribution for estimated, fractional degrees of freedom `[-]`.
pub fn student_quantile_of(confidence: f64, degrees_of_freedom: f64) -> f64 {
    StudentsT::new(0.0, 1.0, degrees_of_freedom).map_or(f64::NAN, |student| student.inverse_cdf(0.5 + 0.5 * confidence))
}
