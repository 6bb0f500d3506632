//! Ends against the model's own profile, found by brute force.

use crate::stand_in::ExponentialDecay;
use bagnold_inference::inference::{
    Budget, Emulator, Evaluate, Method, Region, Uncertainties, chi_squared, explore, search,
};
use bagnold_inference::internals::{Smooth, descend};
use nalgebra::{DMatrix, DVector};
use std::convert::Infallible;

/// The curve from data that say less.
struct Vague {
    curve: ExponentialDecay,
    /// Standard uncertainty over that of the curve.
    vagueness: f64,
}

impl Evaluate for Vague {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|u| Some(Smooth::residuals(self, u).as_slice().to_vec())).collect())
    }
}

impl Smooth for Vague {
    fn residuals(&self, point: &[f64]) -> DVector<f64> {
        DVector::from_vec(self.curve.at(point)) / self.vagueness
    }
    fn jacobian(&self, point: &[f64]) -> DMatrix<f64> {
        self.curve.jacobian(point) / self.vagueness
    }
}

/// The end of the interval of the model itself.
fn exact(model: &Vague, k: usize, bound: f64) -> f64 {
    let rise = |value: f64| {
        let (mut lower, mut upper) = (vec![0.0; 3], vec![1.0; 3]);
        (lower[k], upper[k]) = (value, value);
        descend(model, &model.curve.truth, &lower, &upper).chi_squared
    };
    if rise(bound) <= 3.841_459 {
        return bound;
    }
    let (mut inside, mut outside) = (model.curve.truth[k], bound);
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if rise(middle) > 3.841_459 { outside = middle } else { inside = middle }
    }
    inside
}

#[test]
fn wide_intervals_are_those_of_the_model_itself() {
    for vagueness in [2.0, 4.0, 8.0] {
        let mut model = Vague { curve: ExponentialDecay::new(), vagueness };
        let budget = Budget::default();
        let found = search(&mut model, &[0.5; 3], Method::TrustRegion, budget).unwrap();
        let first = Emulator::fit(&found.history, budget.difference).unwrap();
        let before = Region::new(&first, Uncertainties::STATED);
        let searched = found.history.len();
        let explored = explore(&mut model, found.history, Uncertainties::STATED, &budget).unwrap().unwrap();
        println!(
            "vagueness {vagueness}: {searched} + {} points, settled {}, leave-one-out {:.3?}",
            explored.history.len() - searched,
            explored.is_settled(),
            explored.emulator.leave_one_out
        );
        for k in 0..3 {
            let ends = [exact(&model, k, 0.0), exact(&model, k, 1.0)];
            let profile = &explored.region.profiles[k];
            println!("  {:.3?} then {:.3?}, exactly {ends:.3?}", before.profiles[k].interval, profile.interval);
            for (found, exact) in profile.interval.iter().zip(ends) {
                assert!((found - exact).abs() < 0.15 * (ends[1] - ends[0]), "{found} is not {exact}");
            }
        }
    }
}

#[test]
fn every_end_is_a_run_of_the_model() {
    for vagueness in [1.0, 4.0] {
        let mut model = Vague { curve: ExponentialDecay::new(), vagueness };
        let budget = Budget::default();
        let found = search(&mut model, &[0.5; 3], Method::TrustRegion, budget).unwrap();
        let least = found.chi_squared;
        let explored = explore(&mut model, found.history, Uncertainties::STATED, &budget).unwrap().unwrap();
        assert!(explored.is_settled());
        for (k, end) in explored.ends.iter().flatten().enumerate() {
            let rise = chi_squared(Smooth::residuals(&model, &end.point).as_slice()) - least;
            assert!((rise - end.rise.unwrap()).abs() < 1e-9);
            let limit = explored.region.limit;
            assert!(end.open && rise <= limit || (rise / limit - 1.0).abs() <= 0.1, "end {k}: {rise} of {limit}");
        }
    }
}

#[test]
fn a_budget_that_ends_leaves_ends_unsettled() {
    for evaluations in 0..6 {
        let mut model = Vague { curve: ExponentialDecay::new(), vagueness: 8.0 };
        let found = search(&mut model, &[0.5; 3], Method::TrustRegion, Budget::default()).unwrap();
        let count = found.history.len();
        let budget = Budget { evaluations, ..Budget::default() };
        let explored = explore(&mut model, found.history, Uncertainties::STATED, &budget).unwrap().unwrap();
        assert!(!explored.is_settled() && explored.history.len() == count + evaluations);
        assert!(explored.ends.iter().flatten().any(|end| !end.settled));
    }
}

/// Two wells, of which the search has seen the shallow one only.
struct HiddenWell;

impl Evaluate for HiddenWell {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let one = |u: &Vec<f64>| vec![6.0 * (u[0] - 0.2) * (u[0] - 0.8) / 0.36, 2.0 * (1.0 - u[0])];
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

#[test]
fn a_lower_point_on_the_way_is_told() {
    let found = search(&mut HiddenWell, &[0.1], Method::TrustRegion, Budget::default()).unwrap();
    assert!(found.best[0] < 0.5);
    let explored = explore(&mut HiddenWell, found.history, Uncertainties::STATED, &Budget::default()).unwrap().unwrap();
    assert!(explored.lower && explored.region.minimum.chi_squared < found.chi_squared);
}

/// The curve, which cannot be computed beyond a value of its first parameter.
#[test]
fn an_interval_ends_where_the_model_fails() {
    struct Cut(Vague);
    impl Evaluate for Cut {
        type Error = Infallible;
        fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
            let results = Evaluate::residuals(&mut self.0, points)?;
            Ok(results.into_iter().zip(points).map(|(result, u)| result.filter(|_| u[0] < 0.62)).collect())
        }
    }
    let mut cut = Cut(Vague { curve: ExponentialDecay::new(), vagueness: 4.0 });
    let found = search(&mut cut, &[0.5; 3], Method::TrustRegion, Budget::default()).unwrap();
    let explored = explore(&mut cut, found.history, Uncertainties::STATED, &Budget::default()).unwrap().unwrap();
    let end = &explored.ends[0][1];
    assert!(end.fails && end.point[0] < 0.62 && end.point[0] > 0.6, "{end:?}");
}
