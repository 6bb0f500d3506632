//! A straight line through data of known uncertainty, where least squares gives everything in closed form: the best
//! parameters, χ², and intervals of ±1.96 standard deviations.

use bagnold_inference::inference::{Budget, Evaluate, Method, Repeatability, SolvePlan, solve};
use std::convert::Infallible;

/// Lower bound and width of the ranges of intercept and slope.
const RANGES: [(f64, f64); 2] = [(-1.0, 4.0), (0.0, 3.0)];
const UNCERTAINTY: f64 = 0.2;

/// Abscissas and ordinates; the scatter is drawn once and written down.
const DATA: [(f64, f64); 10] = [
    (0.0, 0.61),
    (0.4, 1.02),
    (0.8, 1.94),
    (1.2, 2.03),
    (1.6, 2.93),
    (2.0, 3.41),
    (2.4, 3.78),
    (2.8, 4.92),
    (3.2, 5.13),
    (3.6, 5.95),
];

struct Line;

impl Evaluate for Line {
    type Error = Infallible;

    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let of_point = |point: &Vec<f64>| {
            let [intercept, slope] = [0, 1].map(|k| RANGES[k].0 + RANGES[k].1 * point[k]);
            DATA.iter().map(|(x, y)| (intercept + slope * x - y) / UNCERTAINTY).collect()
        };
        Ok(points.iter().map(|point| Some(of_point(point))).collect())
    }
}

/// Intercept and slope, their standard deviations, and χ².
fn closed_form() -> ([f64; 2], [f64; 2], f64) {
    let count = DATA.len() as f64;
    let sum = |of: fn((f64, f64)) -> f64| DATA.into_iter().map(of).sum::<f64>();
    let (x, y, xx, xy) = (sum(|p| p.0), sum(|p| p.1), sum(|p| p.0 * p.0), sum(|p| p.0 * p.1));
    let determinant = count * xx - x * x;
    let (intercept, slope) = ((xx * y - x * xy) / determinant, (count * xy - x * y) / determinant);
    let deviations = [xx, count].map(|diagonal| UNCERTAINTY * (diagonal / determinant).sqrt());
    let chi_squared = DATA.iter().map(|(x, y)| ((intercept + slope * x - y) / UNCERTAINTY).powi(2)).sum();
    ([intercept, slope], deviations, chi_squared)
}

#[test]
fn a_search_finds_the_line_and_its_intervals() {
    let (best, deviations, chi_squared) = closed_form();
    let plan = SolvePlan {
        start: vec![0.1, 0.9],
        method: Method::TrustRegion,
        design: Vec::new(),
        budget: Budget { evaluations: 300, ..Budget::default() },
        region_evaluations: 40,
        runs: Repeatability::Smooth,
        series: Vec::new(),
    };
    let answer = solve(&mut Line, &plan).expect("it works");
    assert!((answer.search.chi_squared - chi_squared).abs() < 0.02, "{}", answer.search.chi_squared);
    let explored = answer.explored.expect("points enough");
    assert!(explored.is_settled());
    for k in 0..2 {
        let value = |point: &[f64]| RANGES[k].0 + RANGES[k].1 * point[k];
        let miss = (value(&answer.search.best) - best[k]) / deviations[k];
        assert!(miss.abs() < 0.1, "parameter {k}: off by {miss} standard deviations");
        for (end, sign) in explored.ends[k].iter().zip([-1.0, 1.0]) {
            let exact = best[k] + sign * 1.96 * deviations[k];
            let miss = (value(&end.point) - exact) / deviations[k];
            // an end is settled within a tenth of the rise, which is a twentieth of the distance
            assert!(miss.abs() < 0.1, "parameter {k}: end off by {miss} standard deviations");
        }
    }
}
