//! Minima of functions with several.

use bagnold_inference::inference::{Budget, Evaluate, LocalMinimum, Method, search};
use std::convert::Infallible;

/// Residuals as a function of the point.
struct Function<F>(F);

impl<F: Fn(&[f64]) -> Vec<f64>> Evaluate for Function<F> {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|point| Some((self.0)(point))).collect())
    }
}

fn minima(function: impl Fn(&[f64]) -> Vec<f64>, start: &[f64], starts: usize) -> (Vec<LocalMinimum>, usize) {
    let budget = Budget { starts, ..Budget::default() };
    let found = search(&mut Function(function), start, Method::TrustRegion, budget).expect("it works");
    println!("{start:?}: {} evaluations, {:.3?}, {}", found.history.len(), found.minima, found.stopped);
    (found.minima, found.history.len())
}

const STARTS: [f64; 5] = [0.02, 0.25, 0.5, 0.75, 0.98];

/// A quartic in one residual and a slope in another: minima near 0.2 and 0.8, the second lower.
#[test]
fn both_minima_of_two_are_found_from_everywhere() {
    let wells = |u: &[f64]| vec![40.0 * (u[0] - 0.2) * (u[0] - 0.8), 3.0 * (1.0 - u[0])];
    for start in STARTS {
        let (found, _) = minima(wells, &[start], 4);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!((found[0].point[0] - 0.8).abs() < 0.05 && (found[1].point[0] - 0.2).abs() < 0.05);
        assert!(found[0].chi_squared < found[1].chi_squared);
    }
}

/// Branin's function over its own rectangle, as two residuals: three minima of equal depth, here made unequal by a third.
fn branin(u: &[f64]) -> Vec<f64> {
    let (x, y) = (15.0 * u[0] - 5.0, 15.0 * u[1]);
    let pi = std::f64::consts::PI;
    let parabola = y - 5.1 / (4.0 * pi * pi) * x * x + 5.0 / pi * x - 6.0;
    // (1 + cos x) is 2 cos²(x/2)
    let wave = (20.0 * (1.0 - 1.0 / (8.0 * pi))).sqrt() * libm::cos(0.5 * x);
    vec![parabola, wave, 2.0 * (u[0] - 0.55)]
}

/// A valley that is closed in the middle: (x² − 0.1) and a tilt, in two dimensions.
fn saddle(u: &[f64]) -> Vec<f64> {
    let (x, y) = (2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0);
    vec![20.0 * (x * x - 0.36), 10.0 * (y - 0.5 * x), 1.5 * (x + 0.6)]
}

/// Himmelblau's function: four minima, one of which a third residual leaves lowest.
fn himmelblau(u: &[f64]) -> Vec<f64> {
    let (x, y) = (10.0 * u[0] - 5.0, 10.0 * u[1] - 5.0);
    vec![x * x + y - 11.0, x + y * y - 7.0, 0.5 * (x - 3.0)]
}

/// Number of 25 descents' starts that find the lowest minimum, and of those that find another one beside it.
fn found(function: fn(&[f64]) -> Vec<f64>, lowest: [f64; 2]) -> (usize, usize) {
    let (mut reached, mut several) = (0, 0);
    for first in STARTS {
        for second in STARTS {
            let (found, _) = minima(function, &[first, second], 8);
            reached += usize::from(found[0].point.iter().zip(lowest).all(|(a, b)| (a - b).abs() < 0.03));
            several += usize::from(found.len() > 1);
        }
    }
    (reached, several)
}

#[test]
fn the_lower_of_two_minima_is_found_from_everywhere() {
    assert_eq!(found(saddle, [0.2, 0.35]), (25, 25));
}

#[test]
fn the_lowest_of_four_minima_is_found_from_everywhere() {
    assert_eq!(found(himmelblau, [0.8, 0.7]), (25, 25));
}

/// Its minima lie far apart in narrow valleys: eight starts do not always suffice.
#[test]
fn the_lowest_of_branins_minima_is_mostly_found() {
    let (reached, several) = found(branin, [0.5428, 0.1517]);
    println!("lowest {reached}, several {several} of 25");
    assert!(reached >= 17 && several >= 12, "{reached} {several} of 25");
}

#[test]
fn one_minimum_costs_little_more_than_its_starts() {
    let bowl = |u: &[f64]| vec![20.0 * (u[0] - 0.6), 20.0 * (u[1] - 0.3), 3.0 * (u[0] + u[1] * u[1])];
    let (_, alone) = minima(bowl, &[0.5, 0.5], 0);
    let (found, with) = minima(bowl, &[0.5, 0.5], 6);
    assert!(found.len() == 1 && with <= alone + 12, "{alone} and {with}");
}
