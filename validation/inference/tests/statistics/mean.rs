//! Means and relative errors by hand.

use bagnold_inference::statistics::{mean, relative_l2};

#[test]
fn errors_are_relative_to_what_is_exact() {
    assert_eq!(mean(&[1.0, 2.0, 6.0]), 3.0);
    assert!(mean(&[]).is_nan());
    // errors 3 and 4 of 6 and 8
    assert_eq!(relative_l2([(9.0, 6.0), (4.0, 8.0)]), 0.5);
}
