//! What a calibration hands to its page and files: plain data without a trace of when or where it ran.

use super::error::CalibrationError;
use super::objective::Objective;
use super::plan::Plan;
use super::target::{Datum, Target};
use super::trials::Trial;
use crate::evaluation::Record;
use crate::inference::{Explored, Parameter as Named, Search, Stopped, assess, chi_squared};
use crate::sampling::Spacing;
use serde::{Deserialize, Serialize};

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
    /// (model − datum)/σ, or the same of logarithms `[-]`.
    pub residual: f64,
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
    /// Evaluations of the search itself.
    pub searched: usize,
    /// All evaluations by number: the search, then the ends of the intervals.
    pub evaluations: Vec<Evaluation>,
    /// The parameters.
    pub parameters: Vec<Found>,
    /// χ² at the best point `[-]`.
    pub chi_squared: Option<f64>,
    /// χ² over the degrees of freedom `[-]`; none unless there are more data than parameters.
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

/// The data of one kind beside the records of their blocks.
pub(super) fn compared<'r>(
    objective: &Objective<'_>,
    held_out: bool,
    record: impl Fn(usize) -> Option<&'r Record>,
    named: impl Fn(&Target) -> Target,
) -> Result<Vec<Compared>, CalibrationError> {
    let data: Vec<Datum> =
        objective.data_of(held_out).map(|datum| Datum { target: named(&datum.target), ..datum.clone() }).collect();
    let owned: Vec<Option<Record>> = (0..objective.plan.blocks.len()).map(|k| record(k).cloned()).collect();
    let predicted = objective.predict(data.iter(), |block| owned[block].as_ref())?;
    let one = |(datum, model): (Datum, f64)| Compared {
        block: objective.plan.blocks[datum.block].field.clone(),
        label: datum.target.label(),
        at: datum.target.place(),
        datum: datum.value,
        band: datum.band(),
        model,
        unit: datum.unit.clone(),
        residual: datum.residual(model),
        source: datum.source,
    };
    Ok(data.into_iter().zip(predicted).map(one).collect())
}

/// The fitted cases as complete files, each once.
pub(super) fn calibrated(objective: &Objective<'_>, values: &[f64]) -> Result<Vec<String>, CalibrationError> {
    let plan = objective.plan;
    let fitted = plan.blocks.iter().filter(|block| !block.held_out);
    fitted
        .map(|block| {
            let prepared = block.request.prepare(objective.registry, &plan.file, &plan.settings(block, values))?;
            Ok(prepared.parameters_toml().to_owned())
        })
        .collect()
}

/// Everything about a search, in physical units.
pub(super) fn assemble(
    plan: &Plan,
    search: &Search,
    searched: usize,
    mapped: Option<&Explored>,
    sensitivity: Vec<Sensitivity>,
    (fit, hold_out): (Vec<Compared>, Result<Vec<Compared>, String>),
    calibrated: Vec<String>,
) -> Outcome {
    let region = mapped.map(|mapped| &mapped.region);
    let (hold_out, held_out_failure) = match hold_out {
        Ok(data) => (data, None),
        Err(reason) => (Vec::new(), Some(format!("what was held out failed at the best parameters: {reason}"))),
    };
    let physical = |k: usize, u: f64| plan.parameters[k].bounds.value(u);
    let best = plan.values(&search.best);
    let found = |(k, parameter): (usize, &super::plan::Parameter)| {
        let profile = region.map(|region| &region.profiles[k]);
        Found {
            name: parameter.name.clone(),
            unit: parameter.unit.clone(),
            bounds: (parameter.bounds.lower, parameter.bounds.upper),
            logarithmic: parameter.bounds.spacing == Spacing::Log,
            start: parameter.start,
            best: best[k],
            interval: profile.map(|p| (physical(k, p.interval[0]), physical(k, p.interval[1]))),
            open: profile.map_or((false, false), |p| (p.open_below, p.open_above)),
            profile: profile.map_or_else(Vec::new, |p| {
                p.curve.iter().map(|point| (physical(k, point.point[k]), point.rise)).collect()
            }),
            truth: parameter.truth,
        }
    };
    let names: Vec<Named> =
        plan.parameters.iter().map(|p| Named { name: p.name.clone(), unit: p.unit.clone() }).collect();
    let truth: Option<Vec<f64>> =
        plan.parameters.iter().map(|p| p.truth.map(|truth| p.bounds.coordinate(truth))).collect();
    let mut findings = Vec::new();
    if matches!(search.stopped, Stopped::BudgetSpent | Stopped::Stalled) {
        findings.push(format!("the search did not converge: {}", search.stopped));
    }
    match mapped {
        None => {
            findings.push("too few evaluations succeeded to say how well the data determine the parameters".to_owned())
        }
        Some(mapped) => {
            let region = &mapped.region;
            if region.inflation > 1.0 {
                findings.push("the model does not explain the data within their uncertainties".to_owned());
            }
            findings.extend(assess(&region.jacobian(), region, &names, &physical).iter().map(ToString::to_string));
            for (k, profile) in region.profiles.iter().enumerate() {
                let [low, high] = profile.interval;
                if !(low..=high).contains(&search.best[k]) {
                    findings.push(format!(
                        "the best `{}` that was evaluated lies outside its own interval, which rests on a polynomial through \
                         all evaluations: they lie too far apart, or the model is noisy",
                        names[k].name
                    ));
                }
            }
            if !mapped.settled {
                let text = "ends of intervals lie where the model was not evaluated; allow more `region_evaluations`";
                findings.push(text.to_owned());
            }
        }
    }
    findings.extend(held_out_failure);
    let correlation = region.map_or_else(Vec::new, |region| {
        region.correlation.row_iter().map(|row| row.iter().copied().collect()).collect()
    });
    let evaluation = |evaluated: &crate::inference::Evaluated| Evaluation {
        values: plan.values(&evaluated.point),
        chi_squared: evaluated.chi_squared,
    };
    let residuals: Vec<f64> = fit.iter().map(|datum| datum.residual).collect();
    Outcome {
        title: plan.title.clone(),
        note: plan.note.clone(),
        method: plan.method.name().to_owned(),
        stopped: search.stopped.to_string(),
        searched,
        evaluations: search.history.iter().map(evaluation).collect(),
        parameters: plan.parameters.iter().enumerate().map(found).collect(),
        chi_squared: Some(chi_squared(&residuals)),
        reduced_chi_squared: region.and_then(|region| region.reduced_chi_squared),
        p_value: region.and_then(|region| region.p_value),
        inflation: region.map_or(1.0, |region| region.inflation),
        correlation,
        truth_inside: region.zip(truth).map(|(region, truth)| region.contains(&truth)),
        findings,
        sensitivity,
        fit,
        hold_out,
        trials: Vec::new(),
        calibrated,
    }
}
