//! What a calibration hands to its page and files: plain data without a trace of when or where it ran.

use super::error::CalibrationError;
use super::findings;
use super::objective::Objective;
use super::plan::{Parameter, Plan};
use super::repeats::Repeated;
use super::target::{Datum, Target};
use super::trials::Trial;
use crate::inference::posterior::Posterior;
use crate::inference::{Answer, Evaluated, LocalMinimum};
use crate::sampling::Spacing;
use serde::{Deserialize, Serialize};

/// Samples of the posterior that are kept.
const MOST_SAMPLES: usize = 1000;

/// Where a datum lies in a profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// Table of the case.
    pub table: String,
    /// Its column of abscissas, with its unit.
    pub x: String,
    /// Its column that is compared, with its unit.
    pub y: String,
    /// Abscissa.
    pub at: f64,
}

/// One datum beside the model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Compared {
    /// Which block of the plan.
    pub block: String,
    /// What is compared.
    pub label: String,
    /// Table, column and abscissa of a point of a profile.
    pub at: Option<Place>,
    /// The datum, in `unit`.
    pub datum: f64,
    /// The datum less and plus its standard uncertainty.
    pub band: (f64, f64),
    /// The model.
    pub model: f64,
    /// Unit.
    pub unit: String,
    /// (model − datum)/σ, or of logarithms `[-]`; σ of fitted data holds the model's scatter too.
    pub residual: f64,
    /// Standard deviation of the model's mean over its seeds, over that of the datum `[-]`; 0 without repeats.
    pub scatter: f64,
    /// What 95 % of the posterior give; none of a bake-off.
    pub predicted: Option<(f64, f64)>,
    /// Where the datum comes from.
    pub source: String,
}

/// One parameter and what the data say about it, in its unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Found {
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
    /// Whether the interval ends at a bound only because the search does.
    pub open: (bool, bool),
    /// Whether the model itself has confirmed its ends.
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

/// One point of the search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Parameters, in their units.
    pub values: Vec<f64>,
    /// χ² `[-]`; none where the model failed.
    pub chi_squared: Option<f64>,
}

/// A minimum that a descent has ended in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FoundMinimum {
    /// Parameters, in their units.
    pub values: Vec<f64>,
    /// χ² `[-]`.
    pub chi_squared: f64,
}

/// What one parameter does to the data over its whole range.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// Name.
    pub name: String,
    /// Mean size of its elementary effects μ*, in standard uncertainties of a datum a range `[-]`.
    pub effect: f64,
    /// Their scatter σ, likewise `[-]`.
    pub spread: f64,
}

/// A finished calibration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// What was calibrated.
    pub title: String,
    /// What a reader must know.
    pub note: String,
    /// Method of the search.
    pub method: String,
    /// Why it ended.
    pub stopped: String,
    /// Evaluations of the search itself, other starts among them.
    pub searched: usize,
    /// All evaluations by number: the search, then the ends of the intervals.
    pub evaluations: Vec<Evaluation>,
    /// The parameters.
    pub parameters: Vec<Found>,
    /// Minima in which descents ended, the lowest first.
    pub minima: Vec<FoundMinimum>,
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
    /// Whether the joint 95 % region holds the truth of synthetic data.
    pub truth_inside: Option<bool>,
    /// What the data leave open, in sentences.
    pub findings: Vec<String>,
    /// Samples of the posterior, parameters in their units; empty unless asked for.
    pub samples: Vec<Vec<f64>>,
    /// Screening; empty if none was asked for.
    pub sensitivity: Vec<Sensitivity>,
    /// Fitted data at the best point.
    pub fit: Vec<Compared>,
    /// Data held out, there.
    pub hold_out: Vec<Compared>,
    /// Choices by rank; empty unless there were any.
    pub trials: Vec<Trial>,
    /// Complete parameters of every fitted case at the best point.
    pub calibrated: Vec<String>,
}

/// Root mean square of weighted residuals `[-]`; none without data.
#[must_use]
pub fn weighted_error(data: &[Compared]) -> Option<f64> {
    let sum: f64 = data.iter().map(|datum| datum.residual * datum.residual).sum();
    (!data.is_empty()).then(|| (sum / data.len() as f64).sqrt())
}

/// Root mean square of (model − datum)/datum `[-]`; none without data or where a datum is zero.
#[must_use]
pub(super) fn relative_error(data: &[Compared]) -> Option<f64> {
    let sum: f64 = data.iter().map(|datum| ((datum.model - datum.datum) / datum.datum).powi(2)).sum();
    Some((sum / data.len() as f64).sqrt()).filter(|error| error.is_finite())
}

/// The data of one kind beside the answers of their blocks.
pub(super) fn compared<'r>(
    objective: &Objective<'_>,
    held_out: bool,
    answer: impl Fn(usize) -> Option<&'r Repeated>,
    named: impl Fn(&Target) -> Target,
) -> Result<Vec<Compared>, CalibrationError> {
    let data: Vec<Datum> =
        objective.data_of(held_out).map(|datum| Datum { target: named(&datum.target), ..datum.clone() }).collect();
    let owned: Vec<Option<Repeated>> = (0..objective.plan.blocks.len()).map(|k| answer(k).cloned()).collect();
    let predicted = objective.predict(data.iter(), |block| owned[block].as_ref())?;
    let one = |(place, (datum, model)): (usize, (Datum, f64))| Compared {
        block: objective.plan.blocks[datum.block].field.clone(),
        label: datum.target.label(),
        at: datum.target.place(),
        datum: datum.value,
        band: datum.band(),
        model,
        unit: datum.unit.clone(),
        residual: datum.residual(model) * if held_out { 1.0 } else { objective.weight(place) },
        scatter: if held_out { 0.0 } else { objective.scatter(place) },
        predicted: None,
        source: datum.source,
    };
    Ok(data.into_iter().zip(predicted).enumerate().map(one).collect())
}

/// The fitted cases as complete files, each once.
pub(super) fn calibrated(objective: &Objective<'_>, values: &[f64]) -> Result<Vec<String>, CalibrationError> {
    let plan = objective.plan;
    let fitted = plan.blocks.iter().filter(|block| !block.held_out);
    fitted
        .map(|block| {
            let prepared =
                block.request.prepare(objective.registry, &plan.file, &plan.settings(block, values), plan.limits)?;
            Ok(prepared.parameters_toml().to_owned())
        })
        .collect()
}

/// Everything about a search, in physical units; with samples of the posterior if they were asked for.
pub(super) fn assemble(
    plan: &Plan,
    answer: &Answer,
    sensitivity: Vec<Sensitivity>,
    (fit, hold_out): (Vec<Compared>, Result<Vec<Compared>, String>),
    calibrated: Vec<String>,
    truth_inside: Option<bool>,
    posterior: Option<&Posterior>,
) -> Outcome {
    let search = &answer.search;
    let region = answer.explored.as_ref().map(|explored| &explored.region);
    let mut findings = findings::of(plan, answer, &fit);
    let hold_out = hold_out.unwrap_or_else(|reason| {
        findings.push(format!("what was held out failed at the best parameters: {reason}"));
        Vec::new()
    });
    let correlation = region.map_or_else(Vec::new, |region| {
        region.correlation.row_iter().map(|row| row.iter().copied().collect()).collect()
    });
    let evaluation = |evaluated: &Evaluated| Evaluation {
        values: plan.values(&evaluated.point),
        chi_squared: evaluated.chi_squared,
    };
    let minimum =
        |minimum: &LocalMinimum| FoundMinimum { values: plan.values(&minimum.point), chi_squared: minimum.chi_squared };
    Outcome {
        title: plan.title.clone(),
        note: plan.note.clone(),
        method: plan.method_name(),
        stopped: search.stopped.to_string(),
        searched: answer.searched,
        evaluations: search.history.iter().map(evaluation).collect(),
        parameters: found(plan, answer, posterior),
        samples: posterior.map_or_else(Vec::new, |posterior| {
            let every = (posterior.samples.len() / MOST_SAMPLES).max(1);
            posterior.samples.iter().step_by(every).map(|sample| plan.values(sample)).collect()
        }),
        minima: search.minima.iter().map(minimum).collect(),
        chi_squared: Some(search.chi_squared),
        reduced_chi_squared: region.and_then(|region| region.reduced_chi_squared),
        p_value: region.and_then(|region| region.p_value),
        inflation: region.map_or(1.0, |region| region.inflation),
        correlation,
        truth_inside,
        findings,
        sensitivity,
        fit,
        hold_out,
        trials: Vec::new(),
        calibrated,
    }
}

/// What was found of every parameter.
fn found(plan: &Plan, answer: &Answer, posterior: Option<&Posterior>) -> Vec<Found> {
    let best = plan.values(&answer.search.best);
    let found = |(k, parameter): (usize, &Parameter)| {
        let physical = |u: f64| parameter.bounds.value(u);
        let profile = answer.explored.as_ref().map(|explored| &explored.region.profiles[k]);
        let ends = answer.explored.as_ref().map(|explored| &explored.ends[k]);
        Found {
            name: parameter.name.clone(),
            unit: parameter.unit.clone(),
            bounds: (parameter.bounds.lower, parameter.bounds.upper),
            logarithmic: parameter.bounds.spacing == Spacing::Log,
            start: parameter.start,
            best: best[k],
            interval: profile.map(|profile| (physical(profile.interval[0]), physical(profile.interval[1]))),
            open: ends.map_or((false, false), |[below, above]| (below.open, above.open)),
            settled: ends.map_or((false, false), |[below, above]| (below.settled, above.settled)),
            rise: ends.map_or((None, None), |[below, above]| (below.rise, above.rise)),
            credible: posterior.map(|posterior| {
                let [low, high] = posterior.intervals[k].map(physical);
                (low, high)
            }),
            profile: profile.map_or_else(Vec::new, |profile| {
                profile.curve.iter().map(|point| (physical(point.point[k]), point.rise)).collect()
            }),
            truth: parameter.truth,
        }
    };
    plan.parameters.iter().enumerate().map(found).collect()
}
