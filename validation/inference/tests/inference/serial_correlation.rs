//! Correlation of drawn errors, and coverage of widened intervals.

use bagnold_inference::inference::{SerialCorrelation, serial_correlation};
use bagnold_inference::internals::Fit;
use bagnold_inference::sampling::Random;
use nalgebra::DMatrix;

/// A parabola at forty places.
fn jacobian() -> DMatrix<f64> {
    DMatrix::from_fn(40, 3, |row, k| libm::pow(row as f64 / 39.0, k as f64) / 0.05)
}

/// Errors of an autoregressive process of unit variance.
fn errors(seed: u64, coefficient: f64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let fresh = (1.0 - coefficient * coefficient).sqrt();
    let mut last = random.normal();
    (0..40)
        .map(|k| {
            if k > 0 {
                last = coefficient * last + fresh * random.normal();
            }
            last
        })
        .collect()
}

fn found(seed: u64, coefficient: f64) -> Option<SerialCorrelation> {
    let (fit, series) = (Fit::of(&jacobian()), vec![(0..40).collect::<Vec<usize>>()]);
    serial_correlation(&series, &fit.residuals(&errors(seed, coefficient)), &jacobian())
}

#[test]
fn white_noise_is_seldom_taken_for_correlated() {
    let named = (0..400).filter(|seed| found(*seed, 0.0).is_some()).count();
    assert!(named <= 20, "{named} of 400");
}

/// Coverage is that of the three coefficients of the parabola, whose truth is 0, by a normal interval of 95 %.
#[test]
fn correlated_errors_are_named_and_their_widened_intervals_hold_the_truth() {
    let fit = Fit::of(&jacobian());
    for (coefficient, least_named) in [(0.5, 64), (0.8, 64)] {
        let (mut named, mut inside, mut stated, mut mean) = (0, 0, 0, 0.0);
        for seed in 1000..1080 {
            let errors = errors(seed, coefficient);
            let widened = found(seed, coefficient);
            named += usize::from(widened.is_some());
            mean += widened.map_or(0.0, |one| one.coefficient) / 80.0;
            let projected = fit.basis.tr_mul(&DMatrix::from_vec(40, 1, errors));
            let off = &fit.to_parameters * projected;
            for k in 0..3 {
                let deviation = fit.to_parameters.row(k).norm();
                let distance = off[(k, 0)].abs() / (1.96 * deviation);
                inside += usize::from(distance <= widened.map_or(1.0, |one| one.factor));
                stated += usize::from(distance <= 1.0);
            }
        }
        println!("ρ = {coefficient}: named {named} of 80, mean {mean:.2}, inside {inside} of 240, unwidened {stated}");
        assert!(named >= least_named && inside >= 204 && stated < inside, "{coefficient}: {named} {inside} {stated}");
    }
}

#[test]
fn a_law_of_another_shape_shows_as_correlation() {
    let line = DMatrix::from_fn(15, 2, |row, k| libm::pow(row as f64, k as f64));
    let mut random = Random::new(3);
    let bent: Vec<f64> = (0..15).map(|k| 0.2 * random.normal() + 0.16 * libm::pow(f64::from(k) - 7.0, 2.0)).collect();
    let left = Fit::of(&line).residuals(&bent);
    let found = serial_correlation(&[(0..15).collect()], &left, &line).expect("correlated");
    assert!(found.coefficient > 0.8 && found.factor > 2.0, "{found:?}");
}

#[test]
fn series_of_few_and_of_other_data_say_nothing() {
    assert_eq!(serial_correlation(&[vec![0, 1, 2]], &[1.0; 3], &DMatrix::zeros(3, 1)), None);
    assert_eq!(serial_correlation(&[], &[1.0; 40], &jacobian()), None);
}
