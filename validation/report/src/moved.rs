//! Changes from the baseline, in tolerances.

use super::baseline::{Baseline, Change, MetricKey};
use super::judgement::{JudgedMetric, Judgement, Severity};
use super::rows::{limit, value_and_baseline};
use super::view::{VerdictMark, anchor};
use crate::number::{two_digits, with_unit};
use serde_json::{Value, json};
use std::fmt;

/// Rows of the table; what has moved beyond its tolerance is always in it.
const ROWS: usize = 25;

/// Least change that is worth a row `[tolerances]`; smaller changes are rounding noise.
const LEAST: f64 = 0.05;

/// A value that differs from its baseline.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct MovedValue {
    /// Key of the metric.
    pub(super) key: MetricKey,
    /// Change in tolerances `[-]`; infinite for a change of unit or verdict, and for missing values.
    pub(super) tolerances: f64,
    /// Whether it has moved beyond its tolerance.
    pub(super) is_beyond: bool,
    /// Severity and limit of its gate now; nothing where it is no longer measured.
    now: Option<(Option<Severity>, String)>,
    /// Value and baseline in words.
    statement: (String, String),
    /// Commit at which the baseline was made; empty where it is not known.
    commit: String,
}

impl fmt::Display for MovedValue {
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

/// Every change: gates that fail first, then what has moved beyond its tolerance, then the farthest.
pub(super) fn moved(judgement: &Judgement<'_>) -> Vec<MovedValue> {
    let baseline = &judgement.report.baseline;
    let mut all = Vec::new();
    for case in &judgement.cases {
        let of_metric = |judged: &JudgedMetric<'_>| of_metric(&case.case.name, judged, baseline);
        all.extend(case.metrics.iter().filter_map(of_metric));
        all.extend(case.vanished.iter().map(|key| MovedValue {
            key: key.clone(),
            tolerances: f64::INFINITY,
            is_beyond: true,
            now: None,
            statement: ("no longer measured".to_owned(), String::new()),
            commit: baseline.commit(&key.case),
        }));
    }
    all.retain(|moved| moved.is_beyond || moved.tolerances >= LEAST);
    // Stable: equal ones keep the order of the page.
    let is_new_failure = |moved: &MovedValue| matches!(&moved.now, Some((Some(severity), _)) if severity.is_error());
    let order = |a: &MovedValue, b: &MovedValue| {
        let states = (b.is_beyond, is_new_failure(b)).cmp(&(a.is_beyond, is_new_failure(a)));
        states.then(b.tolerances.total_cmp(&a.tolerances))
    };
    all.sort_by(order);
    all
}

fn of_metric(case: &str, judged: &JudgedMetric<'_>, baseline: &Baseline) -> Option<MovedValue> {
    let metric = judged.metric;
    let value = with_unit(metric.value, &metric.unit);
    let statement = match &judged.change {
        Change::New => return None,
        Change::Unchanged { baseline, tolerance, .. } | Change::Moved { baseline, tolerance, .. } => {
            let (value, was) = value_and_baseline(metric, *baseline);
            (value, format!("{was} ± {}", two_digits(*tolerance)))
        }
        Change::UnitChanged(unit) => (value, format!("in {unit}")),
        Change::VerdictChanged(verdict) => (value, format!("{}, now {}", verdict.word(), metric.verdict().word())),
    };
    Some(MovedValue {
        tolerances: judged.change.in_tolerances()?,
        is_beyond: judged.change.has_moved(),
        now: Some((
            judged.severity,
            metric.gate.as_ref().map(|gate| limit(gate.limit, &metric.unit)).unwrap_or_default(),
        )),
        statement,
        commit: baseline.commit(case),
        key: MetricKey::of(case, metric),
    })
}

/// Table of the values that moved from the baseline.
pub(super) fn table(judgement: &Judgement<'_>) -> Value {
    let against = judgement.report.against.as_ref();
    let against = against.map_or_else(|| "the baseline".to_owned(), |folder| format!("the report in {folder}"));
    let all = moved(judgement);
    let beyond = all.iter().filter(|moved| moved.is_beyond).count();
    let shown = all.len().min(ROWS.max(beyond));
    let rows: Vec<Value> = all[..shown].iter().map(row).collect();
    json!({ "against": against, "rows": rows, "beyond": beyond, "omitted": all.len() - shown })
}

fn row(moved: &MovedValue) -> Value {
    let key = &moved.key;
    let (verdict, limit) = match &moved.now {
        Some((severity, limit)) => (VerdictMark::of(*severity), limit.as_str()),
        None => (VerdictMark::NOT_JUDGED, ""),
    };
    json!({
        "mark": verdict,
        "case": key.case,
        "metric": key.metric,
        "variant": key.variant.to_string(),
        // the table of verdicts for what is gone
        "anchor": if moved.now.is_some() { anchor(&key.case, &key.metric, &key.variant) } else { "verdicts".to_owned() },
        "tolerances": if moved.tolerances.is_finite() { two_digits(moved.tolerances) } else { "–".to_owned() },
        "value": moved.statement.0,
        "baseline": moved.statement.1,
        "limit": limit,
        "commit": moved.commit,
    })
}

#[cfg(test)]
#[path = "moved_tests.rs"]
mod tests;
