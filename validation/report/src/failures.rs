//! Failures, the furthest off first, each with quantity, parameters, value, reference and limit. Why an expected failure fails stands in
//! the metric's row on the page of its case.

use super::expected_failures::ListStatus;
use super::judgement::{JudgedCase, JudgedMetric, Rank, Severity};
use super::rows::{margin_share, signed, statement};
use super::view::{VerdictMark, anchor, words};
use crate::metric::{GateOwner, Metric, Quantity, Value, Variant};
use crate::number::with_unit;
use serde_json::json;

/// Runs that diverged, then gates: unexpected failures first, the user's own gates before those of the case.
pub(super) fn of(cases: &[JudgedCase<'_>]) -> Vec<serde_json::Value> {
    let mut items: Vec<((Severity, GateOwner), f64, serde_json::Value)> = Vec::new();
    for case in cases {
        for &(variant, message) in &case.diverged {
            let item = json!({
                "mark": VerdictMark { word: "diverged", ..VerdictMark::FAIL },
                "case": case.case.name,
                "anchor": "runs",
                "what": format!("A run diverged{}", parameters(variant)),
                "metric": "",
                "description": "",
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
                "what": in_words(&judged.metric.name) + &parameters(&judged.metric.variant),
                "metric": judged.metric.name,
                "variant": judged.metric.variant.to_string(),
                "description": description(case.case.quantities, &judged.metric.name),
                "statement": statement(judged).replacen(", ", &off(judged.metric), 1),
                "note": short_note(judged),
                "distance": distance(judged.metric),
            });
            // canonical studies are judged as a user's own are, and fail no louder than cases
            let is_expected = severity == Severity::ExpectedFailure;
            let owner = if is_expected { GateOwner::Case } else { judged.metric.gate_owner() };
            items.push(((severity, owner), distance(judged.metric), item));
        }
    }
    // Stable: equal ones keep the order of the page.
    items.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    items.into_iter().map(|(.., item)| item).collect()
}

/// The failure that is the farthest beyond its limit; never of no number, whose distance JSON does not hold.
pub(super) fn weakest(items: &[serde_json::Value]) -> Option<&serde_json::Value> {
    let known = items.iter().filter_map(|item| Some((item["distance"].as_f64()?, item)));
    known.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, item)| item)
}

/// The name of a quantity in words.
fn in_words(name: &str) -> String {
    let words = words(name);
    words.chars().take(1).flat_map(char::to_uppercase).chain(words.chars().skip(1)).collect()
}

/// The parameters of a run in words, numbers with their names.
fn parameters(variant: &Variant) -> String {
    let word = |(key, value): (&str, &Value)| match value.number() {
        Some(_) => format!(", {} = {}", key.replace('_', " "), value.text()),
        None => format!(", {}", value.text()),
    };
    variant.parts().map(word).collect()
}

/// The definition of a quantity that its case declares.
fn description(quantities: &[Quantity], name: &str) -> &'static str {
    quantities.iter().find(|quantity| quantity.name == name).map_or("", |quantity| quantity.description)
}

/// How far a value is beyond its limit, as a share of the limit, as the page of all gates has it; infinite for no number.
fn distance(metric: &Metric) -> f64 {
    margin_share(metric).map_or(f64::INFINITY, |share| -share)
}

/// The reference, and the distance from it, between value and limit.
fn off(metric: &Metric) -> String {
    let reference = metric.reference.as_ref().and_then(|reference| reference.value);
    let Some(expected) = reference.filter(|value| *value != 0.0 && metric.value.is_finite()) else {
        return ", ".to_owned();
    };
    let share = 100.0 * (metric.value / expected - 1.0);
    format!("; reference {} ({} %), ", with_unit(expected, &metric.unit), signed(share))
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
