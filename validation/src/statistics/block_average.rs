//! Statistical errors of averages over correlated samples, from blocks of a time series (Flyvbjerg and Petersen 1989).
//!
//! Neighbouring samples of a flow are not independent, but means over blocks longer than the correlation time are. The
//! error is taken from blocks of several lengths, each twice the one before; with ever longer blocks it rises to the
//! true one and stays, so that the largest is the answer. It stays too small where the longest block is shorter than
//! the correlation time. The blocks are left out one by one (jackknife, Quenouille and Tukey), which for a mean is the
//! scatter of the blocks, and serves any other statistic of the samples, such as a fitted slope.

use super::Estimate;
use std::ops::Range;

/// Blocks that a time series is split into where nothing else asks for another number.
pub const BLOCKS: usize = 32;

/// Blocks that are still left when they are longest.
const LEAST_BLOCKS: usize = 8;

/// Mean of a time series of equal intervals and its standard error; none for fewer samples than blocks.
#[must_use]
pub fn block_average(series: &[f64]) -> Option<Estimate> {
    if series.len() < BLOCKS {
        return None;
    }
    let sums: Vec<(f64, f64)> = (0..BLOCKS)
        .map(|block| {
            let samples = &series[block * series.len() / BLOCKS..(block + 1) * series.len() / BLOCKS];
            (samples.iter().sum(), samples.len() as f64)
        })
        .collect();
    Some(block_jackknife(BLOCKS, |left_out| {
        let kept = sums.iter().enumerate().filter(|(block, _)| !left_out.contains(block));
        let (sum, samples) = kept.fold((0.0, 0.0), |(sum, samples), (_, add)| (sum + add.0, samples + add.1));
        sum / samples
    }))
}

/// A statistic of blocks in the order of time, and its standard error. `statistic` gives the value of all blocks but
/// those in a range.
#[must_use]
pub fn block_jackknife(blocks: usize, statistic: impl Fn(Range<usize>) -> f64) -> Estimate {
    let mut standard_error: f64 = 0.0;
    let mut length = 1;
    while blocks / length >= LEAST_BLOCKS {
        let values: Vec<f64> =
            (0..blocks / length).map(|block| statistic(block * length..(block + 1) * length)).collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let square: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        // a statistic that has no value without one of the blocks has no error that could be told
        standard_error = if square.is_nan() { square } else { standard_error.max(((n - 1.0) / n * square).sqrt()) };
        length *= 2;
    }
    Estimate { value: statistic(0..0), standard_error }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    /// x_k = φ x_{k−1} + ε with uniform ε of variance 1 − φ², so that x has variance 1.
    fn autoregressive(correlation: f64, samples: usize, seed: u64) -> Vec<f64> {
        let mut random = rand_pcg::Pcg64::seed_from_u64(seed);
        let scale = (3.0 * (1.0 - correlation * correlation)).sqrt();
        let mut value = 0.0;
        let mut next = || {
            value = correlation * value + scale * (2.0 * random.random::<f64>() - 1.0);
            value
        };
        // the start from 0 is forgotten first
        for _ in 0..200 {
            next();
        }
        (0..samples).map(|_| next()).collect()
    }

    /// Root mean square of the standard errors of 20 series.
    fn typical_error(correlation: f64, samples: usize) -> f64 {
        let square = |seed| block_average(&autoregressive(correlation, samples, seed)).unwrap().standard_error.powi(2);
        ((0..20).map(square).sum::<f64>() / 20.0).sqrt()
    }

    #[test]
    fn a_mean_has_the_scatter_of_its_blocks() {
        // 8 blocks of one sample: mean 3.5, Σ(x − 3.5)² = 42, error √(42/(8 · 7))
        let values: Vec<f64> = (0..8).map(f64::from).collect();
        let mean = |left_out: Range<usize>| {
            let kept: Vec<f64> = (0..8).filter(|k| !left_out.contains(k)).map(|k| values[k]).collect();
            kept.iter().sum::<f64>() / kept.len() as f64
        };
        let estimate = block_jackknife(8, mean);
        assert!((estimate.value - 3.5).abs() < 1e-14);
        assert!((estimate.standard_error - 0.75f64.sqrt()).abs() < 1e-13);
    }

    #[test]
    fn blocks_that_swing_against_each_other_give_the_error_of_the_shortest() {
        // ±1 in turn: 32 blocks scatter by 1 with an error √(1/31), longer blocks by nothing
        let series: Vec<f64> = (0..320).map(|k| if (k / 10) % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let estimate = block_average(&series).unwrap();
        assert!(estimate.value.abs() < 1e-15);
        assert!((estimate.standard_error - (1.0f64 / 31.0).sqrt()).abs() < 1e-13);
    }

    #[test]
    fn the_error_of_independent_samples_is_theirs() {
        let exact = (1.0f64 / 4096.0).sqrt();
        let ratio = typical_error(0.0, 4096) / exact;
        assert!((0.9..1.4).contains(&ratio), "{ratio}: the largest of three lengths is a little too large");
    }

    #[test]
    fn correlated_samples_have_the_error_that_theory_gives_them() {
        // (1 + φ)/(1 − φ) = 19 samples count as one; the naive error is 4.4 times too small
        let samples = 16_384;
        let exact = (19.0 / samples as f64).sqrt();
        let ratio = typical_error(0.9, samples) / exact;
        assert!((0.9..1.4).contains(&ratio), "{ratio}");
    }

    #[test]
    fn a_constant_has_no_error_and_a_short_series_no_answer() {
        let estimate = block_average(&[2.5; 100]).unwrap();
        assert!((estimate.value - 2.5).abs() < 1e-15 && estimate.standard_error < 1e-15);
        assert_eq!(block_average(&[1.0; 31]), None);
    }

    #[test]
    fn the_slope_of_a_line_has_the_error_of_its_blocks() {
        // y = b x with b of every block known: the slope over all is their mean, and its error their scatter
        let slopes: Vec<f64> = (0..8).map(|k| 2.0 + 0.1 * f64::from(k)).collect();
        let slope = |left_out: Range<usize>| {
            let points: Vec<(f64, f64)> = (0..8)
                .filter(|k| !left_out.contains(k))
                .flat_map(|k| (0..3).map(move |x| (k, f64::from(x))))
                .map(|(k, x)| (x, slopes[k] * x))
                .collect();
            crate::statistics::linear_fit(&points).map_or(f64::NAN, |fit| fit.slope)
        };
        let estimate = block_jackknife(8, slope);
        assert!((estimate.value - 2.35).abs() < 1e-13);
        assert!((estimate.standard_error - 0.1 * 0.75f64.sqrt()).abs() < 1e-13);
    }
}
