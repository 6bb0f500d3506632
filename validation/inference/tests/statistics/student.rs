//! Student's quantiles against tables.

use bagnold_inference::statistics::student_quantile;

#[test]
fn quantiles_are_those_of_the_tables() {
    for (freedom, expected) in [(1, 12.7062), (2, 4.3027), (3, 3.1824), (10, 2.2281)] {
        assert!((student_quantile(0.95, freedom) - expected).abs() < 1e-4, "{freedom}");
    }
    assert!(student_quantile(0.95, 0).is_nan());
}
