//! Least squares between bounds against conditions of a minimum.

use bagnold_inference::internals::box_least_squares;
use bagnold_inference::sampling::Random;
use nalgebra::{DMatrix, DVector};

#[test]
fn without_active_bounds_it_is_least_squares() {
    let matrix = DMatrix::from_row_slice(3, 2, &[1.0, 0.0, 1.0, 1.0, 1.0, 2.0]);
    let right = DVector::from_row_slice(&[1.0, 3.0, 5.0]);
    let x = box_least_squares(&matrix, &right, &[-9.0, -9.0], &[9.0, 9.0]);
    assert!((x[0] - 1.0).abs() < 1e-12 && (x[1] - 2.0).abs() < 1e-12);
}

/// The conditions of Karush, Kuhn and Tucker are necessary and sufficient.
#[test]
fn random_problems_meet_the_conditions_of_a_minimum() {
    let mut random = Random::new(11);
    for _ in 0..300 {
        let (rows, columns) = (1 + random.index(8), 1 + random.index(5));
        let matrix = DMatrix::from_fn(rows, columns, |_, _| random.normal());
        let right = DVector::from_fn(rows, |_, _| 3.0 * random.normal());
        let lower: Vec<f64> = (0..columns).map(|_| -random.uniform()).collect();
        let upper: Vec<f64> = (0..columns).map(|_| random.uniform()).collect();
        let x = box_least_squares(&matrix, &right, &lower, &upper);
        let force = matrix.tr_mul(&(&right - &matrix * &x));
        for k in 0..columns {
            assert!((lower[k]..=upper[k]).contains(&x[k]));
            let tolerance = 1e-9;
            assert!(x[k] == lower[k] || force[k] > -tolerance, "{force}");
            assert!(x[k] == upper[k] || force[k] < tolerance, "{force}");
        }
    }
}

#[test]
fn an_undetermined_variable_stays_where_it_is() {
    let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, 2.0, 0.0]);
    let right = DVector::from_row_slice(&[1.0, 2.0]);
    let x = box_least_squares(&matrix, &right, &[-0.5, -0.5], &[0.25, 0.5]);
    assert!(x[0] == 0.25 && x[1] == 0.0, "{x}");
}

#[test]
fn a_variable_without_room_is_left_alone() {
    let matrix = DMatrix::from_row_slice(1, 2, &[1.0, 1.0]);
    let x = box_least_squares(&matrix, &DVector::from_element(1, 1.0), &[0.25, -1.0], &[0.25, 1.0]);
    assert!(x[0] == 0.25 && (x[1] - 0.75).abs() < 1e-14);
}
