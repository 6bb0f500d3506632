//! Results as a compact table for the terminal.

use crate::case::CaseResult;
use crate::metric::{Metric, PredictionInterval, Variant, Verdict};
use crate::number::{aligned_digits, in_unit};
use crate::observation::Outcome;
use crate::report::MetricKey;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// A case's metrics, one per line, what went wrong in its runs, and what is predicted.
pub fn of_case(result: &CaseResult, is_known: impl Fn(&Metric) -> bool) -> String {
    let table = table(result.metrics.iter().map(|metric| row(metric, is_known(metric))).collect());
    let is_sound = result.runs.iter().all(|run| !matches!(run.outcome, Outcome::Diverged { .. }));
    heading(result) + &table + &if is_sound { predictions(&result.metrics) } else { String::new() }
}

/// Intervals of the true values of user-defined materials, a line each.
fn predictions(metrics: &[Metric]) -> String {
    let line = |metric: &Metric| {
        let PredictionInterval { lower, upper, comparisons, unit_length, .. } = metric.prediction.as_ref()?;
        let numbers = [metric.value, *lower, *upper];
        let [value, lower, upper] = numbers.map(aligned_digits);
        let (name, value) = (&metric.name, in_unit(&value, &metric.unit));
        let in_metres = unit_length.map_or_else(String::new, |length| {
            let [value, lower, upper] = numbers.map(|number| aligned_digits(number * length));
            format!(", {value} m ({lower} … {upper} m)")
        });
        let beyond = metric.prediction.iter().flat_map(|prediction| &prediction.warnings);
        let beyond: Vec<String> = beyond.map(|warning| format!("  less certain: {warning}\n")).collect();
        Some(format!(
            "`{name}` to quote: {value} (95 %: {lower} … {upper}){in_metres}, by the errors of {comparisons} comparisons\n{}",
            beyond.concat()
        ))
    };
    metrics.iter().filter_map(line).collect::<String>() + &without_interval(metrics)
}

/// Observed values of gauges without an interval, in a line; of several runs their mean and standard deviation.
fn without_interval(metrics: &[Metric]) -> String {
    let mut of_gauge: BTreeMap<String, (Vec<f64>, &str)> = BTreeMap::new();
    for metric in metrics.iter().filter(|metric| metric.reference.is_none() && metric.prediction.is_none()) {
        if let Some(gauge) = metric.variant.get("gauge") {
            let name = format!("`{}` of {gauge}", metric.name);
            of_gauge.entry(name).or_insert_with(|| (Vec::new(), &metric.unit)).0.push(metric.value);
        }
    }
    let (single, several): (Vec<_>, Vec<_>) = of_gauge.iter().partition(|(_, (values, _))| values.len() == 1);
    let over_runs = several.iter().map(|(name, (values, unit))| {
        let count = values.len();
        let mean = values.iter().sum::<f64>() / count as f64;
        let square: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
        let deviation = (square / (count - 1) as f64).sqrt();
        format!(
            "{name} over {count} runs: {} {unit}, standard deviation {}\n",
            aligned_digits(mean),
            aligned_digits(deviation)
        )
    });
    let names: Vec<&str> = single.iter().map(|(name, _)| name.as_str()).collect();
    let line = format!("no interval for {}: vary `seed`, `spacing` and `stiffness` in a study\n", names.join(", "));
    over_runs.collect::<String>() + if names.is_empty() { "" } else { &line }
}

/// The metrics of a case whose gates do not hold; empty if all hold.
pub(super) fn failures(result: &CaseResult, is_known: impl Fn(&Metric) -> bool) -> String {
    table(result.failures().map(|metric| row(metric, is_known(metric))).collect())
}

/// Metrics of another code as a table.
pub(super) fn of_metrics<'a>(metrics: impl Iterator<Item = &'a Metric>) -> String {
    table(metrics.map(|metric| row(metric, false)).collect())
}

/// Gates of a case that are no longer judged, a line each.
pub(super) fn not_judged(case: &str, gates: &[(MetricKey, String)]) -> String {
    let line =
        |(key, reason): &(MetricKey, String)| format!("NOT JUDGED: {case} {} {}: {reason}\n", key.metric, key.variant);
    gates.iter().map(line).collect()
}

/// Metrics whose references hold for other parameters than these, in a line; empty without one.
pub(super) fn without_reference(gates: impl Iterator<Item = MetricKey>) -> String {
    let names: BTreeSet<String> = gates.map(|key| key.metric).collect();
    let names: Vec<String> = names.into_iter().collect();
    if names.is_empty() {
        String::new()
    } else {
        format!("without a reference for these parameters, so not judged: {}\n", names.join(", "))
    }
}

fn table(mut rows: Vec<[String; 7]>) -> String {
    if rows.is_empty() {
        return String::new();
    }
    rows.insert(0, ["verdict", "metric", "variant", "value", "unit", "limit", "margin"].map(str::to_owned));
    let mut text = String::new();
    let widths: [usize; 7] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    for row in rows {
        let cells: Vec<String> = row.iter().zip(widths).map(|(cell, width)| format!("{cell:width$}")).collect();
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
    }
    text
}

/// One line about a case, and one for each run that did not end as it should.
pub(super) fn heading(result: &CaseResult) -> String {
    let stored = result.runs.iter().filter(|run| run.from_store).count();
    let mut text = format!("{}, {} tier: {} runs", result.name, result.tier, result.runs.len());
    // Writing to a string cannot fail.
    if stored > 0 {
        let _ = write!(text, " ({stored} from the store)");
    }
    let _ = write!(text, ", {:.1} s of computing", result.wall_seconds());
    if let Some(time) = result.microseconds_per_particle_step() {
        let _ = write!(text, ", {time:.3} µs per particle and step");
    }
    text.push('\n');
    for run in &result.runs {
        if let Outcome::Diverged { message, expected } = &run.outcome {
            let how = if *expected { "diverged, as expected" } else { "DIVERGED" };
            let _ = writeln!(text, "{how}: {} {message}", run.variant);
        }
    }
    let mut reasons: Vec<(&Variant, &String)> = Vec::new();
    for metric in &result.metrics {
        if let Some(reason) = metric.not_steady.as_ref().filter(|reason| !reasons.contains(&(&metric.variant, *reason)))
        {
            reasons.push((&metric.variant, reason));
            let _ = writeln!(text, "{}: {reason}", metric.variant);
        }
    }
    text
}

fn row(metric: &Metric, is_known: bool) -> [String; 7] {
    let verdict = match metric.verdict() {
        Verdict::Pass => "pass",
        Verdict::Fail if is_known => "fail (known)",
        Verdict::Fail => "FAIL",
        Verdict::Observed => "observed",
    };
    // Only a limit that judges is shown, so that the line agrees with its verdict.
    let limit = metric.gate.as_ref().map(|gate| gate.limit).filter(|_| metric.verdict() != Verdict::Observed);
    [
        verdict.to_owned(),
        metric.name.clone(),
        metric.variant.to_string(),
        metric.without_value().map_or_else(|| aligned_digits(metric.value), str::to_owned),
        metric.unit.clone(),
        limit.map_or_else(String::new, |limit| limit.in_words(aligned_digits)),
        limit.map_or_else(String::new, |limit| aligned_digits(limit.margin(metric.value))),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    #[test]
    fn an_observed_metric_shows_no_limit() {
        let metric = Metric::observed("run_out", &Variant::of("a", 1), 0.5, "m");
        assert_eq!(row(&metric, false), ["observed", "run_out", "a=1", "0.5000", "m", "", ""].map(str::to_owned));
        let failed = metric.gated(Limit::AtMost(0.25), "reason");
        assert_eq!(row(&failed, false)[0], "FAIL");
        assert_eq!(row(&failed, true)[..], ["fail (known)", "run_out", "a=1", "0.5000", "m", "≤ 0.2500", "-0.2500"]);
    }
}
