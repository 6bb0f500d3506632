//! Doubt about a gate: whether any control makes it fail, and the table of gates and controls of a case.

use super::CaseReport;
use super::width::share_of_gate;
use crate::control::{Answer, ControlTrial, ErrorSeries};
use crate::metric::{Metric, MetricKind, Verdict};
use serde_json::{Value, json};

/// Reason for which a gate within its limit is inconclusive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Doubt {
    /// No control of its case makes the quantity fail.
    NoControl,
    /// Two standard uncertainties of its value exceed the gate's half width.
    Uncertain,
}

impl Doubt {
    /// Doubt about the gate of a metric, by the controls of its case. The run's own account needs no control, and a variant that no
    /// control rejects is shown by another of the same quantity.
    pub(super) fn of(case: &CaseReport, metric: &Metric) -> Option<Self> {
        if metric.verdict() != Verdict::Pass {
            return None;
        }
        if share_of_gate(metric).is_some_and(|share| share > 1.0) {
            return Some(Self::Uncertain);
        }
        if case.controls.is_empty() || metric.kind == MetricKind::Bookkeeping {
            return None;
        }
        let mut of_name = case.metrics.iter().filter(|other| other.name == metric.name);
        let is_shown = of_name.any(|other| other.verdict() == Verdict::Pass && is_rejected(&case.controls, other));
        (!is_shown).then_some(Self::NoControl)
    }

    /// Short text.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::NoControl => "no negative control makes this gate fail",
            Self::Uncertain => "two standard uncertainties exceed half the width of the limit",
        }
    }
}

/// Whether a gate rejects any of these controls.
fn is_rejected(controls: &[ControlTrial], metric: &Metric) -> bool {
    let mut answers = controls.iter().filter_map(|trial| trial.answer(metric));
    answers.any(|answer| matches!(answer, Answer::Rejects | Answer::NotJudged))
}

/// Table of the negative controls of a case and the verdicts of its gates; `None` without controls.
pub(super) fn table(case: &CaseReport) -> Option<Value> {
    let (sized, controls): (Vec<_>, Vec<_>) = case.controls.iter().partition(|trial| trial.control.size().is_some());
    let mut rows: Vec<Value> = Vec::new();
    for metric in case.metrics.iter().filter(|metric| metric.kind != MetricKind::Bookkeeping) {
        if controls.iter().any(|trial| trial.answer(metric).is_some()) {
            let cells: Vec<Value> = controls.iter().map(|trial| cell(trial, metric)).collect();
            rows.push(json!({ "metric": metric.name, "variant": metric.variant.to_string(), "cells": cells }));
        }
    }
    let view = |trial: &&ControlTrial| {
        let control = &trial.control;
        json!({
            "name": control.name,
            "error": control.error,
            "command": control.command(&case.name),
            "is_solver": control.solver.is_some(),
            "note": match (&trial.tried_at, trial.diverged) {
                (_, true) => "a run diverged, so its gates are not judged".to_owned(),
                (Some(commit), _) => format!("tried at {}", crate::store::provenance::short_commit(commit)),
                _ => String::new(),
            },
            // metrics that are meant to feel it and accept it, and why
            "accepted_by": control.accepted_by.iter().map(|entry| (&entry.metric, &entry.because)).collect::<Vec<_>>(),
        })
    };
    let of_series = |series: &&ErrorSeries| {
        let factors: Vec<String> = series.factors.iter().map(|factor| format!("× {factor}")).collect();
        json!({ "parameter": series.parameter, "factors": factors.join(", ") })
    };
    let mut series: Vec<&ErrorSeries> = sized.iter().filter_map(|trial| Some(trial.control.size()?.0)).collect();
    series.dedup();
    (!case.controls.is_empty()).then(|| {
        json!({
            "controls": controls.iter().map(view).collect::<Vec<_>>(),
            "rows": rows,
            // parameters whose errors were tried in several sizes, and the gates that were tried with these
            "series": series.iter().map(of_series).collect::<Vec<_>>(),
            "sizes": sizes(case, &series, &sized),
        })
    })
}

/// The smallest error of each series that each gate of the right run rejects.
fn sizes(case: &CaseReport, series: &[&ErrorSeries], sized: &[&ControlTrial]) -> Vec<Value> {
    let metrics = case.metrics.iter().filter(|metric| metric.kind != MetricKind::Bookkeeping);
    let row = |metric: &Metric| {
        let cell = |series: &&ErrorSeries| {
            let of_series = sized
                .iter()
                .filter_map(|trial| trial.control.size().filter(|size| size.0 == *series).map(|size| (size.1, trial)));
            let answers: Vec<(f64, Answer)> =
                of_series.filter_map(|(factor, trial)| Some((factor, trial.answer(metric)?))).collect();
            let rejects = |answer: &Answer| matches!(answer, Answer::Rejects | Answer::NotJudged);
            match answers.iter().find(|(_, answer)| rejects(answer)) {
                Some((factor, _)) => ("pass", format!("× {factor}")),
                None if answers.iter().any(|(_, answer)| *answer == Answer::Accepts) => {
                    ("expected", "none of them".to_owned())
                }
                None => ("", String::new()),
            }
        };
        let cells: Vec<(&str, String)> = series.iter().map(cell).collect();
        let is_tried = cells.iter().any(|(_, words)| !words.is_empty());
        is_tried.then(|| json!({ "metric": metric.name, "variant": metric.variant.to_string(), "cells": cells }))
    };
    metrics.filter_map(row).collect()
}

/// Most controls that a panel names.
const MOST_NAMED: usize = 3;

/// Number of wrong inputs that the gates of a case reject, and the names of a few that they do not, for its panel on the first page; none
/// where no control was tried.
pub(super) fn rejected_inputs(case: &CaseReport) -> Option<String> {
    let is_rejected =
        |trial: &&ControlTrial| case.metrics.iter().any(|metric| is_rejected(std::slice::from_ref(*trial), metric));
    let named: Vec<&ControlTrial> = case.controls.iter().filter(|trial| trial.control.size().is_none()).collect();
    let escaped = named.iter().filter(|trial| !is_rejected(trial)).map(|trial| trial.control.name.as_str());
    let escaped: Vec<&str> = escaped.collect();
    let names = (1..=MOST_NAMED).contains(&escaped.len()).then(|| format!("; not rejected: {}", escaped.join(", ")));
    let (rejected, all, names) = (named.len() - escaped.len(), named.len(), names.unwrap_or_default());
    (all > 0).then(|| format!("{}: {rejected} of {all} negative controls are rejected{names}", case.name))
}

/// Cell of a gate and a control.
fn cell(trial: &ControlTrial, metric: &Metric) -> Value {
    let is_named = trial.control.is_named_by(&metric.name);
    let (class, symbol, word) = match trial.answer(metric) {
        Some(Answer::Rejects) => ("pass", "✓", "rejects"),
        Some(Answer::NotJudged) => ("pass", "✓", "not judged"),
        Some(Answer::Accepts) if is_named => ("expected", "○", "accepts"),
        Some(Answer::Accepts) => ("observed", "○", "accepts"),
        Some(Answer::Nothing) => ("observed", "–", "shows nothing"),
        None => ("observed", "", ""),
    };
    json!({ "class": class, "symbol": symbol, "word": word, "is_named": is_named })
}
