//! Stated uncertainty of comparisons that neither runs nor tables determine: `reference-data/CASE/uncertainty.toml`.
//!
//! Inputs have ranges, each with its source. They are propagated by runs at both ends of each range (`sensitivity_table`,
//! `propagation`). A spacing is propagated by a run at half of it: at first order twice the difference is left, taken for the half
//! width of an even spread. What is not known stands there with the reason.

use super::input_range::{Basis, InputRange};
use super::propagation::{by_input, by_spacing, rows_of};
use super::sensitivity_table::{SensitivityRow, sensitivity_table};
use super::shipped::carried;
use crate::metric::{ComparisonPart, Metric, Origin, Variant};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::LazyLock;

include!(concat!(env!("OUT_DIR"), "/stated_uncertainties.rs"));

/// Reason why a run that shows the effect of an input has no input uncertainty.
const ALTERED: &str = "this run shows what an input does, and is no comparison of its own";

/// The runs that propagate ranges, of the quick tier.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SensitivityRuns {
    /// Changes of all of them, `path=value`.
    pub settings: Vec<String>,
    /// Keys of the runs that are simulated; all where there are none.
    pub only: Vec<Variant>,
    /// Seeds over which results are averaged; the case's own where there are none.
    pub seeds: Vec<u64>,
}

/// A spacing that is halved.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refinement {
    /// Name of the refinement.
    pub name: String,
    /// The case with half of it, `path=value`.
    pub refined: Vec<String>,
}

/// A number that is known without runs.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StatedPart {
    /// Part of the comparison's uncertainty that the number belongs to.
    pub part: ComparisonPart,
    /// Names of the metrics; all where there are none.
    #[serde(default)]
    pub quantities: Vec<String>,
    /// Keys and values that the variants of these metrics contain.
    #[serde(default)]
    pub variant: Variant,
    /// Standard uncertainty over the reference's value, or over the metric's where that is 0 `[-]`; 0 for none.
    pub relative: Option<f64>,
    /// Standard uncertainty in the metric's unit.
    pub absolute: Option<f64>,
    /// Evidence for the number.
    pub basis: Basis,
    /// Source of the number.
    pub source: String,
}

/// Unknown part of an uncertainty, with the reason.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct UnknownPart {
    /// Part of the comparison's uncertainty that is unknown.
    pub part: ComparisonPart,
    /// Names of the metrics; all where there are none.
    #[serde(default)]
    pub quantities: Vec<String>,
    /// Keys and values that the variants of these metrics contain.
    #[serde(default)]
    pub variant: Variant,
    /// Reason why the part is unknown.
    pub reason: String,
}

/// All that a case's file states.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StatedUncertainty {
    /// The runs that propagate.
    pub runs: SensitivityRuns,
    /// Inputs with their ranges.
    #[serde(rename = "range")]
    pub ranges: Vec<InputRange>,
    /// Spacings.
    #[serde(rename = "spacing")]
    pub spacings: Vec<Refinement>,
    /// Uncertainties that are known without runs.
    #[serde(rename = "part")]
    pub parts: Vec<StatedPart>,
    /// Variants of runs that show the effect of an input and are not comparisons of their own.
    pub altered: Vec<Variant>,
    /// Unknown parts of the uncertainty, each with a reason.
    #[serde(rename = "unknown")]
    pub unknown: Vec<UnknownPart>,
}

static STATED: LazyLock<BTreeMap<&'static str, StatedUncertainty>> =
    LazyLock::new(|| carried(&FILES, "/uncertainty.toml", toml::from_str));

fn concerns(quantities: &[String], variant: &Variant, metric: &Metric) -> bool {
    let is_named = quantities.is_empty() || quantities.contains(&metric.name);
    is_named && metric.variant.includes(variant)
}

impl StatedUncertainty {
    /// Statement of a case; none where nothing is stated.
    ///
    /// # Panics
    /// If the file that the program carries is malformed, which a test would find.
    pub fn of(case: &str) -> Option<&'static Self> {
        STATED.get(case)
    }

    /// Whether a comparison belongs to a run that varies an input on purpose.
    pub fn is_altered(&self, variant: &Variant) -> bool {
        self.altered.iter().any(|other| variant.includes(other))
    }

    /// Reason why a part of a comparison's uncertainty is unknown; none if no reason is stated.
    pub fn reason(&self, part: ComparisonPart, metric: &Metric) -> Option<&str> {
        let is_it = |own: &&UnknownPart| own.part == part && concerns(&own.quantities, &own.variant, metric);
        let altered = (part == ComparisonPart::Input && self.is_altered(&metric.variant)).then_some(ALTERED);
        self.unknown.iter().find(is_it).map(|own| own.reason.as_str()).or(altered)
    }

    /// Whether a part of a comparison is stated without runs, as a number or as a reason why it is unknown.
    pub fn says(&self, part: ComparisonPart, metric: &Metric) -> bool {
        let is_stated = |own: &StatedPart| own.part == part && concerns(&own.quantities, &own.variant, metric);
        self.parts.iter().any(is_stated) || self.reason(part, metric).is_some()
    }

    /// A comparison with what is stated of it, and what the runs of `table` say. Ranges go before what the case knows of its
    /// inputs, for they are all of them; what is stated comes after what the case knows of the same part.
    fn complete(&self, mut metric: Metric, table: &[SensitivityRow]) -> Metric {
        let Some(reference) = metric.compared_with() else { return metric };
        let (own, like) = rows_of(table, &metric);
        let effect = |range: &InputRange| by_input(&own, &range.name, range.place()?);
        let effects: Vec<(&InputRange, f64)> = self
            .ranges
            .iter()
            .filter(|range| range.is_of(&metric.variant))
            .filter_map(|range| Some((range, effect(range)?)))
            .collect();
        if effects.iter().any(|(_, standard)| *standard > 0.0) {
            metric.uncertainty.forget(ComparisonPart::Input);
        }
        let is_known = ComparisonPart::ALL.map(|part| metric.uncertainty.of_part(part).is_some());
        let is_open = |part: ComparisonPart| !is_known[part as usize];
        if is_open(ComparisonPart::Input) {
            for (range, standard) in effects {
                let beside = like.map_or_else(String::new, |variant| format!("; from the runs of {variant}"));
                let words =
                    format!("{} {} ({}: {}{beside})", range.name, range.range, range.basis.word(), range.source);
                metric = metric.known_to(Origin::Input, Some(standard), &words);
            }
        }
        // what one spacing leaves says nothing of another
        if is_open(ComparisonPart::Numerical) && like.is_none() {
            for spacing in &self.spacings {
                let words = format!("twice what half of it changes: {}", spacing.name);
                metric = metric.known_to(Origin::Numerical, by_spacing(&own, &spacing.name), &words);
            }
        }
        let scale = if reference == 0.0 { metric.value.abs() } else { reference.abs() };
        for part in ComparisonPart::ALL.into_iter().filter(|part| is_open(*part)) {
            // of several the first, as the narrowest
            let is_it = |own: &&StatedPart| own.part == part && concerns(&own.quantities, &own.variant, &metric);
            let Some(own) = self.parts.iter().find(is_it).filter(|_| metric.uncertainty.of_part(part).is_none()) else {
                continue;
            };
            let origin = own.part.origins()[0];
            let standard = own.absolute.or(own.relative.map(|relative| relative * scale));
            let words = format!("{}: {}", own.basis.word(), own.source);
            match standard {
                Some(0.0) => metric.uncertainty.add_none(origin, &words),
                standard => metric.uncertainty.add(origin, standard, &words),
            }
        }
        metric
    }
}

/// The metrics of a case with all that is stated of how far they are known.
pub fn completed(case: &str, metrics: Vec<Metric>) -> Vec<Metric> {
    let Some(stated) = StatedUncertainty::of(case) else { return metrics };
    let table = sensitivity_table(case);
    metrics.into_iter().map(|metric| stated.complete(metric, table)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::RangeEnd;
    use crate::metric::{Confidence, MetricKind};

    fn compared(name: &str, value: f64) -> Metric {
        Metric::observed(name, &Variant::of("a", 1.0), value, "-").of_kind(MetricKind::Validation).against(
            Some(2.0),
            "an experiment",
            Confidence::High,
        )
    }

    fn row(input: &str, end: RangeEnd, value: f64, reference: f64) -> SensitivityRow {
        let variant = Variant::of("a", 1.0);
        SensitivityRow {
            input: input.to_owned(),
            end,
            repeat: 0,
            quantity: "run_out".to_owned(),
            variant,
            value,
            reference,
        }
    }

    const TEXT: &str = r#"
        [[range]]
        name = "friction"
        low = ["friction=0.4"]
        high = ["friction=0.6"]
        own = 0.5
        range = "0.4 to 0.6"
        basis = "assumed"
        source = "a reason"
        [[spacing]]
        name = "rows"
        refined = ["rows=40"]
        [[part]]
        part = "reference"
        quantities = ["run_out"]
        relative = 0.1
        basis = "stated"
        source = "the authors"
        [[part]]
        part = "input"
        quantities = ["height"]
        relative = 0.0
        basis = "derived"
        source = "the same inputs"
        [[unknown]]
        part = "numerical"
        quantities = ["height"]
        reason = "no study"
    "#;

    #[test]
    fn ranges_are_propagated_by_the_errors_at_both_ends() {
        let stated: StatedUncertainty = toml::from_str(TEXT).expect("a file");
        // the reference moves with the input, so that the errors differ by 0.6 − 0.2, not by 0.6
        let table = [
            row("", RangeEnd::Own, 2.1, 2.0),
            row("friction", RangeEnd::Low, 2.6, 2.2),
            row("friction", RangeEnd::High, 2.0, 2.0),
            row("rows", RangeEnd::Refined, 2.0, 2.0),
        ];
        let metric = stated.complete(compared("run_out", 2.1), &table);
        let part = |part| metric.uncertainty.of_part(part).expect("known");
        // errors of 0.4 at the lower end, 0.1 at the own value and 0 at the upper end
        assert!((part(ComparisonPart::Input) - ((0.3_f64.powi(2) + 0.1_f64.powi(2)) / 6.0).sqrt()).abs() < 1e-12);
        assert!((part(ComparisonPart::Numerical) - 0.2 / 3.0_f64.sqrt()).abs() < 1e-12);
        assert!((part(ComparisonPart::Reference) - 0.2).abs() < 1e-12);
        // what the case knows goes before what is stated, and ranges before what it knows of its inputs
        let known = compared("run_out", 2.1).known_to(Origin::Digitisation, Some(0.5), "theirs").known_to(
            Origin::Input,
            Some(9.0),
            "one of them",
        );
        let metric = stated.complete(known, &table);
        assert_eq!(metric.uncertainty.of_part(ComparisonPart::Reference), Some(0.5));
        assert!(metric.uncertainty.of_part(ComparisonPart::Input).is_some_and(|input| input < 0.2));
    }

    #[test]
    fn zero_is_stated_unknown_has_a_reason() {
        let stated: StatedUncertainty = toml::from_str(TEXT).expect("a file");
        let metric = stated.complete(compared("height", 2.1), &[]);
        let part = |part| metric.uncertainty.of_part(part);
        assert_eq!((part(ComparisonPart::Input), part(ComparisonPart::Reference)), (Some(0.0), None));
        assert_eq!(stated.reason(ComparisonPart::Numerical, &metric), Some("no study"));
        assert_eq!(stated.reason(ComparisonPart::Numerical, &compared("run_out", 2.1)), None);
        // no measurement, nothing to know
        let verified = compared("run_out", 2.1).of_kind(MetricKind::Verification);
        assert!(stated.complete(verified, &[]).uncertainty.is_empty());
    }

    #[test]
    fn every_file_is_read_and_states_its_sources() {
        assert!(STATED.len() > 5, "{} files", STATED.len());
        for (case, stated) in STATED.iter() {
            let sources = stated.ranges.iter().map(|own| &own.source).chain(stated.parts.iter().map(|own| &own.source));
            for source in sources.chain(stated.unknown.iter().map(|own| &own.reason)) {
                assert!(source.len() > 20, "{case}: {source:?} is no source");
            }
            for range in &stated.ranges {
                assert!(range.place().is_some(), "{case}: {} stands outside of its range", range.name);
            }
            for part in &stated.parts {
                assert!(part.relative.is_some() != part.absolute.is_some(), "{case}: {:?} has one number", part.part);
            }
        }
    }
}
