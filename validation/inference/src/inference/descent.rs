//! Gauss–Newton between bounds, for functions that cost nothing to evaluate.

use super::box_least_squares::box_least_squares;
use super::largest_distance;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// A cheap smooth vector function of the unit cube.
pub trait Smooth {
    /// Residuals `[-]` at a point.
    fn residuals(&self, point: &[f64]) -> DVector<f64>;
    /// Their derivatives, one column a coordinate.
    fn jacobian(&self, point: &[f64]) -> DMatrix<f64>;
}

/// A minimum that a descent has ended in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LocalMinimum {
    /// The point, in the unit cube.
    pub point: Vec<f64>,
    /// χ² there `[-]`.
    pub chi_squared: f64,
}

/// Distance along an axis within which two minima are one.
const SAME: f64 = 0.05;

impl LocalMinimum {
    /// Whether it lies at a point, such as that of another minimum which is the same then.
    pub fn is_at(&self, point: &[f64]) -> bool {
        largest_distance(&self.point, point) <= SAME
    }
}

/// Steps after which a descent gives up; a dozen is usual.
const MOST_STEPS: usize = 60;

/// Largest first step along an axis.
const FIRST_RADIUS: f64 = 0.25;

/// The minimum of Σ r² that lies downhill of `start` between the bounds.
pub fn descend(function: &impl Smooth, start: &[f64], lower: &[f64], upper: &[f64]) -> LocalMinimum {
    let mut point: Vec<f64> = start.iter().enumerate().map(|(k, u)| u.clamp(lower[k], upper[k])).collect();
    let mut residuals = function.residuals(&point);
    let mut chi_squared = residuals.norm_squared();
    let mut radius = FIRST_RADIUS;
    let mut jacobian = function.jacobian(&point);
    for _ in 0..MOST_STEPS {
        let least: Vec<f64> = (0..point.len()).map(|k| (lower[k] - point[k]).max(-radius)).collect();
        let most: Vec<f64> = (0..point.len()).map(|k| (upper[k] - point[k]).min(radius)).collect();
        let step = box_least_squares(&jacobian, &-&residuals, &least, &most);
        let predicted = chi_squared - (&residuals + &jacobian * &step).norm_squared();
        if predicted <= 1e-12 * (1.0 + chi_squared) {
            break;
        }
        let trial: Vec<f64> = (0..point.len()).map(|k| (point[k] + step[k]).clamp(lower[k], upper[k])).collect();
        let there = function.residuals(&trial);
        let gain = (chi_squared - there.norm_squared()) / predicted;
        let length = step.amax();
        if gain < 0.25 {
            radius = 0.25 * length;
        } else if gain > 0.75 && length > 0.99 * radius {
            radius = (2.0 * radius).min(1.0);
        }
        if gain > 0.0 {
            chi_squared = there.norm_squared();
            (point, residuals) = (trial, there);
            jacobian = function.jacobian(&point);
        } else if radius < 1e-12 {
            break;
        }
    }
    LocalMinimum { point, chi_squared }
}

/// The minimum that lies downhill of `start` in the unit cube with one coordinate held at a value.
pub(super) fn descend_held(function: &impl Smooth, start: &[f64], which: usize, value: f64) -> LocalMinimum {
    let (mut lower, mut upper) = (vec![0.0; start.len()], vec![1.0; start.len()]);
    (lower[which], upper[which]) = (value, value);
    descend(function, start, &lower, &upper)
}
