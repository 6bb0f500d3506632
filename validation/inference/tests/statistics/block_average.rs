//! Intervals of means over correlated samples against processes of known correlation.

use bagnold_inference::statistics::{TooFewSamples, block_average, block_jackknife, linear_fit};
use rand::{RngExt, SeedableRng};
use std::ops::Range;

/// A normal number.
fn normal(random: &mut rand_pcg::Pcg64) -> f64 {
    let (radius, angle): (f64, f64) = (1.0 - random.random::<f64>(), random.random());
    (-2.0 * libm::log(radius)).sqrt() * libm::cos(2.0 * std::f64::consts::PI * angle)
}

const SAMPLES: usize = 1024;

/// An Ornstein–Uhlenbeck process of variance 1 over a window of some integral times.
fn process(integral_times: f64, random: &mut rand_pcg::Pcg64) -> Vec<f64> {
    let correlation = libm::exp(-integral_times / SAMPLES as f64);
    let kick = (1.0 - correlation * correlation).sqrt();
    let mut value = normal(random);
    let mut next = || {
        value = correlation * value + kick * normal(random);
        value
    };
    (0..SAMPLES).map(|_| next()).collect()
}

/// Standard error of the mean of that process over T = N τ: √(2 (N − 1 + e^(−N)))/N.
fn exact_error(integral_times: f64) -> f64 {
    (2.0 * (integral_times - 1.0 + libm::exp(-integral_times))).sqrt() / integral_times
}

/// Share of 1000 windows whose 95 % interval holds the true mean, and their typical standard error over the exact one.
fn coverage(integral_times: f64) -> (f64, f64) {
    let mut random = rand_pcg::Pcg64::seed_from_u64(17);
    let (mut held, mut square) = (0.0, 0.0);
    for _ in 0..1000 {
        let average = block_average(&process(integral_times, &mut random)).expect("samples enough");
        held += f64::from(u8::from(average.value.abs() <= average.half_width));
        square += average.standard_error.powi(2);
    }
    (held / 1000.0, (square / 1000.0).sqrt() / exact_error(integral_times))
}

#[test]
fn intervals_hold_the_mean_however_few_integral_times_a_window_has() {
    for integral_times in [1.0, 2.0, 4.0, 8.0, 16.0, 40.0, 100.0, 1000.0] {
        let (share, ratio) = coverage(integral_times);
        assert!(share >= 0.9, "{integral_times} integral times: {share} of 0.95, error {ratio} of the true one");
    }
}

#[test]
fn the_standard_error_is_that_of_theory_where_the_window_is_long_and_never_far_below_it() {
    for (integral_times, least, most) in
        [(1000.0, 0.95, 1.2), (100.0, 0.95, 1.2), (40.0, 0.95, 1.4), (8.0, 1.0, 1.7), (2.0, 0.75, 1.2)]
    {
        let (_, ratio) = coverage(integral_times);
        assert!((least..most).contains(&ratio), "{integral_times} integral times: {ratio}");
    }
}

#[test]
fn integral_times_are_counted() {
    let mut random = rand_pcg::Pcg64::seed_from_u64(3);
    let mut counted: Vec<f64> =
        (0..201).map(|_| block_average(&process(40.0, &mut random)).expect("samples").integral_times).collect();
    counted.sort_by(f64::total_cmp);
    assert!((18.0..45.0).contains(&counted[100]), "{}: rather too few than too many", counted[100]);
}

#[test]
fn a_mean_of_independent_blocks_has_their_scatter() {
    // 8 blocks: mean 3.5, Σ(x − 3.5)² = 42, error √(42/(8 · 7)); r < 0 counts as none, so that ν = 7 and t = 2.365
    let values = [3.0, 4.0, 0.0, 7.0, 2.0, 5.0, 1.0, 6.0];
    let mean = |left_out: Range<usize>| {
        let kept: Vec<f64> = (0..8).filter(|k| !left_out.contains(k)).map(|k| values[k]).collect();
        kept.iter().sum::<f64>() / kept.len() as f64
    };
    let average = block_jackknife(8, mean);
    assert!((average.value - 3.5).abs() < 1e-14 && (average.integral_times - 16.0).abs() < 1e-12);
    assert!((average.standard_error - 0.75f64.sqrt()).abs() < 1e-13);
    assert!((average.half_width / average.standard_error - 2.3646).abs() < 1e-4);
}

#[test]
fn blocks_that_swing_against_each_other_give_the_error_of_the_shortest() {
    // ±1 in turn: 32 blocks scatter by 1 with an error √(1/31)
    let series: Vec<f64> = (0..320).map(|k| if (k / 10) % 2 == 0 { 1.0 } else { -1.0 }).collect();
    let average = block_average(&series).unwrap();
    assert!(average.value.abs() < 1e-15);
    assert!((average.standard_error - (1.0f64 / 31.0).sqrt()).abs() < 1e-13);
}

#[test]
fn a_window_that_only_drifts_counts_as_one_sample() {
    // blocks 0 … 31: variance 88, and one degree of freedom
    let series: Vec<f64> = (0..32).map(f64::from).collect();
    let average = block_average(&series).unwrap();
    assert!((average.standard_error - 88.0f64.sqrt()).abs() < 1e-12, "{average:?}");
    assert!((average.half_width / average.standard_error - 12.7062).abs() < 1e-4);
    assert!(average.integral_times < 1.0);
}

#[test]
fn a_constant_has_no_error_and_a_short_series_no_answer() {
    let average = block_average(&[2.5; 100]).unwrap();
    assert!((average.value - 2.5).abs() < 1e-15 && average.half_width < 1e-12);
    assert_eq!(block_average(&[1.0; 31]), Err(TooFewSamples { samples: 31 }));
}

#[test]
fn the_slope_of_a_line_has_the_error_of_its_blocks() {
    // y = b x with b of every block known: the slope over all is their mean, and its error their scatter
    let slopes: Vec<f64> = [3.0, 4.0, 0.0, 7.0, 2.0, 5.0, 1.0, 6.0].iter().map(|k| 2.0 + 0.1 * k).collect();
    let slope = |left_out: Range<usize>| {
        let points: Vec<(f64, f64)> = (0..8)
            .filter(|k| !left_out.contains(k))
            .flat_map(|k| (0..3).map(move |x| (k, f64::from(x))))
            .map(|(k, x)| (x, slopes[k] * x))
            .collect();
        linear_fit(&points).map_or(f64::NAN, |fit| fit.slope)
    };
    let average = block_jackknife(8, slope);
    assert!((average.value - 2.35).abs() < 1e-13);
    assert!((average.standard_error - 0.1 * 0.75f64.sqrt()).abs() < 1e-12);
    let gone = block_jackknife(8, |left_out| if left_out.is_empty() { 1.0 } else { f64::NAN });
    assert!(gone.value == 1.0 && gone.standard_error.is_nan(), "no value without a block, no error");
}
