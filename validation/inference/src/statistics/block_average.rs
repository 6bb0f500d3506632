//! Statistical errors of averages over correlated samples, from blocks of a time series.
//!
//! Neighbouring samples of a flow are not independent. With the integral time τ = ∫₀^∞ ρ dt of their correlation ρ, a mean
//! over the window T has the variance 2 σ² τ/T: it counts T/(2τ) independent samples. A scatter of blocks sees that only
//! where a block is many integral times long; with 40 of them in a window of 8 blocks the error comes out right, with 8 it
//! is 0.75 of the true one and with 2 it is 0.38. So the correlation of neighbouring blocks is measured and what it means
//! is added. The blocks are taken for an autoregressive series of order one, of which
//!
//! - r = Σ (y_k − ȳ)(y_{k+1} − ȳ)/Σ (y_k − ȳ)² is the correlation as measured. It is too small, since ȳ follows the
//!   series: E(r) = φ − (1 + 3φ)/n (Kendall 1954, Marriott and Pope 1954), hence φ = (n r + 1)/(n − 3);
//! - g = [(1 + φ)/(1 − φ) − 2 φ (1 − φⁿ)/(n (1 − φ)²)]/n is the variance of the mean over that of a block;
//! - σ² = Σ (y_k − ȳ)²/n/(1 − g) is the variance of a block, of which the window's own mean has taken the share g;
//! - T/τ = 2 n (1 − φ)/(1 + φ) integral times lie in the window.
//!
//! The standard error is σ √g, but no more than the blocks scatter: a mean is no worse than one of its samples. Its 95 %
//! half width is Student's factor of T/(2τ) − 1 degrees of freedom times it, at least of one, so that a window of few
//! integral times is reported with a wide interval instead of a wrong one. The blocks are left out one by one (jackknife, Quenouille
//! and Tukey): y_k = n θ − (n − 1) θ_(k) of a mean is the block's mean, and serves any other statistic of the samples, such as
//! a fitted slope.

use super::{FittedValue, student_quantile_of};
use std::ops::Range;

/// Blocks that a time series is split into where nothing else asks for another number.
pub const BLOCKS: usize = 32;

/// Confidence level of the half width `[-]`.
const CONFIDENCE: f64 = 0.95;

/// Largest correlation of neighbouring blocks that is distinguished from a drift `[-]`.
const LARGEST_CORRELATION: f64 = 0.999;

/// A statistic of a window, and how well the window knows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Average {
    /// The value.
    pub value: f64,
    /// Standard error, in the value's unit; not a number where leaving out a block leaves no value.
    pub standard_error: f64,
    /// Half width of its 95 % interval, in the value's unit.
    pub half_width: f64,
    /// Integral times that the window is long `[-]`; infinite for a constant.
    pub integral_times: f64,
}

impl Average {
    /// The value with its standard error.
    pub fn estimate(self) -> FittedValue {
        FittedValue { value: self.value, standard_error: self.standard_error }
    }
}

/// Error of a time series too short for an average with an error; the message completes "failed to …".
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "average over {samples} samples: the window must hold at least {BLOCKS}, one a block; sample more often or longer"
)]
pub struct TooFewSamples {
    /// Samples in the window.
    pub samples: usize,
}

/// Mean of a time series of equal intervals, with its statistical error.
///
/// # Errors
/// For fewer samples than blocks.
pub fn block_average(series: &[f64]) -> Result<Average, TooFewSamples> {
    let samples = series.len();
    if samples < BLOCKS {
        return Err(TooFewSamples { samples });
    }
    let sums: Vec<(f64, f64)> = (0..BLOCKS)
        .map(|block| {
            let samples = &series[block * samples / BLOCKS..(block + 1) * samples / BLOCKS];
            (samples.iter().sum(), samples.len() as f64)
        })
        .collect();
    Ok(block_jackknife(BLOCKS, |left_out| {
        let kept = sums.iter().enumerate().filter(|(block, _)| !left_out.contains(block));
        let (sum, samples) = kept.fold((0.0, 0.0), |(sum, samples), (_, add)| (sum + add.0, samples + add.1));
        sum / samples
    }))
}

/// Statistic of blocks in time order, with its jackknife error. `statistic` gives the value of all blocks but
/// those in a range.
pub fn block_jackknife(blocks: usize, statistic: impl Fn(Range<usize>) -> f64) -> Average {
    let value = statistic(0..0);
    let n = blocks as f64;
    let of_block = |block| n * value - (n - 1.0) * statistic(block..block + 1);
    let (standard_error, half_width, integral_times) = error_of_mean(&(0..blocks).map(of_block).collect::<Vec<_>>());
    Average { value, standard_error, half_width, integral_times }
}

/// Standard error and 95 % half width of the mean of successive values, and the integral times that they span.
fn error_of_mean(values: &[f64]) -> (f64, f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    if square.is_nan() {
        // a statistic that has no value without one of the blocks has no error that could be told
        return (f64::NAN, f64::NAN, f64::NAN);
    }
    let product: f64 = values.windows(2).map(|pair| (pair[0] - mean) * (pair[1] - mean)).sum();
    // the rounding of equal blocks is no correlation
    let measured = if square > (f64::EPSILON * n * mean).powi(2) * n { product / square } else { 0.0 };
    let correlation = ((n * measured + 1.0) / (n - 3.0)).clamp(0.0, LARGEST_CORRELATION);
    let (more, less) = (1.0 + correlation, 1.0 - correlation);
    let share = (more / less - 2.0 * correlation * (1.0 - libm::pow(correlation, n)) / (n * less * less)) / n;
    let scatter = square / (n - 1.0);
    let standard_error = (square / n / (1.0 - share) * share).min(scatter).sqrt();
    let integral_times = 2.0 * n * less / more;
    let freedom = (0.5 * integral_times - 1.0).clamp(1.0, n - 1.0);
    let integral_times = if square > 0.0 { integral_times } else { f64::INFINITY };
    (standard_error, student_quantile_of(CONFIDENCE, freedom) * standard_error, integral_times)
}
