//! Lines and power laws of known slope, with errors by hand.

use bagnold_inference::statistics::{common_slope, linear_fit, log_log_slope, power_law};

#[test]
fn a_line_is_found_exactly() {
    let fit = linear_fit(&[(0.0, 1.0), (1.0, 3.0), (4.0, 9.0)]).unwrap();
    assert!((fit.slope - 2.0).abs() < 1e-14 && (fit.intercept - 1.0).abs() < 1e-14);
    assert_eq!(linear_fit(&[(1.0, 1.0), (1.0, 2.0)]), None);
    assert_eq!(linear_fit(&[]), None);
}

#[test]
fn a_regression_knows_what_its_line_explains() {
    // mean 1, slope 1/2: residuals (−1/6, 1/3, −1/6), so 1 − (1/6)/(2/3) of the variance is explained
    let fit = linear_fit(&[(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]).unwrap();
    assert!((fit.slope - 0.5).abs() < 1e-14 && (fit.r_squared - 0.75).abs() < 1e-14);
    assert_eq!(linear_fit(&[(1.0, 1.0)]), None);
}

#[test]
fn groups_share_a_slope_whatever_their_intercepts() {
    let group = |intercept: f64, wobble: f64| {
        (0..4)
            .map(|k| (f64::from(k), intercept + 2.0 * f64::from(k) + wobble * [1.0, -1.0, -1.0, 1.0][k as usize]))
            .collect()
    };
    let exact = common_slope(&[group(0.0, 0.0), group(7.0, 0.0)]).unwrap();
    assert!((exact.value - 2.0).abs() < 1e-14 && exact.standard_error < 1e-7);
    // a wobble without a slope: residual 8 w² on 8 − 3 degrees of freedom, Σ(x − x̄)² = 10
    let wobbling = common_slope(&[group(0.0, 0.1), group(7.0, 0.1)]).unwrap();
    assert!((wobbling.value - 2.0).abs() < 1e-13);
    assert!((wobbling.standard_error - (0.08f64 / 5.0 / 10.0).sqrt()).abs() < 1e-12);
    // one group of three points is an ordinary regression: error √(1/12), as for an exponent below
    let one = common_slope(&[vec![(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]]).unwrap();
    assert!((one.standard_error - (1.0f64 / 12.0).sqrt()).abs() < 1e-14);
    assert_eq!(common_slope(&[]), None);
    assert_eq!(common_slope(&[vec![(0.0, 0.0), (1.0, 1.0)]]), None);
}

#[test]
fn the_error_of_an_exponent_is_that_of_the_regression() {
    // ln y = 0, 1, 1 at ln x = 0, 1, 2: slope 1/2, residuals (−1, 2, −1)/6, error √((6/36)/1/2)
    let e = std::f64::consts::E;
    let fit = power_law(&[(1.0, 1.0), (e, e), (e * e, e)]).unwrap();
    assert!((fit.value - 0.5).abs() < 1e-14 && (fit.standard_error - (1.0f64 / 12.0).sqrt()).abs() < 1e-14);
    assert!((fit.coefficient - libm::exp(1.0 / 6.0)).abs() < 1e-14);
    assert_eq!(power_law(&[(1.0, 1.0)]), None);
}

#[test]
fn a_power_law_has_its_exponent() {
    let points = [(1.0, 2.0), (2.0, 0.5), (4.0, 0.125)];
    assert!((log_log_slope(&points).unwrap() + 2.0).abs() < 1e-14);
    assert_eq!(log_log_slope(&[(1.0, 0.0), (2.0, 1.0)]), None);
}
