//! Files of a calibration: the page, its figures, tables and the calibrated cases.

use super::plan::CalibrationPlan;
use super::result::{
    CalibrationResult, DatumComparison, Evaluation, ParameterEstimate, relative_error, weighted_error,
};
use super::{figures, held_out, law};
use crate::evidence::HeldOutJudgement;
use crate::figure::{FigureError, FigureFormat};
use crate::inference::UNLIKELY;
use crate::number::{four_digits, short_digits};
use crate::output::{FileError, csv_text, write_whole};
use crate::page::{self, PageFigure};
use crate::result::pretty;
use serde_json::{Value, json};
use std::io;
use std::path::Path;

/// Writes everything into a folder, the result last.
///
/// # Errors
/// Files that cannot be written.
pub fn write(
    outcome: &CalibrationResult,
    plan: &CalibrationPlan,
    folder: &Path,
    format: FigureFormat,
) -> Result<(), FileError> {
    let unwritable = |error: io::Error| FileError::unwritable(folder, &error);
    let undrawn = |error: FigureError| unwritable(io::Error::other(error.to_string()));
    let mut drawn = figures::all(outcome);
    law::draw(&mut drawn, outcome, plan);
    let pictures = page::draw(&drawn, &folder.join("figures"), format).map_err(undrawn)?;
    for (place, text) in outcome.calibrated.iter().enumerate() {
        let name = if place == 0 { "calibrated.toml".to_owned() } else { format!("calibrated-{}.toml", place + 1) };
        write_whole(&folder.join(name), text.as_bytes()).map_err(unwritable)?;
    }
    outcome.measured.iter().try_for_each(|own| own.keep(folder)).map_err(unwritable)?;
    if let Some(law) = law::file(outcome, plan) {
        write_whole(&folder.join("law.toml"), law.as_bytes()).map_err(unwritable)?;
    }
    for (name, rows) in [("evaluations.csv", evaluations(outcome)), ("data.csv", data(outcome))] {
        let text = csv_text(rows).map_err(|error| unwritable(error.into()))?;
        write_whole(&folder.join(name), text.as_bytes()).map_err(unwritable)?;
    }
    let judged = held_out::judged(outcome, plan.digest()?);
    if let Some(judged) = &judged {
        write_whole(&folder.join("held-out.json"), pretty(judged).as_bytes()).map_err(unwritable)?;
    }
    let html =
        render(outcome, judged.as_ref(), pictures).map_err(|error| unwritable(io::Error::other(error.to_string())))?;
    write_whole(&folder.join("index.html"), html.as_bytes()).map_err(unwritable)?;
    write_whole(&folder.join("result.json"), pretty(outcome).as_bytes()).map_err(unwritable)
}

fn evaluations(outcome: &CalibrationResult) -> Vec<Vec<String>> {
    let heads = outcome.parameters.iter().map(|parameter| format!("{} [{}]", parameter.name, parameter.unit));
    let mut rows = vec![[vec!["evaluation".to_owned()], heads.collect(), vec!["chi squared [-]".to_owned()]].concat()];
    for (k, evaluation) in outcome.evaluations.iter().enumerate() {
        let chi = evaluation.chi_squared.map_or_else(|| "failed".to_owned(), |chi| chi.to_string());
        let values = evaluation.values.iter().map(f64::to_string);
        rows.push([vec![(k + 1).to_string()], values.collect(), vec![chi]].concat());
    }
    rows
}

/// Every datum with its use: `fit`, `hold-out`, or those of a choice.
fn all_data(outcome: &CalibrationResult) -> Vec<(String, &DatumComparison)> {
    let own = [("fit", &outcome.fit), ("hold-out", &outcome.hold_out)];
    let mut list: Vec<(String, &DatumComparison)> =
        own.into_iter().flat_map(|(name, data)| data.iter().map(move |datum| (name.to_owned(), datum))).collect();
    for trial in &outcome.trials {
        list.extend(trial.fit.iter().map(|datum| (format!("fit, {}", trial.name), datum)));
        list.extend(trial.hold_out.iter().map(|datum| (format!("hold-out, {}", trial.name), datum)));
    }
    list
}

fn data(outcome: &CalibrationResult) -> Vec<Vec<String>> {
    let numbers = "datum,lower,upper,model,residual [-],scatter [-],predicted lower,predicted upper";
    let head = format!("use,block,quantity,unit,{numbers},source");
    let mut rows = vec![head.split(',').map(str::to_owned).collect::<Vec<_>>()];
    for (name, datum) in all_data(outcome) {
        let numbers = [datum.datum, datum.band.0, datum.band.1, datum.model, datum.residual, datum.scatter]
            .map(|value| value.to_string());
        let predicted =
            datum.predicted.map_or_else(Default::default, |(low, high)| [low.to_string(), high.to_string()]);
        let head = [name, datum.block.clone(), datum.label.clone(), datum.unit.clone()];
        rows.push(head.into_iter().chain(numbers).chain(predicted).chain([datum.source.clone()]).collect());
    }
    rows
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), four_digits)
}

/// Errors of a set of data as text.
fn errors(what: &str, data: &[DatumComparison]) -> Option<Value> {
    let percent = |error: f64| format!("{} %", four_digits(100.0 * error));
    (!data.is_empty()).then(|| {
        json!({
            "what": what,
            "data": data.len(),
            "weighted": optional(weighted_error(data)),
            "relative": relative_error(data).map_or_else(|| "–".to_owned(), percent),
        })
    })
}

/// The first sentences of the page.
fn summary(outcome: &CalibrationResult) -> Vec<String> {
    let mut lines = Vec::new();
    if outcome.trials.is_empty() {
        let failed = outcome.evaluations.iter().filter(|evaluation| evaluation.chi_squared.is_none()).count();
        let beyond = outcome.evaluations.len() - outcome.searched;
        lines.push(format!(
            "{} evaluations by {} and {beyond} at the ends of the intervals and the edge of the joint region, {failed} of them \
             failed; simulations: {}; {}.",
            outcome.searched, outcome.method, outcome.simulations, outcome.stopped
        ));
        let scatter = outcome.fit.iter().map(|datum| datum.scatter).fold(0.0, f64::max);
        if scatter > 0.0 {
            lines.push(format!(
                "Results scatter between seeds: means over seeds by up to {} standard uncertainties of a datum, \
                 which χ² and the intervals include.",
                four_digits(scatter)
            ));
        }
        if outcome.minima.len() > 1 {
            let minimum = |minimum: &Evaluation| {
                let values: Vec<String> = minimum.values.iter().map(|value| four_digits(*value)).collect();
                format!("χ² {} at ({})", optional(minimum.chi_squared), values.join(", "))
            };
            let minima: Vec<String> = outcome.minima.iter().map(minimum).collect();
            lines.push(format!("Descents ended in {} minima: {}.", minima.len(), minima.join("; ")));
        }
        if let Some(covered) = outcome.covered {
            lines.push(format!(
                "{} % of the search box is closer than a quarter of its ranges to a successful run; the rest was not searched.",
                short_digits(100.0 * covered, 2)
            ));
        }
        if let (Some(reduced), Some(p)) = (outcome.reduced_chi_squared, outcome.p_value) {
            let judged = if outcome.inflation > 1.0 {
                let cause = if p < UNLIKELY {
                    "the model does not explain the data within their uncertainties"
                } else {
                    "neighbouring residuals are correlated"
                };
                let factor = four_digits(outcome.inflation);
                format!("{cause}, so the uncertainties were enlarged by {factor} for the intervals")
            } else if p > 1.0 - UNLIKELY {
                "the data agree with the model better than their uncertainties allow".to_owned()
            } else {
                "the model explains the data within their uncertainties".to_owned()
            };
            let [reduced, p] = [reduced, p].map(four_digits);
            lines.push(format!("χ² over the degrees of freedom is {reduced} (p = {p}): {judged}."));
        }
        let credible = |found: &ParameterEstimate| {
            let (low, high) = found.credible?;
            Some(format!("{} {} … {} {}", found.name, four_digits(low), four_digits(high), found.unit))
        };
        let credible: Vec<String> = outcome.parameters.iter().filter_map(credible).collect();
        if !credible.is_empty() {
            lines.push(format!("Posterior with a uniform prior, 95 % intervals: {}.", credible.join("; ")));
        }
        if let Some(inside) = outcome.truth_inside {
            let word = if inside { "contains" } else { "does not contain" };
            lines.push(format!("The joint 95 % region {word} the true values of the synthetic data."));
        }
    } else {
        lines
            .push(format!("{} choices, ranked by χ² of the same data; no parameter was fitted.", outcome.trials.len()));
    }
    lines
}

/// HTML of a sentence whose backticks mark names.
fn with_code(sentence: &str) -> String {
    let escaped = sentence.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    let marked =
        |(place, part): (usize, &str)| if place % 2 == 1 { format!("<code>{part}</code>") } else { part.to_owned() };
    escaped.split('`').enumerate().map(marked).collect()
}

fn render(
    outcome: &CalibrationResult,
    judged: Option<&HeldOutJudgement>,
    pictures: Vec<PageFigure>,
) -> Result<String, minijinja::Error> {
    let parameter = |found: &ParameterEstimate| {
        let interval = found.interval.map_or_else(|| "–".to_owned(), |_| found.intervals_in_words(four_digits));
        let bounds = format!("{} … {}", four_digits(found.bounds.0), four_digits(found.bounds.1));
        let truth =
            found.truth.map(|truth| format!("{} ({:+.2} %)", four_digits(truth), 100.0 * (found.best / truth - 1.0)));
        vec![
            found.name.clone(),
            found.unit.clone(),
            four_digits(found.best),
            interval,
            format!("{} %", short_digits(100.0 * found.share(), 2)),
            four_digits(found.start),
            bounds,
        ]
        .into_iter()
        .chain(truth)
        .collect::<Vec<String>>()
    };
    let trial = |trial: &super::result::ChoiceResult| {
        let range =
            |(low, high): (usize, usize)| if low == high { low.to_string() } else { format!("{low} … {high}") };
        let ranks = trial.ranks.map_or_else(|| "–".to_owned(), range);
        vec![
            trial.name.clone(),
            optional(trial.chi_squared),
            optional(weighted_error(&trial.fit)),
            optional(trial.weight),
            optional(trial.first),
            ranks,
            optional(trial.hold_out_chi_squared),
            optional(weighted_error(&trial.hold_out)),
            trial.failure.clone().or_else(|| trial.hold_out_failure.clone()).unwrap_or_default(),
        ]
    };
    let datum = |(name, datum): (String, &DatumComparison)| {
        vec![
            name,
            datum.label.clone(),
            datum.unit.clone(),
            four_digits(datum.datum),
            format!("{} … {}", four_digits(datum.band.0), four_digits(datum.band.1)),
            four_digits(datum.model),
            format!("{:+.2}", datum.residual),
            datum
                .predicted
                .map_or_else(|| "–".to_owned(), |(low, high)| format!("{} … {}", four_digits(low), four_digits(high))),
            datum.source.clone(),
        ]
    };
    // what the data hardly constrain comes first
    let mut parameters: Vec<&ParameterEstimate> = outcome.parameters.iter().collect();
    parameters.sort_by(|a, b| b.share().total_cmp(&a.share()));
    let errors = [errors("fitted", &outcome.fit), errors("held out", &outcome.hold_out)];
    let page = json!({
        "errors": errors.iter().flatten().collect::<Vec<_>>(),
        "parameters": parameters.into_iter().map(parameter).collect::<Vec<_>>(),
        "with_truth": outcome.parameters.iter().all(|found| found.truth.is_some()),
        "findings": outcome.findings.iter().map(|finding| with_code(finding)).collect::<Vec<_>>(),
        "trials": outcome.trials.iter().map(trial).collect::<Vec<_>>(),
        "data": all_data(outcome).into_iter().map(datum).collect::<Vec<_>>(),
        "summary": summary(outcome).into_iter().chain(judged.map(HeldOutJudgement::in_words)).collect::<Vec<_>>().iter().map(|line| with_code(line)).collect::<Vec<_>>(),
        "pictures": pictures,
        "ends": outcome.ends_in_words(),
        "is_case": !outcome.calibrated.is_empty(),
        "outcome": outcome,
    });
    page::fill(&[("index.html", include_str!("template/index.html"))], "index.html", &page)
}
