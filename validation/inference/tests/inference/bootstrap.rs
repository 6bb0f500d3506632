//! Intervals from data drawn anew about the fitted model (parametric bootstrap), on the emulator: another way to the intervals by profile.

use crate::stand_in::emulator;
use bagnold_inference::inference::Emulator;
use bagnold_inference::internals::{Smooth, descend, middles};
use bagnold_inference::sampling::Random;
use nalgebra::{DMatrix, DVector};

/// The parameters of repeated experiments.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bootstrap {
    /// The parameters that fit each set of data, in the unit cube.
    pub(super) samples: Vec<Vec<f64>>,
    /// Interval of every parameter that contains 95 % of them, as many left out below as above.
    pub(super) intervals: Vec<[f64; 2]>,
}

/// The emulator with data that the fitted model gives, plus noise.
struct Redrawn<'a> {
    emulator: &'a Emulator,
    /// To be added to the residuals.
    shift: DVector<f64>,
}

impl Smooth for Redrawn<'_> {
    fn residuals(&self, point: &[f64]) -> DVector<f64> {
        DVector::from_vec(self.emulator.predict(point)) + &self.shift
    }

    fn jacobian(&self, point: &[f64]) -> DMatrix<f64> {
        self.emulator.jacobian(point)
    }
}

/// Fits the emulator to `repeats` sets of data that the model gives at the minimum, with noise of the stated standard
/// uncertainties. Unlike the data themselves, these have no part that the model cannot explain.
pub(super) fn bootstrap(emulator: &Emulator, repeats: usize, seed: u64) -> Bootstrap {
    let minimum = emulator.minimum().point;
    let fitted = DVector::from_vec(emulator.predict(&minimum));
    let (lower, upper) = (vec![0.0; minimum.len()], vec![1.0; minimum.len()]);
    let mut random = Random::new(seed);
    let samples: Vec<Vec<f64>> = (0..repeats)
        .map(|_| {
            let noise = DVector::from_fn(fitted.len(), |_, _| random.normal());
            descend(&Redrawn { emulator, shift: noise - &fitted }, &minimum, &lower, &upper).point
        })
        .collect();
    Bootstrap { intervals: middles(&samples, minimum.len()), samples }
}

#[test]
fn a_linear_model_gives_normal_intervals() {
    let emulator = emulator(|u| vec![20.0 * (u[0] - 0.5), 10.0 * (u[0] + u[1] - 1.0), 2.0]);
    let repeated = bootstrap(&emulator, 4000, 1);
    for (interval, variance) in repeated.intervals.iter().zip([0.0025, 0.0125f64]) {
        let half = 1.96 * variance.sqrt();
        assert!((interval[0] - 0.5 + half).abs() < 0.05 * half, "{interval:?}");
        assert!((interval[1] - 0.5 - half).abs() < 0.05 * half, "{interval:?}");
    }
    assert_eq!(repeated.samples[..10], bootstrap(&emulator, 10, 1).samples);
}

#[test]
fn samples_stay_in_the_cube() {
    let repeated = bootstrap(&emulator(|u| vec![u[0] - 0.95, 9.0 * (u[1] - 0.5)]), 200, 1);
    assert!(repeated.samples.iter().flatten().all(|u| (0.0..=1.0).contains(u)));
    assert_eq!(repeated.intervals[0], [0.0, 1.0]);
}
