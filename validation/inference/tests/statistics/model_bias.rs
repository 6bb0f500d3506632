//! Bias and scatter of drawn comparisons.

use bagnold_inference::statistics::{Comparison, model_bias};
use rand::{RngExt, SeedableRng};

fn compared(ratios: &[f64], uncertainty: Option<f64>) -> Vec<Comparison> {
    let scales = [1.0, 10.0, 0.2, 3.0];
    let one =
        |(ratio, measured): (&f64, &f64)| Comparison { predicted: ratio * measured, measured: *measured, uncertainty };
    ratios.iter().zip(scales.iter().cycle()).map(one).collect()
}

#[test]
fn the_worked_example() {
    // ln(M/E) = −0.1, 0, 0.1: m = 0, u² = 0.02/2 = 0.01. With σ_E = 0.06: σ_M² = 0.01 − 0.0036 = 0.0064, σ_M = 0.08,
    // ln δ = 0.0032 − 0.0018 = 0.0014, to ± 4.30265 · 0.1/√3 = 0.248414
    let ratios = [-0.1, 0.0, 0.1].map(libm::exp);
    let known = model_bias(&compared(&ratios, Some(0.06))).expect("three");
    assert!((known.scatter - 0.1).abs() < 1e-12);
    assert!(known.model_deviation().is_some_and(|model| (model - 0.08).abs() < 1e-12), "{known:?}");
    assert!((known.bias - 1.001_400_98).abs() < 1e-8, "{known:?}");
    assert!((libm::log(known.interval.1) - 0.0014 - 0.248_414).abs() < 1e-5);
    // 4.30265 · 0.1 · √(4/3)
    assert!((libm::log(known.next_ratio_beside(0.0).1) - 0.496_827).abs() < 1e-5);
    assert!((known.next_ratio_beside(0.0).0 * known.next_ratio_beside(0.0).1 - 1.0).abs() < 1e-12);
    // what stands beside adds as squares: a whole deviation of a further comparison makes the reach √2 times as long
    let whole = known.scatter * (1.0 + 1.0 / known.comparisons as f64).sqrt();
    let reach = |(lower, upper): (f64, f64)| libm::log(upper / lower);
    assert!(
        (reach(known.next_ratio_beside(whole)) / reach(known.next_ratio_beside(0.0)) - 2.0_f64.sqrt()).abs() < 1e-12
    );
}

#[test]
fn no_uncertainty_is_invented() {
    let ratios = [-0.1, 0.0, 0.1].map(|value| libm::exp(value + 0.3));
    let mut some = compared(&ratios, Some(0.06));
    some[1].uncertainty = None;
    for comparisons in [some, compared(&ratios, None)] {
        let found = model_bias(&comparisons).expect("three");
        assert_eq!((found.experimental_deviation, found.model_deviation()), (None, None));
        assert!((found.bias - libm::exp(0.3)).abs() < 1e-12, "the geometric mean");
    }
    let modest = model_bias(&compared(&ratios, Some(0.2))).expect("three");
    assert_eq!(modest.experimental_deviation, Some(0.2));
    assert_eq!(modest.model_deviation(), None);
}

#[test]
fn undefined_ratio_is_refused() {
    assert_eq!(model_bias(&compared(&[1.0, 1.1], None)), None);
    assert_eq!(model_bias(&compared(&[1.0, 1.1, 0.0], None)), None);
    assert_eq!(model_bias(&compared(&[1.0, 1.1, -0.5], None)), None);
    assert_eq!(model_bias(&compared(&[1.0, 1.1, f64::NAN], None)), None);
    assert!(model_bias(&compared(&[1.0; 3], None)).is_some_and(|found| found.scatter == 0.0 && found.bias == 1.0));
}

fn normal(random: &mut rand_pcg::Pcg64) -> f64 {
    let (radius, angle): (f64, f64) = (1.0 - random.random::<f64>(), random.random());
    (-2.0 * libm::log(radius)).sqrt() * libm::cos(2.0 * std::f64::consts::PI * angle)
}

/// Shares of 2000 sets whose interval holds δ, and whose bounds hold a further comparison; mean σ_M of them.
fn coverage(number: usize, bias: f64, model: f64, experiment: f64) -> (f64, f64, f64) {
    let mut random = rand_pcg::Pcg64::seed_from_u64(5);
    let (mut of_bias, mut of_next, mut deviation, mut told) = (0.0, 0.0, 0.0, 0.0_f64);
    for _ in 0..2000 {
        let mut all: Vec<Comparison> = (0..=number)
            .map(|_| Comparison {
                predicted: bias * (1.0 + model * normal(&mut random)),
                measured: 1.0 + experiment * normal(&mut random),
                uncertainty: Some(experiment),
            })
            .collect();
        let next = all.pop().expect("one more");
        let found = model_bias(&all).expect("ratios");
        of_bias += f64::from(u8::from((found.interval.0..=found.interval.1).contains(&bias)));
        let (lower, upper) = found.next_ratio_beside(0.0);
        of_next += f64::from(u8::from((lower..=upper).contains(&(next.predicted / next.measured))));
        if let Some(own) = found.model_deviation() {
            deviation += own;
            told += 1.0;
        }
    }
    (of_bias / 2000.0, of_next / 2000.0, deviation / told)
}

#[test]
fn intervals_hold_the_true_bias_and_the_next_comparison() {
    for number in [3, 5, 10, 30] {
        for (bias, model, experiment) in [(1.0, 0.1, 0.05), (0.8, 0.2, 0.1), (1.3, 0.05, 0.05), (1.1, 0.15, 0.02)] {
            let (of_bias, of_next, _) = coverage(number, bias, model, experiment);
            assert!(of_bias >= 0.9 && of_next >= 0.9, "{number} of δ = {bias}, σ_M = {model}: {of_bias}, {of_next}");
        }
    }
}

#[test]
fn many_comparisons_find_the_models_deviation() {
    let (_, _, found) = coverage(100, 1.2, 0.15, 0.05);
    assert!((found - 0.15).abs() < 0.005, "{found}");
}
