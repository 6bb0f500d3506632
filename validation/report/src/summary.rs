//! Results as a compact table for the terminal.

use super::judgement::{JudgedCase, JudgedMetric, Rank, Severity, plural};
use super::{CaseReport, ListStatus, MetricKey};
use crate::case::RunSummary;
use crate::metric::{GateOwner, Metric, PredictionInterval, Variant, Verdict};
use crate::number::{aligned_digits, in_unit};
use crate::observation::Outcome;
use crate::statistics::mean_and_variance;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

/// Width and rows of the verdicts on a terminal.
#[derive(Debug, Clone, Copy)]
pub struct Terminal {
    /// Columns of a line.
    pub width: usize,
    /// Whether rows that pass, beside a user's own, and cases without failures are shown.
    pub is_verbose: bool,
}

impl Terminal {
    /// Lines of any length for all values.
    pub const ALL: Self = Self { width: usize::MAX, is_verbose: true };
}

/// A case's metrics, one per line, what went wrong in its runs, and what is predicted.
pub fn of_case(judged: &JudgedCase<'_>, terminal: Terminal) -> String {
    let case = judged.case;
    let is_sound = case.runs.iter().all(|run| !matches!(run.outcome, Outcome::Diverged { .. }));
    let predictions = if is_sound { predictions(&case.metrics) } else { String::new() };
    // a user asks for the verdict of a check or a measurement of their own
    let is_own = |own: &JudgedMetric<'_>| own.metric.gate_owner() == GateOwner::User;
    let is_shown = |own: &JudgedMetric<'_>| terminal.is_verbose || own.severity != Some(Severity::Pass) || is_own(own);
    let hidden = judged.metrics.iter().filter(|own| !is_shown(own)).count();
    let hidden =
        if hidden > 0 { format!("{} that pass: shown with -v\n", plural(hidden, "row")) } else { String::new() };
    let doubts = judged.metrics.iter().filter(|own| is_own(own)).filter_map(|own| Some((own.metric, own.doubt?)));
    let doubts: String =
        doubts.map(|(metric, doubt)| format!("`{}` is inconclusive: {}\n", metric.name, doubt.words())).collect();
    heading(case, terminal) + &table(rows(judged, is_shown), terminal) + &hidden + &doubts + &predictions
}

/// Diverged runs and failing gates of a case; empty for a case without failures.
pub(super) fn failures(judged: &JudgedCase<'_>, terminal: Terminal) -> String {
    let table = table(rows(judged, |judged| matches!(judged.rank(), Rank::Failing(_))), terminal);
    let is_quiet = table.is_empty() && judged.diverged.is_empty() && !terminal.is_verbose;
    if is_quiet { String::new() } else { heading(judged.case, terminal) + &table }
}

/// Rows of metrics in the order of their case.
fn rows(judged: &JudgedCase<'_>, is_shown: impl Fn(&JudgedMetric<'_>) -> bool) -> Vec<[String; 6]> {
    let mut shown: Vec<&JudgedMetric<'_>> = judged.metrics.iter().filter(|judged| is_shown(judged)).collect();
    shown.sort_by_key(|judged| std::ptr::from_ref(judged.metric));
    shown.into_iter().map(|judged| row(judged.metric, judged.severity)).collect()
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
            "`{name}` to quote: {value} (95 %: {lower} … {upper}){in_metres}, from the errors of Bagnold in {comparisons} comparisons with published results\n{}",
            beyond.concat()
        ))
    };
    metrics.iter().filter_map(line).collect::<String>() + &without_interval(metrics)
}

/// Observed values of gauges without an interval, in a line; of several runs their mean and standard deviation, also of a user's checks
/// over seeds.
fn without_interval(metrics: &[Metric]) -> String {
    let mut of_gauge: BTreeMap<String, (Vec<f64>, &str)> = BTreeMap::new();
    for metric in metrics.iter().filter(|metric| metric.value.is_finite()) {
        let is_open = metric.reference.is_none() && metric.prediction.is_none();
        let name = match metric.variant.get("gauge").filter(|_| is_open) {
            Some(gauge) => format!("`{}` of {}", metric.name, gauge.text()),
            None if metric.gate_owner() == GateOwner::User && metric.variant.get("seed").is_some() => {
                let others = metric.variant.parts().filter(|(key, _)| *key != "seed");
                let others = others.fold(Variant::default(), |others, (key, value)| others.and(key, value.clone()));
                format!("`{}` {others}", metric.name).trim_end().to_owned()
            }
            None => continue,
        };
        of_gauge.entry(name).or_insert_with(|| (Vec::new(), &metric.unit)).0.push(metric.value);
    }
    let (single, several): (Vec<_>, Vec<_>) = of_gauge.iter().partition(|(_, (values, _))| values.len() == 1);
    let over_runs = several.iter().map(|(name, (values, unit))| {
        let (mean, variance) = mean_and_variance(values.iter().copied());
        let [mean, deviation] = [mean, variance.sqrt()].map(aligned_digits);
        format!("{name} over {} runs: {mean} {unit}, standard deviation {deviation}\n", values.len())
    });
    let names: Vec<&str> = single.iter().map(|(name, _)| name.as_str()).collect();
    let line = format!("no interval for {}: vary `seed`, `spacing` and `stiffness` in a study\n", names.join(", "));
    over_runs.collect::<String>() + if names.is_empty() { "" } else { &line }
}

/// Metrics of another code as a table.
pub fn of_metrics<'a>(metrics: impl Iterator<Item = &'a Metric>, terminal: Terminal) -> String {
    let severity = |metric: &Metric| Severity::of(metric, &ListStatus::Unlisted, None);
    table(metrics.map(|metric| row(metric, severity(metric))).collect(), terminal)
}

/// Gates of a case that are no longer judged, a line each.
pub(super) fn not_judged(gates: &[(MetricKey, String)]) -> String {
    let line = |(key, reason): &(MetricKey, String)| {
        format!("NOT JUDGED: {} {} {}: {reason}\n", key.case, key.metric, key.variant)
    };
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

/// Rows under their heading; cells that do not fit into the width go on in the next line.
fn table(mut rows: Vec<[String; 6]>, terminal: Terminal) -> String {
    if rows.is_empty() {
        return String::new();
    }
    rows.insert(0, ["verdict", "metric", "value", "limit", "margin", "variant"].map(str::to_owned));
    let widths: [usize; 6] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let mut text = String::new();
    for row in rows {
        let mut line = String::new();
        for (cell, width) in row.iter().zip(widths) {
            if !line.is_empty() && line.chars().count() + cell.chars().count() > terminal.width {
                text += line.trim_end();
                line = "\n    ".to_owned();
            }
            line += &format!("{cell:width$}  ");
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}

/// Runs that were computed, with their seconds, and those from the store.
pub(super) fn runs<'r>(runs: impl Iterator<Item = &'r RunSummary>) -> String {
    let (stored, computed): (Vec<_>, Vec<_>) = runs.partition(|run| run.from_store);
    let seconds: f64 = computed.iter().map(|run| run.wall_seconds).sum();
    let computed = (!computed.is_empty()).then(|| format!("{} computed in {seconds:.1} s", computed.len()));
    let stored = (!stored.is_empty()).then(|| format!("{} from the store", stored.len()));
    computed.into_iter().chain(stored).collect::<Vec<_>>().join(", ")
}

/// One line about a case, and one for each run that did not end as it should.
fn heading(result: &CaseReport, terminal: Terminal) -> String {
    let mut text = format!("{}, {} tier, runs: {}", result.name, result.tier, runs(result.runs.iter()));
    let is_computed = result.runs.iter().any(|run| !run.from_store);
    if let Some(time) = result.microseconds_per_particle_step().filter(|_| is_computed) {
        // Writing to a string cannot fail.
        let _ = write!(text, ", {time:.3} µs per particle and step");
    }
    text.push('\n');
    for run in &result.runs {
        if let Outcome::Diverged { message, expected } = &run.outcome
            && (terminal.is_verbose || !expected)
        {
            let how = if *expected { "diverged, as expected" } else { "DIVERGED" };
            let _ = writeln!(text, "{how}: {} {message}", run.variant);
        }
    }
    let mut reasons: Vec<(&Variant, &String)> = Vec::new();
    for metric in &result.metrics {
        if let Some(reason) = metric.remark.as_ref().filter(|reason| !reasons.contains(&(&metric.variant, *reason))) {
            reasons.push((&metric.variant, reason));
            let _ = writeln!(text, "{}: {reason}", metric.variant);
        }
    }
    text
}

fn row(metric: &Metric, severity: Option<Severity>) -> [String; 6] {
    let verdict = severity.map_or("observed", Severity::word);
    // what changes the exit code is seen first
    let verdict = if severity.is_some_and(Severity::is_error) { verdict.to_uppercase() } else { verdict.to_owned() };
    // Only a limit that judges is shown, so that the line agrees with its verdict.
    let limit = metric.gate.as_ref().map(|gate| gate.limit).filter(|_| metric.verdict() != Verdict::Observed);
    [
        verdict,
        metric.name.clone(),
        metric.without_value().map_or_else(|| in_unit(&aligned_digits(metric.value), &metric.unit), str::to_owned),
        limit.map_or_else(String::new, |limit| limit.in_words(aligned_digits)),
        limit.map_or_else(String::new, |limit| aligned_digits(limit.margin(metric.value))),
        metric.variant.to_string(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    #[test]
    fn an_observed_metric_shows_no_limit() {
        let metric = Metric::observed("run_out", &Variant::of("a", 1), 0.5, "m");
        assert_eq!(row(&metric, None), ["observed", "run_out", "0.5000\u{202f}m", "", "", "a=1"].map(str::to_owned));
        let failed = metric.gated(Limit::AtMost(0.25), "reason");
        assert_eq!(row(&failed, Some(Severity::NewFailure))[0], "NEW FAILURE");
        let expected = row(&failed, Some(Severity::ExpectedFailure));
        assert_eq!(expected[..], ["expected failure", "run_out", "0.5000\u{202f}m", "≤ 0.2500", "-0.2500", "a=1"]);
    }
}
