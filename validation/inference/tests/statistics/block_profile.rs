//! Means and errors of bins.

use bagnold_inference::statistics::BlockProfile;
use nalgebra::Vector2;

/// Two particles in the lower bin and one in the middle; the velocity of the first grows from block to block.
fn profile() -> BlockProfile {
    let mut profile = BlockProfile::new(1.0, 0.5, 3);
    let at = |z: f64| Vector2::new(0.0, z);
    let along = |u: f64| Vector2::new(u, 0.0);
    for sample in 0..320 {
        let share = (f64::from(sample) + 0.5) / 320.0;
        // 0 … 31 in an order without correlation
        let block = f64::from((sample / 10 * 11 + 5) % 32);
        profile.observe(
            share,
            &[at(1.1), at(1.3), at(1.75), at(0.9), at(2.5)],
            &[along(block), along(2.0), along(5.0), along(9.0), along(9.0)],
            &[30.0, 10.0, 0.0, 9.0, 9.0],
        );
    }
    profile
}

#[test]
fn bins_have_the_means_of_what_lies_in_them() {
    let profile = profile();
    let points = profile.points();
    assert_eq!(points.len(), 2, "the third bin is empty, and two particles lie outside");
    assert_eq!(profile.times, 320);
    assert_eq!(points[0].samples, 640.0);
    assert!((points[0].height - 1.2).abs() < 1e-12 && (points[0].pressure - 20.0).abs() < 1e-12);
    // mean of 0 … 31 is 15.5
    assert!((points[0].velocity - 0.5 * (15.5 + 2.0)).abs() < 1e-12);
    assert!((points[1].velocity - 5.0).abs() < 1e-12);
}

#[test]
fn errors_are_those_of_the_scatter_of_blocks() {
    // velocities 0 … 31, of which the bin has half: variance 88/4, over 32 blocks
    let exact = (22.0f64 / 32.0).sqrt();
    let profile = profile();
    let velocities = profile.velocities();
    assert!((velocities[0].standard_error - exact).abs() < 1e-12, "{:?}", velocities[0]);
    assert!(velocities[1].standard_error < 1e-12);
    let difference = profile.estimate(|points| points[1].velocity - points[0].velocity);
    assert!((difference.value + 3.75).abs() < 1e-12 && (difference.standard_error - exact).abs() < 1e-12);
}
