//! Power of a gate: the controls that it rejects, and the table of gates and controls of a case.

use super::CaseReport;
use super::view::{ControlCell, ControlRow, ControlView, ControlsView, SeriesView, SizeRow};
use crate::control::{Answer, ControlKind, ControlTrial, ErrorSeries};
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
    let (sized, controls): (Vec<_>, Vec<_>) = case.controls.iter().partition(|trial| trial.control.size().is_some());
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
    let mut series: Vec<&ErrorSeries> = sized.iter().filter_map(|trial| Some(trial.control.size()?.0)).collect();
    series.dedup();
    (!case.controls.is_empty()).then(|| ControlsView {
        controls: controls.iter().map(|trial| view(trial)).collect(),
        rows,
        sizes: sizes(case, &series, &sized),
        series: series.iter().map(|series| SeriesView::of(series)).collect(),
    })
}

impl SeriesView {
    fn of(series: &ErrorSeries) -> Self {
        let factors: Vec<String> = series.factors.iter().map(|factor| format!("× {factor}")).collect();
        Self { name: series.name, parameter: series.parameter, factors: factors.join(", ") }
    }
}

/// The smallest error of each series that each gate of the right run rejects.
fn sizes(case: &CaseReport, series: &[&ErrorSeries], sized: &[&ControlTrial]) -> Vec<SizeRow> {
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
                    ("known", "none of them".to_owned())
                }
                None => ("", String::new()),
            }
        };
        SizeRow {
            metric: metric.name.clone(),
            variant: metric.variant.to_string(),
            cells: series.iter().map(cell).collect(),
        }
    };
    metrics.map(row).filter(|row| row.cells.iter().any(|(_, words)| !words.is_empty())).collect()
}

/// Number of wrong inputs that the gates of a case reject, for its panel on the first page; none where no control was tried.
pub(super) fn rejected_inputs(case: &CaseReport) -> Option<String> {
    let is_rejected = |trial: &&ControlTrial| {
        let answers = case.metrics.iter().filter_map(|metric| trial.answer(metric));
        answers.into_iter().any(|answer| matches!(answer, Answer::Rejects | Answer::NotJudged))
    };
    let named = || case.controls.iter().filter(|trial| trial.control.size().is_none());
    let (all, rejected) = (named().count(), named().filter(is_rejected).count());
    (all > 0).then(|| format!("{}: {rejected} of {all} deliberate errors are rejected", case.name))
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
