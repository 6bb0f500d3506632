//! Percentiles of a short list.

use bagnold_inference::statistics::percentile;

#[test]
fn percentiles_lie_between_neighbours() {
    let list = [1.0, 2.0, 4.0];
    assert_eq!([0.0, 0.25, 0.75, 1.0].map(|share| percentile(&list, share)), [1.0, 1.5, 3.0, 4.0]);
    assert!(percentile(&[], 0.5).is_nan());
}
