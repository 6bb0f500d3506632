//! Files of a judgement: the page, its figures and numbers.

use super::document::{biases, document, given, junit};
use super::{CodeComparison, JudgedCode, MetricComparison};
use crate::figure::FigureFormat;
use crate::metric::{Metric, Verdict};
use crate::number::{four_digits, two_digits};
use crate::output::FileError;
use crate::page::{self, PageFigure};
use crate::report::{ReportError, Severity, put, put_junit};
use crate::result::pretty;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;

/// Writes `index.html`, `metrics.json` and `figures/` into a folder, and JUnit's XML into a file where one is named.
///
/// # Errors
/// Files that cannot be written.
pub fn write(
    judgement: &CodeComparison,
    folder: &Path,
    format: FigureFormat,
    junit_file: Option<&Path>,
) -> Result<(), ReportError> {
    let pictures = page::draw(&judgement.figures, &folder.join("figures"), format)?;
    for table in &judgement.own.tables {
        let tables = folder.join("tables");
        let failed = |error| FileError::unwritable(&tables, &error);
        std::fs::create_dir_all(&tables).map_err(failed)?;
        table.write(&tables).map_err(failed)?;
    }
    put(&folder.join("metrics.json"), pretty(&document(judgement)))?;
    put(&folder.join("case.toml"), &judgement.own.parameters_toml)?;
    if let Some(path) = junit_file {
        put_junit(path, &junit(judgement))?;
    }
    Ok(put(&folder.join("index.html"), render(judgement, pictures)?)?)
}

fn render(judgement: &CodeComparison, pictures: Vec<PageFigure>) -> Result<String, minijinja::Error> {
    let own = &judgement.own;
    let page = json!({
        "case": own.name,
        "tier": own.tier.to_string(),
        "description": own.description,
        "version": env!("CARGO_PKG_VERSION"),
        "codes": judgement.codes.iter().map(code_row).collect::<Vec<_>>(),
        "heads": judgement.codes.iter().map(|judged| &judged.submission.code.name).collect::<Vec<_>>(),
        "rows": rows(judgement),
        "quantities": quantities(judgement),
        "pictures": pictures,
    });
    page::fill(&[("judge.html", include_str!("template/judge.html"))], "judge.html", &page)
}

fn code_row(judged: &JudgedCode) -> Value {
    let tally = judged.tally();
    let (passing, failing) = (tally.of(Severity::Pass), tally.of(Severity::NewFailure));
    json!({
        "name": judged.submission.code.name,
        "version": judged.submission.code.version,
        "law": judged.submission.law,
        "file": judged.submission.path.display().to_string(),
        "moved": judged.moved,
        "failing": failing,
        "tally": tally.in_words(),
        "class": if failing > 0 { "fail" } else if passing > 0 { "pass" } else { "observed" },
    })
}

/// Metrics that any code was judged by, or could have been: those with a gate or a reference, and those that were given.
fn rows(judgement: &CodeComparison) -> Vec<Value> {
    judgement
        .own
        .metrics
        .iter()
        .filter_map(|metric| {
            let same = |one: &&MetricComparison| one.own.name == metric.name && one.own.variant == metric.variant;
            let compared: Vec<Option<&MetricComparison>> =
                judgement.codes.iter().map(|judged| judged.metrics.iter().find(same)).collect();
            let is_given = compared.iter().flatten().any(|one| one.foreign.is_some());
            let is_asked = compared.iter().flatten().next().is_some() && metric.verdict() != Verdict::Observed;
            if !is_given && !is_asked {
                return None;
            }
            let theirs = compared.iter().map(|one| {
                let foreign = one.and_then(|one| one.foreign.as_ref());
                let mut cell = cell(foreign);
                cell["limit"] = foreign.and_then(|foreign| other_limit(metric, foreign)).into();
                cell
            });
            let reference = metric.reference.as_ref();
            Some(json!({
                "metric": metric.name,
                "variant": metric.variant.to_string(),
                "unit": metric.unit,
                "reference": reference.and_then(|of| of.value).map(four_digits).unwrap_or_default(),
                "source": reference.map(|of| &of.source),
                "limit": metric.gate.as_ref().map(|gate| gate.limit.in_words(four_digits)).unwrap_or_default(),
                "reason": metric.gate.as_ref().map(|gate| &gate.reason),
                "cells": std::iter::once(cell(Some(metric))).chain(theirs).collect::<Vec<_>>(),
            }))
        })
        .collect()
}

/// The limit of another code's metric in words, where it differs from ours.
pub(crate) fn other_limit(own: &Metric, foreign: &Metric) -> Option<String> {
    let limit = |metric: &Metric| metric.gate.as_ref().map(|gate| gate.limit);
    limit(foreign).filter(|other| Some(*other) != limit(own)).map(|other| other.in_words(four_digits))
}

/// Class of the style sheet, symbol and word of a verdict; none where nothing was given.
pub(crate) fn mark(verdict: Option<Verdict>) -> [&'static str; 3] {
    match verdict {
        Some(Verdict::Pass) => ["pass", "✓", Severity::Pass.word()],
        Some(Verdict::Fail) => ["fail", "✗", Severity::NewFailure.word()],
        Some(Verdict::Observed) => ["observed", "·", "observed"],
        None => ["observed", "–", Severity::NotJudged.word()],
    }
}

fn cell(metric: Option<&Metric>) -> Value {
    let [class, symbol, text] = mark(metric.map(Metric::verdict));
    let reference = metric.and_then(|metric| metric.reference.as_ref()?.value);
    json!({
        "class": class,
        "symbol": symbol,
        "word": text,
        "value": metric.map(|metric| four_digits(metric.value)).unwrap_or_default(),
        // difference from the reference, where it has one
        "off": metric.zip(reference).map(|(metric, reference)| signed(metric.value - reference)),
    })
}

fn signed(number: f64) -> String {
    if number > 0.0 { format!("+{}", two_digits(number)) } else { two_digits(number) }
}

/// δ, σ_M and the number of comparisons of every quantity with enough comparisons.
fn quantities(judgement: &CodeComparison) -> Vec<Value> {
    let case = &judgement.own.name;
    let all: Vec<_> = std::iter::once(biases(case, &judgement.own.metrics))
        .chain(judgement.codes.iter().map(|judged| biases(case, given(judged))))
        .collect();
    let names: BTreeSet<String> = all.iter().flatten().map(|bias| bias.quantity.clone()).collect();
    let text = |biases: &[crate::report::scatter::QuantityBias], name: &str| {
        let bias = biases.iter().find(|bias| bias.quantity == name)?;
        let (lower, upper) = bias.found.interval;
        let model = bias.found.model_deviation().map_or_else(
            || format!("scatter {}", two_digits(bias.found.scatter)),
            |model| format!("σ_M {}", two_digits(model)),
        );
        let (delta, lower, upper) = (two_digits(bias.found.bias), two_digits(lower), two_digits(upper));
        Some(format!("δ {delta} ({lower} … {upper}), {model}, {} comparisons", bias.found.comparisons))
    };
    names
        .into_iter()
        .map(|name| {
            let cell = |biases: &Vec<_>| text(biases, &name).unwrap_or_else(|| "–".to_owned());
            json!({ "name": name, "cells": all.iter().map(cell).collect::<Vec<_>>() })
        })
        .collect()
}
