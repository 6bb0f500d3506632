//! Requirements on all methods.

mod design;
mod differences;
mod recorder;
mod starts;
mod trust_region;

use crate::stand_in::{ExponentialDecay, Failing, RosenbrockModel};
use bagnold_inference::inference::{Budget, Method, SearchError, SearchResult, search};

const METHODS: [Method; 2] = [Method::TrustRegion, Method::Design];

fn budget(evaluations: usize) -> Budget {
    Budget { evaluations, ..Budget::default() }
}

fn sound(found: &SearchResult, evaluations: usize) {
    assert!(found.history.len() <= evaluations, "{} > {evaluations}", found.history.len());
    for evaluated in &found.history {
        assert!(evaluated.point.iter().all(|u| (0.0..=1.0).contains(u)), "{:?}", evaluated.point);
    }
    let least = found.history.iter().filter_map(|e| e.chi_squared).fold(f64::INFINITY, f64::min);
    assert_eq!(found.chi_squared, least);
    for (k, one) in found.history.iter().enumerate() {
        assert!(found.history[..k].iter().all(|other| other.point != one.point));
    }
}

#[test]
fn every_method_descends_the_valley_of_rosenbrock() {
    for (method, evaluations) in [(Method::TrustRegion, 40), (Method::Design, 60)] {
        let budget = Budget { tolerance: 1e-4, ..budget(evaluations) };
        let found = search(&mut RosenbrockModel, &[0.2, 0.8], method, budget).unwrap();
        sound(&found, evaluations);
        let distance = (found.best[0] - 0.6).abs().max((found.best[1] - 0.36).abs());
        println!("{method:?}: {} evaluations, off by {distance:.1e}, {}", found.history.len(), found.stopped);
        assert!(distance < 0.02, "{method:?}: {:?} {}", found.best, found.chi_squared);
    }
}

#[test]
fn every_method_fits_a_curve_of_three_parameters() {
    let model = ExponentialDecay::new();
    for (method, evaluations, accuracy) in [(Method::TrustRegion, 25, 0.005), (Method::Design, 80, 0.05)] {
        for start in [[0.35, 0.75, 0.3], [0.8, 0.2, 0.2], [0.5, 0.5, 0.5]] {
            let found = search(&mut model.clone(), &start, method, budget(evaluations)).unwrap();
            sound(&found, evaluations);
            let distance = (0..3).map(|k| (found.best[k] - model.truth[k]).abs()).fold(0.0, f64::max);
            println!("{method:?}: {} evaluations, off by {distance:.1e}, {}", found.history.len(), found.stopped);
            assert!(distance < accuracy, "{method:?}: {:?} {}", found.best, found.chi_squared);
        }
    }
}

#[test]
fn no_budget_is_exceeded_however_small() {
    for method in METHODS {
        for evaluations in 1..20 {
            let found = search(&mut ExponentialDecay::new(), &[0.9, 0.1, 0.5], method, budget(evaluations)).unwrap();
            sound(&found, evaluations);
        }
    }
}

#[test]
fn regions_where_the_model_fails_are_survived() {
    for method in METHODS {
        // the minimum lies at the edge of the failing half, and the second start within it
        for start in [[0.3, 0.5, 0.5], [0.95, 0.5, 0.5]] {
            let mut model = Failing { curve: ExponentialDecay::new(), beyond: 0.62 };
            let found = search(&mut model, &start, method, budget(250)).unwrap();
            sound(&found, 250);
            let distance = (0..3).map(|k| (found.best[k] - model.curve.truth[k]).abs()).fold(0.0, f64::max);
            println!("{method:?}: {} evaluations, off by {distance:.1e}, {}", found.history.len(), found.stopped);
            assert!(distance < 0.1, "{method:?}: {:?} {}", found.best, found.chi_squared);
        }
    }
}

#[test]
fn a_model_that_always_fails_is_reported() {
    for method in METHODS {
        let mut model = Failing { curve: ExponentialDecay::new(), beyond: -1.0 };
        let error = search(&mut model, &[0.5; 3], method, budget(9)).unwrap_err();
        assert!(matches!(error, SearchError::NothingWorked(1..=9)), "{method:?}: {error}");
    }
}

#[test]
fn a_search_is_repeated_exactly() {
    for method in METHODS {
        let run = || search(&mut ExponentialDecay::new(), &[0.3, 0.4, 0.9], method, budget(40)).unwrap();
        assert_eq!(run(), run());
    }
}

#[test]
fn settings_out_of_range_are_refused() {
    let run = |start: &[f64], budget| {
        search(&mut RosenbrockModel, start, Method::TrustRegion, budget).unwrap_err().to_string()
    };
    assert!(run(&[1.2, 0.0], budget(9)).starts_with("`start` is [1.2, 0.0], but must be"));
    assert!(run(&[0.5, 0.5], budget(0)).starts_with("`evaluations` is 0, but must be"));
    assert!(run(&[0.5; 2], Budget { difference: 0.0, ..budget(9) }).starts_with("`difference` is 0, but must be"));
}
