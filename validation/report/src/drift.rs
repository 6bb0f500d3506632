//! Regressions since the baseline: the changes in tolerances, with the history of each value.

use super::Report;
use super::accepted::{Drift, MetricKey};
use super::history::History;
use super::judgement::{JudgedMetric, Judgement};
use super::rows::{value_and_baseline, vanished};
use super::view::{VerdictMark, anchor};
use crate::number::{two_digits, with_unit};
use serde_json::{Value, json};
use std::fmt;

/// Rows of the table; what has drifted is always in it.
const ROWS: usize = 25;

/// Least change that is worth a row `[tolerances]`; smaller changes are rounding noise.
const LEAST: f64 = 0.05;

/// Values of the history that a line shows.
const POINTS: usize = 24;

/// Size of a line `[px]`.
const LINE: (f64, f64) = (96.0, 20.0);

/// A value that has moved.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    /// Key of the metric.
    pub key: MetricKey,
    /// By how many tolerances `[-]`; infinite for a change of unit or verdict, and for what is gone.
    pub tolerances: f64,
    /// Whether that is a drift.
    pub has_drifted: bool,
    /// Whether it is still measured.
    is_measured: bool,
    /// Value and baseline in words.
    statement: (String, String),
    /// Earlier values, oldest first.
    history: Vec<f64>,
}

impl fmt::Display for Moved {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let MetricKey { case, metric, variant } = &self.key;
        let (value, baseline) = &self.statement;
        write!(out, "{case} {metric} [{variant}] {value}")?;
        if !baseline.is_empty() {
            write!(out, ", was {}", baseline.trim_start_matches("was "))?;
        }
        if self.tolerances.is_finite() {
            write!(out, ": {} tolerances", two_digits(self.tolerances))?;
        }
        Ok(())
    }
}

/// Everything that has moved, the farthest first, then in the order of the cases. What has drifted comes before what has
/// not.
#[must_use]
pub fn moved(judgement: &Judgement<'_>, history: &History) -> Vec<Moved> {
    let mut all = Vec::new();
    for case in &judgement.cases {
        let of_metric = |judged: &JudgedMetric<'_>| of_metric(&case.case.name, judged, history);
        all.extend(case.metrics.iter().filter_map(of_metric));
        all.extend(case.vanished.iter().map(|key| Moved {
            key: key.clone(),
            tolerances: f64::INFINITY,
            has_drifted: true,
            is_measured: false,
            statement: ("no longer measured".to_owned(), String::new()),
            history: history.of(key).to_vec(),
        }));
    }
    all.retain(|moved| moved.has_drifted || moved.tolerances >= LEAST);
    // Stable: equal ones keep the order of the page.
    all.sort_by(|a, b| b.has_drifted.cmp(&a.has_drifted).then(b.tolerances.total_cmp(&a.tolerances)));
    all
}

fn of_metric(case: &str, judged: &JudgedMetric<'_>, history: &History) -> Option<Moved> {
    let metric = judged.metric;
    let value = with_unit(metric.value, &metric.unit);
    let statement = match &judged.drift {
        Drift::New => return None,
        Drift::Unchanged { baseline, tolerance, .. } | Drift::Drifted { baseline, tolerance, .. } => {
            let (value, was) = value_and_baseline(metric, *baseline);
            (value, format!("{was} ± {}", two_digits(*tolerance)))
        }
        Drift::UnitChanged { unit } => (value, format!("in {unit}")),
        Drift::VerdictChanged { verdict } => (value, format!("{}, now {}", verdict.word(), judged.verdict.word())),
    };
    let key = MetricKey::of(case, metric);
    let history = history.of(&key).iter().copied().chain([metric.value]).filter(|value| value.is_finite());
    Some(Moved {
        tolerances: judged.drift.in_tolerances()?,
        has_drifted: judged.drift.is_failure(),
        is_measured: true,
        statement,
        history: history.collect(),
        key,
    })
}

/// The table of what has moved.
pub(super) fn table(report: &Report, judgement: &Judgement<'_>) -> Value {
    let against = match &report.against {
        Some(folder) => format!("the report in {folder}"),
        None => "the accepted values".to_owned(),
    };
    table_of(&moved(judgement, &report.history), against)
}

fn table_of(all: &[Moved], against: String) -> Value {
    let drifted = all.iter().filter(|moved| moved.has_drifted).count();
    let shown = all.len().min(ROWS.max(drifted));
    let rows: Vec<Value> = all[..shown].iter().map(row).collect();
    json!({ "against": against, "rows": rows, "omitted": all.len() - shown })
}

fn row(moved: &Moved) -> Value {
    let key = &moved.key;
    let unchanged = VerdictMark { word: "within", ..VerdictMark::PASS };
    json!({
        "mark": if moved.has_drifted { VerdictMark::DRIFT } else { unchanged },
        "case": key.case,
        "metric": key.metric,
        "variant": key.variant.to_string(),
        // the table of verdicts for what is gone
        "anchor": if moved.is_measured { anchor(&key.case, &key.metric, &key.variant) } else { "verdicts".to_owned() },
        "tolerances": if moved.tolerances.is_finite() { two_digits(moved.tolerances) } else { "–".to_owned() },
        "value": moved.statement.0,
        "baseline": moved.statement.1,
        "line": sparkline(&moved.history, &vanished(key)),
    })
}

/// The last values as a line from left to right; none for fewer than two.
fn sparkline(values: &[f64], name: &str) -> Option<Value> {
    let values = &values[values.len().saturating_sub(POINTS)..];
    let (first, last) = (values.first()?, values.last().filter(|_| values.len() > 1)?);
    let (least, most) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
    let (wide, high) = LINE;
    let margin = 2.0;
    let at = |(place, value): (usize, &f64)| {
        let x = margin + (wide - 2.0 * margin) * place as f64 / (values.len() - 1) as f64;
        // a constant runs along the middle
        let share = if most > least { (value - least) / (most - least) } else { 0.5 };
        (format!("{x:.1}"), format!("{:.1}", high - margin - (high - 2.0 * margin) * share))
    };
    let points: Vec<(String, String)> = values.iter().enumerate().map(at).collect();
    let text: Vec<String> = points.iter().map(|(x, y)| format!("{x},{y}")).collect();
    let words = format!(
        "{name}: {} values from {} to {}, between {} and {}",
        values.len(),
        two_digits(*first),
        two_digits(*last),
        two_digits(least),
        two_digits(most)
    );
    Some(json!({ "points": text.join(" "), "last": points.last()?, "size": LINE, "words": words }))
}

#[cfg(test)]
#[path = "drift_tests.rs"]
mod tests;
