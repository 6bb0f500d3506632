//! Elementary effects of a formula.

use bagnold_inference::inference::Evaluate;
use bagnold_inference::inference::sensitivity::{screen, trajectories};
use std::convert::Infallible;

/// Linear in the first parameter, a product of the second and third, and without the fourth.
struct ProductModel {
    beyond: f64,
}

impl Evaluate for ProductModel {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let one = |u: &Vec<f64>| (u[3] <= self.beyond).then(|| vec![7.0 * u[0] - 1.0, 12.0 * u[1] * u[2]]);
        Ok(points.iter().map(one).collect())
    }
}

#[test]
fn effects_are_those_of_the_formula() {
    let effects = screen(&mut ProductModel { beyond: 1.0 }, 4, 400, 3).unwrap();
    // one datum of two with effect 7
    assert!((effects[0].mean_size - 7.0 / 2.0f64.sqrt()).abs() < 1e-12 && effects[0].deviation < 1e-12);
    // 12 u with u = 0, 1/3, 2/3, 1: mean 6, deviation 12 √(5/36)
    for effect in &effects[1..3] {
        assert!((effect.mean_size - 6.0 / 2.0f64.sqrt()).abs() < 0.3, "{effect:?}");
        assert!((effect.deviation - 12.0 * (5.0f64 / 36.0).sqrt() / 2.0f64.sqrt()).abs() < 0.2, "{effect:?}");
    }
    assert_eq!(effects[3].mean_size, 0.0);
}

#[test]
fn failures_are_left_out() {
    let effects = screen(&mut ProductModel { beyond: 0.5 }, 4, 50, 3).unwrap();
    assert!(effects[3].mean_size.is_nan(), "every step of the fourth parameter has an end that fails");
    assert!((effects[0].mean_size - 7.0 / 2.0f64.sqrt()).abs() < 1e-12);
}

#[test]
fn a_trajectory_changes_every_parameter_once() {
    for line in trajectories(30, 3, 1).chunks(4) {
        let changed = |k: usize| line.windows(2).filter(|ends| ends[0][k] != ends[1][k]).count();
        assert!((0..3).all(|k| changed(k) == 1));
        assert!(line.iter().flatten().all(|u| [0.0, 1.0, 2.0, 3.0].iter().any(|l| (u - l / 3.0).abs() < 1e-12)));
    }
}
