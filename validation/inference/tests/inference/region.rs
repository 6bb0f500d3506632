//! Regions, quantiles and covariance of linear models.

use crate::stand_in::emulator;
use bagnold_inference::inference::{Region, Uncertainties, chi_squared_quantile, chi_squared_tail};
use nalgebra::DMatrix;

#[test]
fn quantiles_are_those_of_the_tables() {
    for (freedom, expected) in [(1, 3.841_459), (2, 5.991_465), (3, 7.814_728), (10, 18.307_038)] {
        assert!((chi_squared_quantile(0.95, freedom) - expected).abs() < 1e-5, "{freedom}");
        assert!((chi_squared_tail(expected, freedom) - 0.05).abs() < 1e-7);
    }
    assert!(chi_squared_quantile(0.95, 0).is_nan());
}

#[test]
fn the_covariance_inverts_the_information() {
    let emulator = emulator(|u| vec![20.0 * (u[0] - 0.5), 10.0 * (u[0] + u[1] - 1.0)]);
    let region = Region::new(&emulator, Uncertainties::STATED);
    let exact = DMatrix::from_row_slice(2, 2, &[0.0025, -0.0025, -0.0025, 0.0125]);
    assert!((&region.covariance - exact).norm() < 1e-9);
    assert!((region.correlation[(0, 1)] + 0.2f64.sqrt()).abs() < 1e-7);
    assert_eq!((region.reduced_chi_squared, region.p_value, region.inflation), (None, None, 1.0));
    // the edge of the ellipse along the first axis: (400 + 100) s² = 5.9915
    let edge = (5.991_465f64 / 500.0).sqrt();
    assert!(region.contains(&[0.5 + 0.999 * edge, 0.5]) && !region.contains(&[0.5 + 1.001 * edge, 0.5]));
}

#[test]
fn a_model_that_misses_the_data_is_noticed_and_its_region_enlarged() {
    // two constants of 3 standard uncertainties: χ² = 18 on 4 − 2 degrees of freedom
    let emulator = emulator(|u| vec![50.0 * (u[0] - 0.5), 50.0 * (u[1] - 0.5), 3.0, -3.0]);
    let stated = Region::new(&emulator, Uncertainties::STATED);
    let inflated = Region::new(&emulator, Uncertainties { is_inflated: true, ..Uncertainties::STATED });
    assert!((stated.reduced_chi_squared.unwrap() - 9.0).abs() < 1e-9);
    assert!((stated.p_value.unwrap() - libm::exp(-9.0)).abs() < 1e-9);
    assert!((inflated.inflation - 3.0).abs() < 1e-9);
    for k in 0..2 {
        assert!((inflated.profiles[k].width() / stated.profiles[k].width() - 3.0).abs() < 1e-5);
    }
    assert!(!stated.contains(&[0.6, 0.5]) && inflated.contains(&[0.6, 0.5]));
}
