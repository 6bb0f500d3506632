//! Another code's numbers under the gates of our own: what was not given is never judged.

use super::submission::{ForeignRun, LawOrigin};
use crate::case::ExternalResult;
use crate::input::{FieldError, did_you_mean, nearest};
use crate::metric::{Metric, MetricKind, Variant, Verdict};
use std::collections::BTreeSet;

/// A metric of ours with another code's value, if it gave one.
#[derive(Debug, Clone, PartialEq)]
pub struct MetricComparison {
    /// Metric of our own run.
    pub own: Metric,
    /// The other code's, with its own gate; none where nothing was given that it follows from.
    pub foreign: Option<Metric>,
}

impl MetricComparison {
    /// Verdict on the external code; none without a value from it.
    pub fn verdict(&self) -> Option<Verdict> {
        self.foreign.as_ref().map(Metric::verdict)
    }
}

/// Numbers given for runs, each with the field that they stand in.
type Numbers<'a> = [(Variant, &'a ForeignRun, String)];

/// Our metrics with another code's values beside them, in our order. What is bookkeeping of our own runs appears only where
/// the other code gave it. Of another law no gate against exact solutions and codes of our law is asked.
///
/// # Errors
/// A single number that no metric of its run has.
pub(super) fn compare(
    own: &[Metric],
    foreign: &ExternalResult,
    numbers: &Numbers<'_>,
    law: LawOrigin,
) -> Result<Vec<MetricComparison>, FieldError> {
    let mut given = Vec::new();
    for (variant, run, field) in numbers {
        for (name, value) in &run.numbers {
            given.push((place_of(own, variant, name, field)?, *value));
        }
    }
    let compared = |(place, metric): (usize, &Metric)| {
        let same = |other: &&Metric| other.name == metric.name && other.variant == metric.variant;
        let measured =
            foreign.metrics.iter().find(same).filter(|other| foreign.is_measured(other) && !other.value.is_nan());
        let number = given.iter().find(|(own, _)| *own == place).map(|(_, value)| *value);
        let foreign = match (number, measured) {
            (Some(value), measured) => Some(Metric { value, ..measured.unwrap_or(metric).clone() }),
            (None, measured) => measured.cloned(),
        };
        let is_asked = |metric: &Metric| law == LawOrigin::Same || metric.kind != MetricKind::Verification;
        let foreign = foreign.map(|metric| if is_asked(&metric) { metric } else { Metric { gate: None, ..metric } });
        MetricComparison { own: metric.clone(), foreign }
    };
    let is_shown =
        |compared: &MetricComparison| compared.foreign.is_some() || compared.own.kind != MetricKind::Bookkeeping;
    Ok(own.iter().enumerate().map(compared).filter(is_shown).collect())
}

/// The metric of a run that a number is: of the run itself before one that has further keys.
fn place_of(own: &[Metric], variant: &Variant, name: &str, field: &str) -> Result<usize, FieldError> {
    let of_run = |metric: &Metric| metric.variant.includes(variant);
    let exact = own.iter().position(|metric| metric.name == name && metric.variant == *variant);
    let place = exact.or_else(|| own.iter().position(|metric| metric.name == name && of_run(metric)));
    place.ok_or_else(|| {
        let names: Vec<&str> = own.iter().filter(|metric| of_run(metric)).map(|metric| metric.name.as_str()).collect();
        let guess = did_you_mean(&nearest(name, names.iter().copied()));
        let listed: BTreeSet<&str> = names.iter().copied().collect();
        let listed: Vec<&str> = listed.into_iter().collect();
        let remedy = format!("{guess}this run has {}", listed.join(", "));
        FieldError::finding(&format!("{field}.numbers.{name}"), "unknown metric", &remedy)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    fn metric(name: &str, value: f64) -> Metric {
        Metric::observed(name, &Variant::of("a", 1).and("resolution", 20), value, "-")
            .gated(Limit::AtMost(1.0), "a limit")
    }

    fn foreign(metrics: Vec<Metric>, measured: Vec<&'static str>) -> ExternalResult {
        let measured = vec![(Variant::of("a", 1).and("resolution", 20), measured)];
        ExternalResult { metrics, figures: Vec::new(), tables: Vec::new(), measured }
    }

    #[test]
    fn missing_data_are_not_judged() {
        let own = [metric("front", 0.5), metric("height", 0.5), metric("noise", 0.5)];
        // the observation says 0 for what was not measured
        let theirs = foreign(
            vec![metric("front", 2.0), metric("height", f64::NAN), metric("noise", 0.0)],
            vec!["front", "height"],
        );
        let compared = compare(&own, &theirs, &[], LawOrigin::Same).expect("no numbers");
        let verdicts: Vec<Option<Verdict>> = compared.iter().map(MetricComparison::verdict).collect();
        assert_eq!(verdicts, [Some(Verdict::Fail), None, None]);
    }

    #[test]
    fn a_single_number_is_judged_and_an_unknown_one_refused() {
        let own = [metric("front", 0.5)];
        let run = |name: &str| ForeignRun {
            variant: Variant::of("a", 1),
            numbers: [(name.to_owned(), 0.25)].into(),
            particles: None,
            series: None,
            profile: None,
            coarse: None,
        };
        let theirs = foreign(Vec::new(), Vec::new());
        let of = |run: &ForeignRun| {
            compare(&own, &theirs, &[(Variant::of("a", 1), run, "run 1".to_owned())], LawOrigin::Same)
        };
        let compared = of(&run("front")).expect("a metric");
        assert_eq!((compared[0].verdict(), compared[0].own.value), (Some(Verdict::Pass), 0.5));
        assert_eq!(
            of(&run("frnt")).expect_err("no such metric").to_string(),
            "`run 1.numbers.frnt`: unknown metric; did you mean `front`? this run has front"
        );
    }

    #[test]
    fn another_law_is_not_judged_by_exact_solutions_of_ours() {
        let verified = metric("slope", 0.5).of_kind(MetricKind::Verification);
        let own = [metric("front", 0.5).of_kind(MetricKind::Validation), verified];
        let theirs =
            foreign(own.iter().map(|own| Metric { value: 2.0, ..own.clone() }).collect(), vec!["front", "slope"]);
        let verdicts = |law| -> Vec<_> {
            compare(&own, &theirs, &[], law).expect("no numbers").iter().map(MetricComparison::verdict).collect()
        };
        assert_eq!(verdicts(LawOrigin::Same), [Some(Verdict::Fail); 2]);
        assert_eq!(verdicts(LawOrigin::Grains), [Some(Verdict::Fail), Some(Verdict::Observed)]);
    }

    #[test]
    fn our_own_bookkeeping_is_left_out() {
        let own = [metric("lost", 0.0).of_kind(MetricKind::Bookkeeping), metric("front", 0.5)];
        let compared = compare(&own, &foreign(Vec::new(), Vec::new()), &[], LawOrigin::Same).expect("no numbers");
        assert_eq!(compared.iter().map(|one| one.own.name.as_str()).collect::<Vec<_>>(), ["front"]);
    }
}
