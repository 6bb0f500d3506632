//! Polynomials are reproduced, and what they miss is corrected.

mod correction;

use crate::stand_in::ExponentialDecay;
use bagnold_inference::inference::emulator::Degree;
use bagnold_inference::inference::{Emulator, Evaluate, Evaluated, chi_squared};
use bagnold_inference::sampling::design::{full_grid, latin_hypercube};

fn evaluated(points: &[Vec<f64>], residuals: impl Fn(&[f64]) -> Option<Vec<f64>>) -> Vec<Evaluated> {
    let one = |point: &Vec<f64>| {
        let residuals = residuals(point);
        let chi_squared = residuals.as_deref().map(chi_squared);
        Evaluated { point: point.clone(), residuals, chi_squared }
    };
    points.iter().map(one).collect()
}

/// Two residuals that are polynomials of second degree; the minimum, χ² = 0, lies at (0.4, 0.7).
fn quadratic(u: &[f64]) -> Vec<f64> {
    let (x, y) = (u[0] - 0.4, u[1] - 0.7);
    vec![3.0 * x + x * y - 2.0 * y * y, 5.0 * y + x * x]
}

#[test]
fn quadratic_residuals_are_reproduced() {
    let history = evaluated(&latin_hypercube(12, 2, 3), |u| Some(quadratic(u)));
    let emulator = Emulator::fit(&history, 0.02).unwrap();
    assert_eq!(emulator.degree, Degree::Quadratic);
    let u = [0.15, 0.3];
    for (found, exact) in emulator.predict(&u).iter().zip(quadratic(&u)) {
        assert!((found - exact).abs() < 1e-10);
    }
    assert!((emulator.chi_squared(&u) - chi_squared(&quadratic(&u))).abs() < 1e-9);
    assert!(emulator.leave_one_out.unwrap() < 1e-9);
    let minimum = emulator.minimum();
    assert!((minimum.point[0] - 0.4).abs() < 1e-6 && (minimum.point[1] - 0.7).abs() < 1e-6, "{minimum:?}");
}

#[test]
fn the_jacobian_is_that_of_differences() {
    let history = evaluated(&latin_hypercube(12, 2, 3), |u| Some(quadratic(u)));
    let emulator = Emulator::fit(&history, 0.02).unwrap();
    let (u, h) = ([0.2, 0.6], 1e-5);
    let jacobian = emulator.jacobian(&u);
    for k in 0..2 {
        let at = |step: f64| {
            let mut point = u;
            point[k] += step;
            emulator.predict(&point)
        };
        for row in 0..2 {
            let difference = (at(h)[row] - at(-h)[row]) / (2.0 * h);
            assert!((jacobian[(row, k)] - difference).abs() < 1e-8);
        }
    }
}

#[test]
fn the_degree_follows_the_number_of_points() {
    let degree = |count| {
        let history = evaluated(&latin_hypercube(count, 2, 3), |u| Some(quadratic(u)));
        Emulator::fit(&history, 0.02).map(|emulator| emulator.degree)
    };
    assert_eq!([2, 3, 8, 9].map(degree), [None, Some(Degree::Linear), Some(Degree::Linear), Some(Degree::Quadratic)]);
}

#[test]
fn failed_points_are_left_out() {
    let history = evaluated(&latin_hypercube(20, 2, 3), |u| (u[0] < 0.6).then(|| quadratic(u)));
    let minimum = Emulator::fit(&history, 0.02).unwrap().minimum();
    assert!((minimum.point[0] - 0.4).abs() < 1e-6 && (minimum.point[1] - 0.7).abs() < 1e-6);
}

#[test]
fn the_minimum_of_a_smooth_curve_is_close() {
    let curve = ExponentialDecay::new();
    let points = full_grid(&[4, 4, 4]);
    let residuals = curve.clone().residuals(&points).unwrap();
    let history = evaluated(&points, |u| residuals[points.iter().position(|point| point == u)?].clone());
    let emulator = Emulator::fit(&history, 0.02).unwrap();
    let minimum = emulator.minimum();
    let off = (0..3).map(|k| (minimum.point[k] - curve.truth[k]).abs()).fold(0.0, f64::max);
    println!("off by {off}, leave-one-out error {:?}", emulator.leave_one_out);
    assert!(off < 0.05);
}
