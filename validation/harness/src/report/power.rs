//! Power of a gate: the controls that it rejects, and the table of gates and controls of a case.

use super::CaseReport;
use super::view::{ControlCell, ControlRow, ControlView, ControlsView};
use crate::control::{Answer, ControlKind, ControlTrial};
use crate::metric::{Metric, MetricKind, Variant, Verdict};

/// Power of a gate that holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GatePower {
    /// It needs no control: it is the run's own account or no gate, or the report has no controls of its case.
    NotAsked,
    /// It rejects so many controls.
    Rejects(usize),
    /// It is no part of a control's runs; the same gate of this variant rejects some.
    By(Variant),
    /// It rejects none.
    CannotTell,
}

impl GatePower {
    /// Power of the gate of a metric, by the controls of its case.
    pub(super) fn of(case: &CaseReport, metric: &Metric) -> Self {
        if case.controls.is_empty() || metric.kind == MetricKind::Bookkeeping || metric.verdict() != Verdict::Pass {
            return Self::NotAsked;
        }
        match rejecting(&case.controls, metric) {
            0 => {
                let of_name = case.metrics.iter().filter(|other| other.name == metric.name);
                let by = of_name.filter(|other| other.verdict() == Verdict::Pass);
                let mut by = by.filter(|other| rejecting(&case.controls, other) > 0);
                by.next().map_or(Self::CannotTell, |other| Self::By(other.variant.clone()))
            }
            number => Self::Rejects(number),
        }
    }

    /// In a few words; nothing where it was not asked.
    pub(super) fn words(&self) -> String {
        match self {
            Self::NotAsked => String::new(),
            Self::Rejects(1) => "rejects 1 control".to_owned(),
            Self::Rejects(number) => format!("rejects {number} controls"),
            Self::By(variant) => format!("controls by {variant}"),
            Self::CannotTell => "cannot tell: it rejects no control".to_owned(),
        }
    }
}

/// Number of controls that a gate rejects.
fn rejecting(controls: &[ControlTrial], metric: &Metric) -> usize {
    let answers = controls.iter().filter_map(|trial| trial.answer(metric));
    answers.filter(|answer| matches!(answer, Answer::Rejects | Answer::NotJudged)).count()
}

/// The controls of a case and what its gates say of them; none where there are none.
pub(super) fn table(case: &CaseReport) -> Option<ControlsView> {
    let controls = &case.controls;
    let mut rows: Vec<ControlRow> = Vec::new();
    for metric in case.metrics.iter().filter(|metric| metric.kind != MetricKind::Bookkeeping) {
        let cells: Vec<ControlCell> = controls.iter().map(|trial| cell(trial, metric)).collect();
        if cells.iter().any(|cell| !cell.word.is_empty()) {
            rows.push(ControlRow { metric: metric.name.clone(), variant: metric.variant.to_string(), cells });
        }
    }
    let view = |trial: &ControlTrial| ControlView {
        name: trial.control.name.clone(),
        error: trial.control.error.clone(),
        command: trial.control.command(&case.name),
        is_solver: matches!(trial.control.kind, ControlKind::Solver(_)),
        note: match (&trial.tried_at, trial.diverged) {
            (_, true) => "a run diverged, whose gates show nothing".to_owned(),
            (Some(commit), _) => format!("tried at {}", crate::store::provenance::short_commit(commit)),
            _ => String::new(),
        },
        cannot_tell: trial
            .control
            .accepted_by
            .iter()
            .map(|entry| (entry.metric.clone(), entry.because.clone()))
            .collect(),
    };
    (!controls.is_empty()).then(|| ControlsView { controls: controls.iter().map(view).collect(), rows })
}

/// Number of wrong inputs that the gates of a case reject, for its panel on the first page; none where no control was tried.
pub(super) fn rejected_inputs(case: &CaseReport) -> Option<String> {
    let is_rejected = |trial: &&ControlTrial| {
        let answers = case.metrics.iter().filter_map(|metric| trial.answer(metric));
        answers.into_iter().any(|answer| matches!(answer, Answer::Rejects | Answer::NotJudged))
    };
    let (all, rejected) = (case.controls.len(), case.controls.iter().filter(is_rejected).count());
    (all > 0).then(|| format!("{}: gates reject {rejected} of {all} controls (wrong physics or input)", case.name))
}

/// Cell of a gate and a control.
fn cell(trial: &ControlTrial, metric: &Metric) -> ControlCell {
    let is_named = trial.control.is_named_by(&metric.name);
    let (class, symbol, word) = match trial.answer(metric) {
        Some(Answer::Rejects) => ("pass", "✓", "rejects"),
        Some(Answer::NotJudged) => ("pass", "✓", "not judged"),
        Some(Answer::Accepts) if is_named => ("known", "○", "cannot tell"),
        Some(Answer::Accepts) => ("observed", "○", "accepts"),
        Some(Answer::Nothing) => ("observed", "–", "shows nothing"),
        None => ("observed", "", ""),
    };
    ControlCell { class, symbol, word, is_named }
}
