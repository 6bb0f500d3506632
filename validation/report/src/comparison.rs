//! Comparisons with measurements after ASME V&V 20: the error E of a prediction beside the uncertainty u_val with which it is known, from the
//! spacing and repetitions (u_num), the inputs (u_input) and the reference (u_D).
//!
//! |E| ≤ u_val: the model is validated to ± u_val. Beyond it the model's own error is
//! |E| − u_val at least. What is not known is not zero: it is named, u_val is then a lower bound, and an error beyond it proves nothing
//! of the model yet.

use super::Report;
use crate::metric::{ComparisonPart, Metric};
use std::collections::BTreeMap;

/// A prediction beside a measurement or a published fit, in the metric's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison<'r> {
    /// Name of the case.
    pub case: &'r str,
    /// Metric that is compared.
    pub metric: &'r Metric,
    /// Prediction less reference.
    pub error: f64,
}

/// Statement of a comparison about the error of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ModelError {
    /// The error is within the uncertainty.
    Within(f64),
    /// The model is off by this at least.
    AtLeast(f64),
    /// The error exceeds what is known of the uncertainty by this, and a part of that is not known.
    BeyondKnown(f64),
    /// Nothing is known of the uncertainty.
    Unknown,
}

impl ModelError {
    /// Size; 0 where nothing is known.
    pub fn size(self) -> f64 {
        match self {
            Self::Within(size) | Self::AtLeast(size) | Self::BeyondKnown(size) => size,
            Self::Unknown => 0.0,
        }
    }
}

impl<'r> Comparison<'r> {
    /// The comparison that a metric is; none for a metric that is not compared with a number from outside.
    fn of(case: &'r str, metric: &'r Metric) -> Option<Self> {
        let error = metric.value - metric.compared_with()?;
        error.is_finite().then_some(Self { case, metric, error })
    }

    /// The reference, in the metric's unit.
    pub fn measured(&self) -> f64 {
        self.metric.value - self.error
    }

    /// u_val: the root of the sum of squares of what is known.
    pub fn uncertainty(&self) -> Option<f64> {
        self.metric.uncertainty.standard()
    }

    /// u_val over the size of the reference: none where the reference is 0 or nothing is
    /// known.
    pub fn level(&self) -> Option<f64> {
        self.uncertainty().map(|uncertainty| uncertainty / self.measured().abs()).filter(|level| level.is_finite())
    }

    /// Parts of the uncertainty that are unknown.
    pub fn unknown(&self) -> Vec<ComparisonPart> {
        let is_unknown = |part: &ComparisonPart| self.metric.uncertainty.of_part(*part).is_none();
        ComparisonPart::ALL.into_iter().filter(is_unknown).collect()
    }

    /// Statement of this comparison about the error of the model.
    pub fn model_error(&self) -> ModelError {
        match self.uncertainty() {
            None => ModelError::Unknown,
            Some(uncertainty) if self.error.abs() <= uncertainty => ModelError::Within(uncertainty),
            Some(uncertainty) if self.unknown().is_empty() => ModelError::AtLeast(self.error.abs() - uncertainty),
            Some(uncertainty) => ModelError::BeyondKnown(self.error.abs() - uncertainty),
        }
    }
}

/// Comparisons of one quantity: its name and unit, and each case's in the order of the report.
pub type QuantityComparisons<'r> = ((&'r str, &'r str), Vec<Comparison<'r>>);

/// All comparisons of a report, by quantity.
pub fn comparisons(report: &Report) -> Vec<QuantityComparisons<'_>> {
    let mut groups: BTreeMap<(&str, &str), Vec<Comparison<'_>>> = BTreeMap::new();
    for case in &report.cases {
        for compared in case.metrics.iter().filter_map(|metric| Comparison::of(&case.name, metric)) {
            groups.entry((&compared.metric.name, &compared.metric.unit)).or_default().push(compared);
        }
    }
    groups.into_iter().collect()
}

/// Place of a comparison's verdict: within its uncertainty, beyond it, beyond what is known of it, open.
pub(super) fn verdict(compared: &Comparison<'_>) -> usize {
    match compared.model_error() {
        ModelError::Within(_) => 0,
        ModelError::AtLeast(_) => 1,
        ModelError::BeyondKnown(_) => 2,
        ModelError::Unknown => 3,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Confidence, Limit, MetricKind, Origin, Variant};
    use crate::tests::{case, report};

    fn run_out(value: f64) -> Metric {
        Metric::observed("run_out", &Variant::default(), value, "m")
            .of_kind(MetricKind::Validation)
            .against(Some(2.0), "an experiment", Confidence::Medium)
            .gated(Limit::Within(1.0, 3.0), "a reason")
    }

    #[test]
    fn an_error_is_compared_with_what_is_known_and_the_rest_is_named() {
        let known = |value| {
            run_out(value).known_to(Origin::Repeat, Some(0.3), "seeds").known_to(
                Origin::Experiment,
                Some(0.4),
                "theirs",
            )
        };
        let metrics = vec![known(2.4), known(2.9), run_out(2.4), known(2.4).of_kind(MetricKind::Verification)];
        let report = report(vec![case("column", metrics)]);
        let found = comparisons(&report);
        assert_eq!(found.len(), 1);
        let (name, own) = &found[0];
        assert_eq!((*name, own.len()), (("run_out", "m"), 3));
        assert!(matches!(own[0].model_error(), ModelError::Within(level) if (level - 0.5).abs() < 1e-12));
        assert!(matches!(own[1].model_error(), ModelError::BeyondKnown(least) if (least - 0.4).abs() < 1e-12));
        let all = known(2.9).known_to(Origin::Input, Some(1e-9), "hardly any");
        let all = Comparison::of("column", &all).expect("a comparison").model_error();
        assert!(matches!(all, ModelError::AtLeast(least) if (least - 0.4).abs() < 1e-6), "{all:?}");
        assert_eq!(own[2].model_error(), ModelError::Unknown);
        assert!(own[0].level().is_some_and(|level| (level - 0.25).abs() < 1e-12) && own[2].level().is_none());
        assert_eq!((own[0].unknown(), own[2].unknown()), (vec![ComparisonPart::Input], ComparisonPart::ALL.to_vec()));
    }
}
