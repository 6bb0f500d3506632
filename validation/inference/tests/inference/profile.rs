//! Profiles of linear models against their covariance.

use crate::stand_in::emulator;
use bagnold_inference::inference::{Region, Uncertainties};

/// For a linear model the profile is a parabola, (u − û)²/variance, whatever the other parameter does.
#[test]
fn the_interval_of_a_linear_model_is_that_of_its_covariance() {
    let emulator = emulator(|u| vec![20.0 * (u[0] - 0.5), 10.0 * (u[0] + u[1] - 1.0)]);
    let region = Region::new(&emulator, Uncertainties::STATED);
    for (profile, variance) in region.profiles.iter().zip([1.0 / 400.0, 1.0 / 400.0 + 1.0 / 100.0f64]) {
        let half = 1.959_964 * variance.sqrt();
        assert!((profile.interval[0] - 0.5 + half).abs() < 1e-6, "{:?}", profile.interval);
        assert!((profile.interval[1] - 0.5 - half).abs() < 1e-6 && profile.is_closed());
    }
    for at in &region.profiles[1].curve {
        let exact = (at.point[1] - 0.5) * (at.point[1] - 0.5) / 0.0125;
        assert!((at.rise - exact).abs() < 1e-6 * (1.0 + exact));
    }
    assert!(region.profiles[1].curve.is_sorted_by(|a, b| a.point[1] < b.point[1]));
}

#[test]
fn an_interval_that_reaches_a_bound_is_open() {
    let emulator = emulator(|u| vec![2.0 * (u[0] - 0.9), 0.1 * (u[1] - 0.4)]);
    let region = Region::new(&emulator, Uncertainties::STATED);
    let [first, second] = &region.profiles[..] else { panic!("two parameters") };
    assert!(first.open_above && !first.is_closed() && first.interval[1] == 1.0);
    assert!(first.open_below == (0.9 < 0.98) && second.interval == [0.0, 1.0]);
    assert!(second.open_below && second.open_above);
}

#[test]
fn a_minimum_on_a_face_has_a_one_sided_interval() {
    let emulator = emulator(|u| vec![20.0 * (u[0] - 1.05), 20.0 * (u[1] - 0.4)]);
    let region = Region::new(&emulator, Uncertainties::STATED);
    let profile = &region.profiles[0];
    assert!(profile.open_above && !profile.open_below && profile.interval[1] == 1.0);
    // (20 (u − 1.05))² = 1 + 3.8415
    assert!((profile.interval[0] - (1.05 - 4.841_459f64.sqrt() / 20.0)).abs() < 1e-6, "{:?}", profile.interval);
}
