//! Descents to known minima.

use bagnold_inference::internals::{Smooth, descend};
use nalgebra::{DMatrix, DVector};

/// Rosenbrock's valley in the unit cube, minimum at (0.6, 0.36).
struct RosenbrockFunction;

impl Smooth for RosenbrockFunction {
    fn residuals(&self, u: &[f64]) -> DVector<f64> {
        DVector::from_row_slice(&[30.0 * (u[1] - u[0] * u[0]), 3.0 * (0.6 - u[0])])
    }
    fn jacobian(&self, u: &[f64]) -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &[-60.0 * u[0], 30.0, -3.0, 0.0])
    }
}

#[test]
fn the_bottom_of_a_valley_is_found() {
    let bottom = descend(&RosenbrockFunction, &[0.0, 1.0], &[0.0, 0.0], &[1.0, 1.0]);
    assert!((bottom.point[0] - 0.6).abs() < 1e-8 && (bottom.point[1] - 0.36).abs() < 1e-8);
    assert!(bottom.chi_squared < 1e-14);
}

#[test]
fn a_bound_is_kept() {
    // with x ≤ 0.5 the best y is 0.25
    let bottom = descend(&RosenbrockFunction, &[0.0, 1.0], &[0.0, 0.0], &[0.5, 1.0]);
    assert_eq!(bottom.point[0], 0.5);
    assert!((bottom.point[1] - 0.25).abs() < 1e-8 && (bottom.chi_squared - 0.09).abs() < 1e-10);
}
