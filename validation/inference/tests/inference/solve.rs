//! Restarts and plateaus of whole calibrations.

use bagnold_inference::inference::{Budget, Evaluate, Method, Repeatability, SolvePlan, Termination, solve};
use std::convert::Infallible;

/// Two wells; the lower one is at 0.9.
struct DoubleWell;

impl Evaluate for DoubleWell {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let one = |u: &Vec<f64>| vec![14.0 * (u[0] - 0.15) * (u[0] - 0.9), 2.0 * (1.0 - u[0]), 0.5, -0.5];
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

/// A peak of a height that the data show, and residuals that do not change away from it.
struct Peak(f64);

impl Evaluate for Peak {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let peak = |u: f64, centre: f64| self.0 * libm::exp(-((u - centre) / 0.06) * ((u - centre) / 0.06));
        let one = |u: &Vec<f64>| vec![peak(u[0], 0.8) - 100.0, peak(u[0], 0.83) - 80.0, 0.5];
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

fn plan(starts: usize) -> SolvePlan {
    SolvePlan {
        start: vec![0.1],
        method: Method::TrustRegion,
        design: Vec::new(),
        budget: Budget { starts, ..Budget::default() },
        region_evaluations: 20,
        runs: Repeatability::Smooth,
        series: Vec::new(),
    }
}

#[test]
fn a_search_leaves_a_plateau() {
    for starts in [0, 4, 8] {
        let found = solve(&mut Peak(100.0), &plan(starts)).expect("it works").search;
        assert!((found.best[0] - 0.8).abs() < 0.02 && found.stopped == Termination::Converged, "{found:?}");
    }
}

#[test]
fn a_plateau_without_an_edge_is_not_convergence() {
    let found = solve(&mut Peak(1e-9), &plan(4)).expect("it works").search;
    assert!(found.stopped == Termination::Plateau && found.stopped.to_string().contains("move the start"));
}

#[test]
fn a_search_is_begun_anew_from_a_lower_point() {
    let answer = solve(&mut DoubleWell, &plan(0)).expect("it works");
    assert!(answer.restarts == 1 && (answer.search.best[0] - 0.9).abs() < 0.02, "{:?}", answer.search.best);
    assert_eq!(answer.search.minima.len(), 2);
    let explored = answer.explored.expect("enough points");
    assert!(explored.is_settled() && explored.region.minimum.point == answer.search.best);
    assert_eq!(explored.region.minimum.chi_squared, answer.search.chi_squared);
}
