//! Results of a calibration for its page and files: plain data without a trace of when or where it ran.

use super::target::ProfileLocation;
use crate::measured::Measurements;
use serde::{Deserialize, Serialize};

/// One datum beside the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DatumComparison {
    /// Block of the plan.
    pub block: String,
    /// Label of the compared quantity.
    pub label: String,
    /// Table, column and abscissa of a point of a profile.
    pub at: Option<ProfileLocation>,
    /// The datum, in `unit`.
    pub datum: f64,
    /// The datum less and plus its standard uncertainty.
    pub band: (f64, f64),
    /// Value of the model at the best parameters.
    pub model: f64,
    /// Unit.
    pub unit: String,
    /// (model − datum)/σ, or of logarithms `[-]`; σ of fitted data holds the model's scatter too.
    pub residual: f64,
    /// Standard deviation of the model's mean over its seeds, over that of the datum `[-]`; 0 without repeats.
    pub scatter: f64,
    /// Interval of 95 % of the posterior; none for a bake-off.
    pub predicted: Option<(f64, f64)>,
    /// Standard uncertainty of the prediction by that of the parameters, over that of the datum `[-]`; 0 of fitted data.
    pub spread: f64,
    /// Source of the datum.
    pub source: String,
}

/// One parameter and what the data say about it, in its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterEstimate {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Bounds of the search.
    pub bounds: (f64, f64),
    /// Whether the scale is logarithmic.
    pub logarithmic: bool,
    /// Start of the search.
    pub start: f64,
    /// Best value.
    pub best: f64,
    /// 95 % interval by profile likelihood; none with too few evaluations.
    pub interval: Option<(f64, f64)>,
    /// Values within the interval that do not agree with the data, from and to; none where it is in one piece.
    pub gaps: Vec<(f64, f64)>,
    /// Whether the interval ends at a bound only because the search does.
    pub open: (bool, bool),
    /// Whether the model itself has confirmed its ends; where its runs scatter, whether the emulator has runs about them.
    pub settled: (bool, bool),
    /// χ² of the model at the ends above that of the best point `[-]`; none where it was not evaluated there.
    pub rise: (Option<f64>, Option<f64>),
    /// 95 % of the posterior's samples, as many left out below as above; none unless asked for.
    pub credible: Option<(f64, f64)>,
    /// Profile of χ² above its minimum over the parameter.
    pub profile: Vec<(f64, f64)>,
    /// The value that synthetic data were made with.
    pub truth: Option<f64>,
}

impl CalibrationResult {
    /// Whether ends of intervals are runs; where runs scatter, χ² there is that of the emulator.
    pub(super) fn has_runs_at_ends(&self) -> bool {
        self.parameters.iter().any(|found| found.rise != (None, None))
    }

    /// Origin of the ends of intervals.
    pub(super) fn ends_in_words(&self) -> &'static str {
        if self.has_runs_at_ends() { "runs of the model" } else { "those of the emulator" }
    }
}

impl ParameterEstimate {
    /// The values that agree with the data at 95 %, as intervals in rising order; none with too few evaluations.
    pub fn intervals(&self) -> Vec<(f64, f64)> {
        let Some((low, high)) = self.interval else { return Vec::new() };
        let inner = self.gaps.iter().flat_map(|gap| [gap.0, gap.1]);
        let ends: Vec<f64> = [low].into_iter().chain(inner).chain([high]).collect();
        ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
    }

    /// The intervals in words; `digits` writes a number.
    pub fn intervals_in_words(&self, digits: fn(f64) -> String) -> String {
        let intervals = self.intervals();
        let part = |(place, (low, high)): (usize, &(f64, f64))| {
            let at_bound = |open: bool| if open { " (bound)" } else { "" };
            let (below, above) = (self.open.0 && place == 0, self.open.1 && place + 1 == intervals.len());
            format!("{}{} … {}{}", digits(*low), at_bound(below), digits(*high), at_bound(above))
        };
        let parts: Vec<String> = intervals.iter().enumerate().map(part).collect();
        let doubt = if self.settled == (true, true) { "" } else { " (not settled)" };
        parts.join(" or ") + doubt
    }

    /// Share of the range that agrees with the data, on the scale of the parameter `[-]`; 1 without an interval.
    pub fn share(&self) -> f64 {
        let scaled = |value: f64| if self.logarithmic { libm::log(value) } else { value };
        let width = |(low, high): (f64, f64)| scaled(high) - scaled(low);
        if self.interval.is_none() {
            return 1.0;
        }
        self.intervals().into_iter().map(width).sum::<f64>() / width(self.bounds)
    }
}

/// One point of the search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Parameters, in their units.
    pub values: Vec<f64>,
    /// χ² `[-]`; none where the model failed.
    pub chi_squared: Option<f64>,
}

/// Effect of one parameter on the data over its whole range.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ElementaryEffect {
    /// Name.
    pub name: String,
    /// Mean size of its elementary effects μ*, in standard uncertainties of a datum a range `[-]`.
    pub effect: f64,
    /// Scatter σ of its elementary effects, in the same unit `[-]`.
    pub spread: f64,
}

/// One choice of a bake-off.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ChoiceResult {
    /// Name of the choice.
    pub name: String,
    /// Fitted data.
    pub fit: Vec<DatumComparison>,
    /// Data held out.
    pub hold_out: Vec<DatumComparison>,
    /// χ² of the fitted data `[-]`.
    pub chi_squared: Option<f64>,
    /// χ² of the data held out `[-]`.
    pub hold_out_chi_squared: Option<f64>,
    /// Akaike weight among the choices `[-]`.
    pub weight: Option<f64>,
    /// Share of resampled data in which it is first `[-]`.
    pub first: Option<f64>,
    /// 95 % interval of its rank.
    pub ranks: Option<(usize, usize)>,
    /// Reason for missing numbers.
    pub failure: Option<String>,
    /// Reason for missing numbers of the data held out.
    pub hold_out_failure: Option<String>,
}

/// A finished calibration.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct CalibrationResult {
    /// Subject of the calibration.
    pub title: String,
    /// Remarks for the reader.
    pub note: String,
    /// Method of the search.
    pub method: String,
    /// Reason for the end of the search.
    pub stopped: String,
    /// Evaluations of the search itself, other starts among them, and those from which the scatter of runs is known.
    pub searched: usize,
    /// All evaluations by number: the search, then the ends of the intervals.
    pub evaluations: Vec<Evaluation>,
    /// Estimates of the calibrated parameters.
    pub parameters: Vec<ParameterEstimate>,
    /// Minima in which descents ended, the lowest first.
    pub minima: Vec<Evaluation>,
    /// χ² at the best point, which was evaluated, or the sum of another loss `[-]`.
    pub chi_squared: Option<f64>,
    /// The same χ² over the degrees of freedom `[-]`; none unless there are more data than parameters.
    pub reduced_chi_squared: Option<f64>,
    /// Share of repeated experiments in which a true model gives a larger χ² `[-]`.
    pub p_value: Option<f64>,
    /// Factor by which the stated uncertainties were enlarged for the intervals `[-]`.
    pub inflation: f64,
    /// Correlation of the parameters `[-]`.
    pub correlation: Vec<Vec<f64>>,
    /// Points along the profiles of all parameters that agree with the data at 95 %, parameters in their units.
    pub region: Vec<Vec<f64>>,
    /// Share of the box within a quarter of its ranges from a run that succeeded `[-]`; minima elsewhere may be unknown.
    pub covered: Option<f64>,
    /// Whether the joint 95 % region holds the truth of synthetic data.
    pub truth_inside: Option<bool>,
    /// Open questions of the calibration, in sentences.
    pub findings: Vec<String>,
    /// Samples of the posterior, parameters in their units; empty unless asked for.
    pub samples: Vec<Vec<f64>>,
    /// Screening; empty if none was asked for.
    pub sensitivity: Vec<ElementaryEffect>,
    /// Fitted data at the best point.
    pub fit: Vec<DatumComparison>,
    /// Data held out, there.
    pub hold_out: Vec<DatumComparison>,
    /// Choices by rank; empty unless there were any.
    pub trials: Vec<ChoiceResult>,
    /// Complete parameters of every fitted case at the best point.
    pub calibrated: Vec<String>,
    /// Measurements that those cases name.
    #[serde(skip)]
    pub measured: Vec<Measurements>,
    /// Simulations with a record: those of the evaluations and of data held out.
    pub simulations: usize,
}

/// Root mean square of weighted residuals `[-]`; none without data.
pub fn weighted_error(data: &[DatumComparison]) -> Option<f64> {
    let sum: f64 = data.iter().map(|datum| datum.residual * datum.residual).sum();
    (!data.is_empty()).then(|| (sum / data.len() as f64).sqrt())
}

/// Root mean square of (model − datum)/datum `[-]`; none without data or where a datum is zero.
pub(super) fn relative_error(data: &[DatumComparison]) -> Option<f64> {
    let sum: f64 = data.iter().map(|datum| ((datum.model - datum.datum) / datum.datum).powi(2)).sum();
    Some((sum / data.len() as f64).sqrt()).filter(|error| error.is_finite())
}
