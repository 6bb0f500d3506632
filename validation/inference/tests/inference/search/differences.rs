//! Differences beside bounds and failures.

use crate::stand_in::{ExponentialDecay, Failing};
use bagnold_inference::internals::{Iterate, Recorder, differences};

#[test]
fn differences_stay_inside_the_cube_and_out_of_failures() {
    let mut model = Failing { curve: ExponentialDecay::new(), beyond: 0.5 };
    let mut recorder = Recorder::new(&mut model, 99);
    let point = vec![0.49, 1.0, 0.0];
    let residuals = recorder.residuals_at(&point).unwrap().unwrap();
    let jacobian = differences(&mut recorder, &Iterate::new(point, residuals), 0.02).unwrap();
    let asked: Vec<Vec<f64>> = recorder.history().iter().map(|evaluated| evaluated.point.clone()).collect();
    assert_eq!(asked[2], [0.49, 0.98, 0.0]);
    assert_eq!(asked[3], [0.49, 1.0, 0.02]);
    assert_eq!(asked[4], [0.47, 1.0, 0.0]);
    let exact = ExponentialDecay::new().jacobian(&[0.49, 1.0, 0.0]);
    for k in 0..3 {
        assert!((jacobian.column(k) - exact.column(k)).norm() < 0.05 * exact.column(k).norm(), "{k}");
    }
}
