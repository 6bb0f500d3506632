//! One judged metric in words: the cells of its row and its line in the banner.

use super::baseline::{Change, MetricKey};
use super::judgement::{JudgedMetric, Rank, Severity};
use super::power::Doubt;
use super::view::{VerdictMark, anchor};
use super::width::width;
use crate::metric::{Confidence, Limit, Metric, MetricKind, PredictionInterval, Verdict};
use crate::number::{distinct_digits, four_digits, in_unit, two_digits, with_unit};
use serde_json::{Value, json};

/// The rows of a case; reasons and sources that stand in the row above are marked as repeated.
pub(super) fn rows(case: &str, metrics: &[JudgedMetric<'_>]) -> Vec<Value> {
    let mut rows: Vec<Value> = Vec::with_capacity(metrics.len());
    for judged in metrics {
        let mut row = row(case, judged);
        if let Some(above) = rows.last().filter(|above| above["metric"] == row["metric"]) {
            let repeats = |field: &str| above[field] == row[field];
            let (reason, source) = (repeats("reason"), repeats("source") && repeats("confidence"));
            row["reason_repeats"] = reason.into();
            row["source_repeats"] = source.into();
        }
        rows.push(row);
    }
    rows
}

/// A metric as a row.
pub(super) fn row(case: &str, judged: &JudgedMetric<'_>) -> Value {
    let metric = judged.metric;
    let reference = metric.reference.as_ref();
    let gate = metric.gate.as_ref();
    let (moved, change, relative_change) = change(judged);
    let expected = reference.and_then(|reference| reference.value);
    json!({
        "anchor": anchor(case, &metric.name, &metric.variant),
        "mark": VerdictMark::of(judged.severity),
        // what is known of the uncertainty, over the width of the gate
        "width": width(metric),
        "metric": metric.name,
        "variant": metric.variant.parts().map(|(key, value)| format!("{key}={}", value.text())).collect::<Vec<_>>(),
        "value": value(metric),
        "prediction": metric.prediction.as_ref().map(|found| prediction(found, &metric.unit)),
        "reference": expected.map(|value| with_unit(value, &metric.unit)).unwrap_or_default(),
        "residual": expected.map(|expected| residual(metric.value - expected, expected)),
        "source": reference.map(|reference| &reference.source),
        "confidence": reference.map(|reference| confidence(reference.confidence)),
        "kind": kind(metric.kind),
        "limit": gate.map(|gate| limit(gate.limit, &metric.unit)).unwrap_or_default(),
        "reason": reason(metric),
        "margin": gate.map(|gate| margin(metric, gate.limit)).unwrap_or_default(),
        "relative_margin": relative_margin(metric),
        // numbers to sort by: the margin's share of the limit, and the change in tolerances
        "margin_key": margin_share(metric).map(sort_key).unwrap_or_default(),
        "change_key": judged.change.in_tolerances().map(sort_key).unwrap_or_default(),
        "moved": moved,
        "change": change,
        "relative_change": relative_change,
        "note": judged.note(),
        "doubt": judged.severity.filter(|own| *own == Severity::Inconclusive).and(judged.doubt).map(Doubt::words),
    })
}

/// The interval of a prediction in words.
fn prediction(found: &PredictionInterval, unit: &str) -> Value {
    let bounds = [found.lower, found.upper].map(|bound| with_unit(bound, unit));
    let interval = format!("95 % interval {} to {}, from {} comparisons", bounds[0], bounds[1], found.comparisons);
    json!({ "interval": interval, "warnings": found.warnings })
}

/// Reason of a missing value; else that of the gate, with a remark if the spacing is too coarse for the gate to judge, and the part of a
/// run that the value leaves out.
pub(super) fn reason(metric: &Metric) -> Option<String> {
    let coarse = "not judged, because the discretisation error exceeds the width of the limit: ";
    let coarse = if metric.is_coarser_than_gate() { coarse } else { "" };
    let gate = metric.gate.as_ref().filter(|_| metric.reason_of_absence().is_none());
    let parts = gate.map(|gate| format!("{coarse}{}", gate.reason)).into_iter().chain(metric.remark.clone());
    parts.reduce(|reason, remark| format!("{reason}; {remark}"))
}

/// The value with its unit, or a word for a missing one.
fn value(metric: &Metric) -> String {
    metric.without_value().map_or_else(|| with_unit(metric.value, &metric.unit), str::to_owned)
}

/// `value limit` of a metric, for the banner.
pub(super) fn statement(judged: &JudgedMetric<'_>) -> String {
    let metric = judged.metric;
    let value = value(metric);
    match (judged.rank(), &metric.gate, &judged.change) {
        (Rank::Moved, _, Change::Moved { baseline, tolerance, .. }) => {
            let (value, was) = value_and_baseline(metric, *baseline);
            format!("{value}, baseline {was} ± {}", two_digits(*tolerance))
        }
        (Rank::Moved, _, Change::UnitChanged(unit)) => format!("{value}, baseline in {unit}"),
        (Rank::Moved, _, Change::VerdictChanged(verdict)) => format!("{value}, verdict was {}", verdict.word()),
        (_, Some(gate), _) => format!("{value}, limit {}", limit(gate.limit, &metric.unit)),
        _ => value,
    }
}

/// A value with the difference from its baseline, and the baseline: with the digits that show the difference.
pub(super) fn value_and_baseline(metric: &Metric, baseline: f64) -> (String, String) {
    let (value, was) = distinct_digits(metric.value, baseline);
    let difference = metric.value - baseline;
    let change = if difference.is_finite() { format!(" ({})", signed(difference)) } else { String::new() };
    (in_unit(&value, &metric.unit) + &change, in_unit(&was, &metric.unit))
}

/// A metric of the baseline that is gone.
pub(super) fn vanished(key: &MetricKey) -> String {
    if key.variant.is_empty() { key.metric.clone() } else { format!("{} ({})", key.metric, key.variant) }
}

pub(super) fn limit(limit: Limit, unit: &str) -> String {
    in_unit(&limit.in_words(four_digits), unit)
}

fn margin(metric: &Metric, limit: Limit) -> String {
    let margin = limit.margin(metric.value);
    if margin.is_nan() { "–".to_owned() } else { signed(margin) }
}

/// Two digits with their sign.
pub(super) fn signed(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{}", two_digits(value))
}

/// The margin as a share of the limit, how near a gate is to its edge: nothing where it does not judge or its limit has
/// no size. What is not a number lies beyond every limit.
pub(super) fn margin_share(metric: &Metric) -> Option<f64> {
    let limit = metric.gate.as_ref().filter(|_| metric.verdict() != Verdict::Observed)?.limit;
    let share = limit.margin(metric.value) / limit.half_width().abs();
    match metric.verdict() {
        Verdict::Fail if !share.is_finite() => Some(f64::NEG_INFINITY),
        _ => Some(share).filter(|share| share.is_finite()),
    }
}

fn relative_margin(metric: &Metric) -> String {
    let share = margin_share(metric).filter(|share| share.is_finite());
    share.map(|share| format!("{} % of limit", whole(100.0 * share))).unwrap_or_default()
}

/// A number that a script can read, infinite ones included.
fn sort_key(value: f64) -> String {
    format!("{:.4e}", value.clamp(-1e99, 1e99))
}

fn residual(difference: f64, expected: f64) -> String {
    // what is to be nothing is off by its value
    if !difference.is_finite() || expected == 0.0 {
        return String::new();
    }
    let share = 100.0 * difference / expected.abs();
    let relative = if share.is_finite() { format!(" ({} %)", signed(share)) } else { String::new() };
    signed(difference) + &relative
}

fn change(judged: &JudgedMetric<'_>) -> (VerdictMark, String, String) {
    let signed = |change: f64| if change.is_nan() { "no value".to_owned() } else { signed(change) };
    let relative = |change: f64, baseline: f64| {
        let share = 100.0 * change / baseline.abs();
        if share.is_finite() && change != 0.0 { format!("{} %", signed(share)) } else { String::new() }
    };
    match &judged.change {
        Change::New => (VerdictMark { word: "new", ..VerdictMark::OBSERVED }, "new".to_owned(), String::new()),
        Change::Unchanged { change, baseline, .. } => {
            (VerdictMark { word: "unchanged", ..VerdictMark::PASS }, signed(*change), relative(*change, *baseline))
        }
        Change::Moved { change, baseline, .. } => (VerdictMark::MOVED, signed(*change), relative(*change, *baseline)),
        Change::UnitChanged(unit) => (VerdictMark::MOVED, format!("unit was {unit}"), String::new()),
        Change::VerdictChanged(verdict) => {
            (VerdictMark::MOVED, format!("verdict was {}", verdict.word()), String::new())
        }
    }
}

/// A percentage: two digits, and no decimals from ten on.
pub(super) fn whole(share: f64) -> String {
    if share.abs() < 9.95 { two_digits(share) } else { format!("{share:.0}").replace('-', "−") }
}

fn kind(kind: MetricKind) -> &'static str {
    match kind {
        MetricKind::Bookkeeping => "bookkeeping",
        MetricKind::Verification => "verification",
        MetricKind::Validation => "validation",
        MetricKind::Statement => "statement of a paper",
    }
}

fn confidence(confidence: Confidence) -> &'static str {
    match confidence {
        Confidence::Exact => "exact",
        Confidence::High => "high confidence",
        Confidence::Medium => "medium confidence",
        Confidence::Low => "low confidence",
        Confidence::Unverified => "unverified: never gates",
    }
}
