//! Bias and scatter of a model over all comparisons of one quantity (McGrattan and Toman 2011, Metrologia 48, 173, as in the
//! validation guide of the Fire Dynamics Simulator).
//!
//! A prediction M and a measurement E of the same true value θ are taken for normal about δ θ and θ, with the relative
//! standard deviations σ_M and σ_E. Then ln(M/E) has, to second order, the mean ln δ − σ_M²/2 + σ_E²/2 and the variance
//! σ_M² + σ_E². With the mean m and the standard deviation u of the n values ln(M_i/E_i), u² over n − 1,
//!
//! - σ_M² = u² − σ_E²,
//! - δ = exp(m + σ_M²/2 − σ_E²/2),
//! - ln δ is known to ± t u/√n, with Student's t of n − 1 degrees of freedom.
//!
//! The true value then lies about M/δ, within ± 2 σ_M M/δ in 19 cases of 20 where there are many comparisons. Where the
//! comparisons have experimental uncertainties of their own, σ_E² is their mean square. Where one is not known, none is
//! invented: there is no σ_M, u holds both scatters, and δ = exp(m), the geometric mean, which is the above for σ_M = σ_E.
//! For experiments that claim more than the comparisons scatter, u² < σ_E², what the model adds cannot be told, and there
//! is no σ_M either.

use super::student_quantile;

/// A prediction beside what was measured, in one unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// M.
    pub predicted: f64,
    /// E.
    pub measured: f64,
    /// Relative standard uncertainty of E `[-]`; none where it is not known.
    pub uncertainty: Option<f64>,
}

/// Bias and scatter over the comparisons of one quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelBias {
    /// Number of comparisons of prediction and measurement.
    pub comparisons: usize,
    /// δ: predictions over true values `[-]`.
    pub bias: f64,
    /// 95 % interval `[-]`.
    pub interval: (f64, f64),
    /// u: standard deviation of ln(M/E) `[-]`.
    pub scatter: f64,
    /// σ_E `[-]`; none where a comparison has no experimental uncertainty.
    pub experimental_deviation: Option<f64>,
    /// σ_M `[-]`; none without σ_E, or where that is larger than the scatter.
    model_deviation: Option<f64>,
}

/// Confidence level of the intervals `[-]`.
const CONFIDENCE: f64 = 0.95;

/// Fewest comparisons whose scatter says anything.
const FEWEST: usize = 3;

impl ModelBias {
    /// σ_M `[-]`, where it can be told.
    pub fn model_deviation(&self) -> Option<f64> {
        self.model_deviation
    }

    /// Bounds of the ratio M/E of a further comparison with 95 % confidence `[-]`: Student's factor in place of 2, and the
    /// uncertainty of the bias with it, so that a few comparisons are reported with an interval of due width. The comparison may have a
    /// relative standard uncertainty `[-]` beside, of which the scatter does not know, such as that of inputs which all comparisons of an
    /// experiment have in common.
    pub fn next_ratio_beside(&self, uncertainty: f64) -> (f64, f64) {
        let n = self.comparisons as f64;
        let (lower, upper) = self.interval;
        // the interval is symmetric about m in logarithms, with or without the σ of the bias
        let shift = 0.5 * libm::log(lower * upper) - self.shift();
        let deviation = (self.scatter * self.scatter * (1.0 + 1.0 / n) + uncertainty * uncertainty).sqrt();
        let reach = student_quantile(CONFIDENCE, self.comparisons - 1) * deviation;
        (libm::exp(shift - reach), libm::exp(shift + reach))
    }

    /// ln δ − m.
    fn shift(&self) -> f64 {
        match (self.model_deviation, self.experimental_deviation) {
            (Some(model), Some(experiment)) => 0.5 * (model * model - experiment * experiment),
            (None, Some(experiment)) => -0.5 * experiment * experiment,
            (_, None) => 0.0,
        }
    }
}

/// Bias and scatter of some comparisons; none for fewer than three, or where a value is not positive and so has no ratio.
pub fn model_bias(comparisons: &[Comparison]) -> Option<ModelBias> {
    let has_ratio =
        |of: &Comparison| of.predicted > 0.0 && of.measured > 0.0 && (of.predicted / of.measured).is_finite();
    if comparisons.len() < FEWEST || !comparisons.iter().all(has_ratio) {
        return None;
    }
    let n = comparisons.len() as f64;
    let logarithms: Vec<f64> = comparisons.iter().map(|of| libm::log(of.predicted / of.measured)).collect();
    let mean = logarithms.iter().sum::<f64>() / n;
    let variance = logarithms.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (n - 1.0);
    let experiment: Option<f64> =
        comparisons.iter().map(|of| of.uncertainty.map(|sigma| sigma * sigma)).sum::<Option<f64>>().map(|sum| sum / n);
    let model = experiment.and_then(|square| if square > variance { None } else { Some((variance - square).sqrt()) });
    let reach = student_quantile(CONFIDENCE, comparisons.len() - 1) * (variance / n).sqrt();
    let mut found = ModelBias {
        comparisons: comparisons.len(),
        bias: f64::NAN,
        interval: (f64::NAN, f64::NAN),
        scatter: variance.sqrt(),
        experimental_deviation: experiment.map(f64::sqrt),
        model_deviation: model,
    };
    let centre = mean + found.shift();
    found.bias = libm::exp(centre);
    found.interval = (libm::exp(centre - reach), libm::exp(centre + reach));
    Some(found)
}
