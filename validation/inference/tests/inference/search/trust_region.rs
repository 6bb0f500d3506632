//! Steps of the trust region on linear models.

use bagnold_inference::inference::{Budget, Evaluate, Method, Termination, search};
use std::convert::Infallible;

/// r = u − target, whose target may lie outside the cube.
struct Linear(Vec<f64>);

impl Evaluate for Linear {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let one = |u: &Vec<f64>| u.iter().zip(&self.0).map(|(u, t)| 100.0 * (u - t)).collect();
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

#[test]
fn a_minimum_on_a_face_is_reached() {
    let found = search(&mut Linear(vec![1.3, 0.4]), &[0.5, 0.5], Method::TrustRegion, Budget::default()).unwrap();
    assert_eq!(found.best[0], 1.0);
    assert!((found.best[1] - 0.4).abs() < 1e-12 && found.stopped == Termination::Converged);
    assert!(found.history.len() <= 12, "{}", found.history.len());
}

#[test]
fn a_linear_model_takes_one_step_once_it_is_in_reach() {
    let found = search(&mut Linear(vec![0.6, 0.4]), &[0.5, 0.5], Method::TrustRegion, Budget::default()).unwrap();
    // the start, two differences, the minimum, and differences there both ways
    assert!(found.history.len() <= 8 && found.chi_squared < 1e-15, "{found:?}");
}
