//! Failures in two lines each, the furthest off first: case, quantity and variant, then the value beside its reference and limit. Why an
//! expected failure fails stands in the metric's row on the page of its case.

use super::expected_failures::ListStatus;
use super::judgement::{JudgedCase, JudgedMetric, Rank, Severity};
use super::rows::{signed, statement};
use super::view::{VerdictMark, anchor};
use crate::metric::{GateOwner, Limit, Metric, Quantity};
use crate::number::with_unit;
use serde_json::{Value, json};

/// Most results that the banner names.
const MOST_NAMED: usize = 3;

/// Runs that diverged, then gates: unexpected failures first, the user's own gates before those of the case.
pub(super) fn of(cases: &[JudgedCase<'_>]) -> Vec<Value> {
    let mut items: Vec<((Severity, GateOwner), f64, Value)> = Vec::new();
    for case in cases {
        for &(variant, message) in &case.diverged {
            let item = json!({
                "mark": VerdictMark { word: "diverged", ..VerdictMark::FAIL },
                "case": case.case.name,
                "anchor": "runs",
                "title": title(&case.case.summary),
                "what": "a run diverged",
                "metric": "",
                "variant": variant.to_string(),
                "statement": message,
            });
            items.push(((Severity::NewFailure, GateOwner::User), f64::INFINITY, item));
        }
        for judged in &case.metrics {
            let Rank::Failing(severity) = judged.rank() else { continue };
            let item = json!({
                "mark": VerdictMark::of(Some(severity)),
                "case": case.case.name,
                "anchor": anchor(&case.case.name, &judged.metric.name, &judged.metric.variant),
                "title": title(&case.case.summary),
                "what": in_words(case.case.quantities, &judged.metric.name),
                "metric": judged.metric.name,
                "variant": judged.metric.variant.to_string(),
                "statement": statement(judged),
                "off": off(judged.metric),
                "note": short_note(judged),
            });
            // canonical studies are judged as a user's own are, and fail no louder than cases
            let owner = match severity {
                Severity::ExpectedFailure => GateOwner::Case,
                _ => judged.metric.gate_owner(),
            };
            items.push(((severity, owner), distance(judged.metric), item));
        }
    }
    // Stable: equal ones keep the order of the page.
    items.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    items.into_iter().map(|(.., item)| item).collect()
}

/// The flow that a case's line names, without its details and its reference.
fn title(summary: &str) -> &str {
    // a list may begin with a single word
    let ends = [": ", ", ", " against "].into_iter().filter_map(|end| summary.find(end));
    let ends = ends.filter(|end| summary[..*end].contains(' '));
    &summary[..ends.min().unwrap_or(summary.len())]
}

/// The description of a quantity that its case declares, or else its name.
fn in_words(quantities: &[Quantity], name: &str) -> String {
    let declared = quantities.iter().find(|quantity| quantity.name == name);
    declared.map_or_else(|| name.replace('_', " "), |quantity| quantity.description.to_owned())
}

/// The furthest off of as many cases.
pub(super) fn weakest(items: &[Value]) -> Vec<usize> {
    let is_first = |place: &usize| items[..*place].iter().all(|before| before["case"] != items[*place]["case"]);
    (0..items.len()).filter(is_first).take(MOST_NAMED).collect()
}

/// Right value: the reference, or the bound of the limit that it breaks where there is none, or none but zero.
fn expected(metric: &Metric) -> Option<f64> {
    let reference = metric.reference.as_ref().and_then(|reference| reference.value).filter(|value| *value != 0.0);
    let bound = || {
        Some(match metric.gate.as_ref()?.limit {
            Limit::AtMost(bound) | Limit::AtLeast(bound) => bound,
            Limit::Within(lower, _) if metric.value < lower => lower,
            Limit::Within(_, upper) => upper,
        })
    };
    reference.or_else(bound)
}

/// Logarithm of how many times too large or too small a value is; of the wrong sign, of one and its error over what is expected; infinite
/// for zero and for no number.
fn distance(metric: &Metric) -> f64 {
    let ratio = expected(metric).map_or(f64::NAN, |expected| metric.value / expected);
    match ratio {
        positive if positive > 0.0 => libm::log(positive).abs(),
        negative if negative < 0.0 => libm::log(2.0 - negative),
        _ => f64::INFINITY,
    }
}

/// Distance from the reference in words.
fn off(metric: &Metric) -> String {
    let reference = metric.reference.as_ref().and_then(|reference| reference.value);
    let Some(expected) = reference.filter(|value| *value != 0.0 && metric.value.is_finite()) else {
        return String::new();
    };
    let share = 100.0 * (metric.value / expected - 1.0);
    format!("{} is right ({} %)", with_unit(expected, &metric.unit), signed(share))
}

/// Entry of the list of expected failures in words, without its reason.
fn short_note(judged: &JudgedMetric<'_>) -> String {
    let whole = judged.note();
    match &judged.listed {
        ListStatus::AsListed(entry) => {
            whole.split_once(&entry.reason).map_or(whole.clone(), |(short, _)| short.trim_end_matches(": ").to_owned())
        }
        _ => whole,
    }
}
