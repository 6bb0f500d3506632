//! A point at which the model was evaluated.

use super::super::{LocalMinimum, chi_squared};
use serde::{Deserialize, Serialize};

/// The model at one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluated {
    /// Coordinates in the unit cube.
    pub point: Vec<f64>,
    /// Weighted residuals `[-]`; none where the model failed.
    pub residuals: Option<Vec<f64>>,
    /// χ² `[-]`; none where the model failed.
    pub chi_squared: Option<f64>,
}

impl Evaluated {
    /// A point with what the model returned there; a residual that is no finite number is a failure.
    pub fn new(point: Vec<f64>, residuals: Option<Vec<f64>>) -> Self {
        let residuals = residuals.filter(|list| list.iter().all(|residual| residual.is_finite()));
        let chi_squared = residuals.as_deref().map(chi_squared);
        Self { point, residuals, chi_squared }
    }
}

/// The evaluated point of least χ²; none where the model failed at all.
pub fn lowest(history: &[Evaluated]) -> Option<LocalMinimum> {
    let worked = |own: &Evaluated| Some(LocalMinimum { point: own.point.clone(), chi_squared: own.chi_squared? });
    history.iter().filter_map(worked).min_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared))
}
