//! Result of a control: the gates that reject it.

use super::Control;
use crate::metric::{Metric, Variant, Verdict};

/// Answer of a gate to a control.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// The gate fails with the wrong physics, as it must.
    Rejects,
    /// It is no longer judged, which fails a report as well.
    NotJudged,
    /// It passes, as with the right case.
    Accepts,
    /// Nothing: it fails on the right run also, or the control's run diverged.
    Nothing,
}

/// A number of the right case as the control has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Name of the metric.
    pub metric: String,
    /// Run or runs of the metric.
    pub variant: Variant,
    /// Value, in the metric's unit; NaN for one that is not measured.
    pub value: f64,
    /// Verdict of its gate; none for a metric that the control does not have.
    pub verdict: Option<Verdict>,
}

/// A control that was run.
#[derive(Debug, Clone, PartialEq)]
pub struct ControlTrial {
    /// Control that was tried.
    pub control: Control,
    /// All numbers that its runs were to give.
    pub found: Vec<Found>,
    /// Whether a run diverged unexpectedly: none of its numbers counts then.
    pub diverged: bool,
    /// The commit of the solver that it was tried at, where that is another than the program's.
    pub tried_at: Option<String>,
}

impl ControlTrial {
    /// Compares the metrics of the right case with those of the control, each beside its runs. A metric is missing where its run was done and
    /// does not give it.
    pub fn of(
        control: Control,
        (right, right_runs): (&[Metric], &[Variant]),
        (wrong, wrong_runs): (&[Metric], &[Variant]),
        diverged: bool,
    ) -> Self {
        let has_run = |variant: &Variant| variant.run_among(right_runs).is_some_and(|own| wrong_runs.contains(own));
        let found = right.iter().filter_map(|metric| {
            let is_it = |other: &&Metric| (&other.name, &other.variant) == (&metric.name, &metric.variant);
            let tried = wrong.iter().find(is_it);
            (tried.is_some() || has_run(&metric.variant)).then(|| Found::of(metric, tried))
        });
        let found = found.collect();
        Self { control, found, diverged, tried_at: None }
    }

    /// A metric of the right case as the control has it; none where the control's runs do not measure it.
    pub fn found(&self, name: &str, variant: &Variant) -> Option<&Found> {
        self.found.iter().find(|found| found.metric == name && found.variant == *variant)
    }

    /// Whether a number went with a run that diverged: it shows nothing.
    pub fn is_lost(&self, found: &Found) -> bool {
        self.diverged && !found.value.is_finite()
    }

    /// Answer of the gate of a metric of the right case; none without a gate, or where the control's runs do not measure it.
    pub fn answer(&self, right: &Metric) -> Option<Answer> {
        let found = self.found(&right.name, &right.variant)?;
        Some(match (right.verdict(), found.verdict) {
            (Verdict::Observed, _) => return None,
            (Verdict::Fail, _) => Answer::Nothing,
            _ if self.is_lost(found) => Answer::Nothing,
            (_, Some(Verdict::Pass)) => Answer::Accepts,
            (_, Some(Verdict::Fail)) => Answer::Rejects,
            (_, Some(Verdict::Observed) | None) => Answer::NotJudged,
        })
    }
}

impl Found {
    /// A metric of the right case, and the same of the control's.
    pub fn of(right: &Metric, wrong: Option<&Metric>) -> Self {
        Self {
            metric: right.name.clone(),
            variant: right.variant.clone(),
            value: wrong.map_or(f64::NAN, |metric| metric.value),
            verdict: wrong.map(Metric::verdict),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    fn front(value: f64, limit: Option<Limit>) -> Metric {
        Metric::observed("front", &Variant::of("start", 1), value, "m").gated_by(limit, "a reason")
    }

    fn trial(wrong: Option<&Metric>, diverged: bool) -> ControlTrial {
        let set = vec!["x=1".to_owned()];
        let (name, error) = ("still".to_owned(), "nothing moves".to_owned());
        let control = Control { name, error, set, ..Control::default() };
        ControlTrial { control, found: vec![Found::of(&front(0.5, None), wrong)], diverged, tried_at: None }
    }

    #[test]
    fn only_a_gate_that_holds_on_the_right_run_can_reject() {
        let limit = Some(Limit::AtLeast(0.4));
        let right = front(0.5, limit);
        assert_eq!(trial(Some(&front(0.1, limit)), false).answer(&right), Some(Answer::Rejects));
        assert_eq!(trial(Some(&front(0.6, limit)), false).answer(&right), Some(Answer::Accepts));
        assert_eq!(trial(Some(&front(0.1, None)), false).answer(&right), Some(Answer::NotJudged));
        assert_eq!(trial(None, false).answer(&right), Some(Answer::NotJudged));
        assert_eq!(trial(Some(&front(f64::NAN, limit)), true).answer(&right), Some(Answer::Nothing));
        assert_eq!(trial(None, true).answer(&right), Some(Answer::Nothing));
        assert_eq!(trial(Some(&front(0.1, limit)), true).answer(&right), Some(Answer::Rejects), "another run diverged");
        assert_eq!(trial(Some(&front(0.1, limit)), false).answer(&front(0.3, limit)), Some(Answer::Nothing));
        assert_eq!(trial(Some(&front(0.1, limit)), false).answer(&front(0.5, None)), None);
        let other = Metric { variant: Variant::of("start", 2), ..right };
        assert_eq!(trial(Some(&front(0.1, limit)), false).answer(&other), None, "not run");
    }
}
