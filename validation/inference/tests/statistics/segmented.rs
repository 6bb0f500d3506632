//! Pieces and curvature of known curves.

use bagnold_inference::statistics::{curvature, number_of_pieces, segmented_regression};

fn line_with_kinks(x: f64) -> f64 {
    1.0 + 0.5 * x + 1.5 * (x - 1.1).max(0.0) - 1.0 * (x - 2.3).max(0.0)
}

#[test]
fn kinks_are_found_where_they_are() {
    let points: Vec<(f64, f64)> = (0..40).map(|k| 0.1 * f64::from(k)).map(|x| (x, line_with_kinks(x))).collect();
    let fit = segmented_regression(&points, 3).unwrap();
    for (found, exact) in fit.breaks.iter().zip([1.1, 2.3]).chain(fit.slopes.iter().zip([0.5, 2.0, 1.0])) {
        assert!((found - exact).abs() < 0.06, "{fit:?}");
    }
    assert_eq!(number_of_pieces(&points, 4), 3);
}

/// The fractional parts of multiples of the golden section are evenly spread.
fn noise(k: i32) -> f64 {
    (f64::from(k) * 0.618_033_988_75).fract() - 0.5
}

#[test]
fn noise_makes_no_pieces() {
    let points: Vec<(f64, f64)> = (0..30).map(|k| (f64::from(k), 2.0 * f64::from(k) + noise(k))).collect();
    assert_eq!(number_of_pieces(&points, 3), 1);
}

#[test]
fn a_parabola_has_its_curvature() {
    let points: Vec<(f64, f64)> = (0..6).map(f64::from).map(|x| (x, 3.0 - x - 0.7 * x * x)).collect();
    assert!((curvature(&points).unwrap() + 1.4).abs() < 1e-12);
    assert!(curvature(&points[..3]).is_none());
}

#[test]
fn too_few_points_have_no_fit() {
    assert!(segmented_regression(&[(0.0, 1.0), (1.0, 2.0), (2.0, 3.0)], 2).is_none());
}
