//! Posterior samples of linear models.

use crate::stand_in::emulator;
use bagnold_inference::inference::posterior::{predictive, sample};
use bagnold_inference::inference::{Region, Uncertainties};

#[test]
fn a_linear_model_has_a_normal_posterior() {
    let emulator = emulator(|u| vec![20.0 * (u[0] - 0.5), 10.0 * (u[0] + u[1] - 1.0)]);
    let region = Region::new(&emulator, Uncertainties::STATED);
    let posterior = sample(&region, 1);
    for (interval, variance) in posterior.intervals.iter().zip([0.0025, 0.0125_f64]) {
        let half = 1.96 * variance.sqrt();
        assert!((interval[0] - 0.5 + half).abs() < 0.1 * half, "{interval:?} {half}");
        assert!((interval[1] - 0.5 - half).abs() < 0.1 * half, "{interval:?} {half}");
    }
    assert!((0.5..0.9).contains(&posterior.acceptance) && posterior.correlation_moves < 60.0, "{posterior:?}");
    let band = predictive(&emulator, &posterior)[0];
    assert!((band[0] + 1.96).abs() < 0.3 && (band[1] - 1.96).abs() < 0.3, "{band:?}");
    assert_eq!(posterior, sample(&region, 1));
}

#[test]
fn samples_stay_within_the_bounds() {
    let emulator = emulator(|u| vec![2.0 * (u[0] - 0.9), 20.0 * (u[1] - 0.4)]);
    let posterior = sample(&Region::new(&emulator, Uncertainties::STATED), 3);
    assert!(posterior.samples.iter().flatten().all(|u| (0.0..=1.0).contains(u)));
    assert!(posterior.intervals[0][0] < 0.1 && posterior.intervals[0][1] > 0.9);
}
