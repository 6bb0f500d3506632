//! What became of a control: which gates reject it.

use super::Control;
use crate::case::CaseResult;
use crate::metric::{Metric, Variant, Verdict};

/// What a gate that holds says of a control.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// It fails.
    Rejects,
    /// It is no longer judged, which fails a report as well.
    NotJudged,
    /// It holds: it cannot tell this error from the right case.
    Accepts,
    /// Nothing: it fails on the right run also, or the control's run diverged.
    Nothing,
}

/// A number of the right case as the control has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Name of the metric.
    pub metric: String,
    /// Which run or runs.
    pub variant: Variant,
    /// Value, in the metric's unit; NaN for one that is not measured.
    pub value: f64,
    /// Against its gate; none for a metric that the control does not have.
    pub verdict: Option<Verdict>,
}

/// A control that was run.
#[derive(Debug, Clone, PartialEq)]
pub struct ControlTrial {
    /// The control.
    pub control: Control,
    /// All numbers that its runs were to give.
    pub found: Vec<Found>,
    /// Whether a run diverged that is not meant to: nothing of it counts.
    pub diverged: bool,
    /// The commit of the solver that it was tried at, where that is another than the program's.
    pub tried_at: Option<String>,
}

impl ControlTrial {
    /// What the metrics of the right case have become in the control's result. A metric is missing where one of the control's runs has its variant
    /// and does not give it.
    #[must_use]
    pub fn of(control: Control, right: &[Metric], wrong: &CaseResult) -> Self {
        let has_run = |variant: &Variant| wrong.runs.iter().any(|run| variant.includes(&run.variant));
        let found = right.iter().filter_map(|metric| {
            let is_it = |other: &&Metric| other.name == metric.name && other.variant == metric.variant;
            let tried = wrong.metrics.iter().find(is_it);
            (tried.is_some() || has_run(&metric.variant)).then(|| Found::of(metric, tried))
        });
        let diverged = wrong.unexpected_divergences().next().is_some();
        Self { control, found: found.collect(), diverged, tried_at: None }
    }

    /// A metric of the right case as the control has it; none where the control's runs do not measure it.
    #[must_use]
    pub fn found(&self, name: &str, variant: &Variant) -> Option<&Found> {
        self.found.iter().find(|found| found.metric == name && found.variant == *variant)
    }

    /// What the gate of a metric of the right case says; none without a gate, or where the control's runs do not measure it.
    #[must_use]
    pub fn answer(&self, right: &Metric) -> Option<Answer> {
        let found = self.found(&right.name, &right.variant)?;
        Some(match (right.verdict(), found.verdict) {
            (Verdict::Observed, _) => return None,
            (Verdict::Fail, _) => Answer::Nothing,
            _ if self.diverged => Answer::Nothing,
            (_, Some(Verdict::Pass)) => Answer::Accepts,
            (_, Some(Verdict::Fail)) => Answer::Rejects,
            (_, Some(Verdict::Observed) | None) => Answer::NotJudged,
        })
    }
}

impl Found {
    /// A metric of the right case, and the same of the control's.
    #[must_use]
    pub fn of(right: &Metric, wrong: Option<&Metric>) -> Self {
        Self {
            metric: right.name.clone(),
            variant: right.variant.clone(),
            value: wrong.map_or(f64::NAN, |metric| metric.value),
            verdict: wrong.map(Metric::verdict),
        }
    }
}
