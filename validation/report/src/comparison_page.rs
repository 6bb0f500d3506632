//! The page of the comparisons with measurements: a figure of each quantity with several, and a table of all.

use super::Report;
use super::comparison::{self, Comparison, ModelError, QuantityComparisons, verdict};
use super::rows::signed;
use super::template::fill;
use super::view::{VerdictMark, anchor, words};
use crate::evidence::StatedUncertainty;
use crate::metric::{ComparisonPart, Metric, UncertaintyComponent};
use crate::number::{two_digits, with_unit};
use serde_json::{Value, json};

const NOT_KNOWN: &str = "not known";

/// Fills the template of the page; none where nothing is compared with measurements.
pub(super) fn render(report: &Report, scatter: Vec<Value>) -> Option<Result<String, minijinja::Error>> {
    let groups = comparison::comparisons(report);
    let all = || groups.iter().flat_map(|(_, own)| own);
    let count = |place: usize| all().filter(|compared| verdict(compared) == place).count();
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "within": count(0),
        "beyond": count(1),
        "partly": count(2),
        "unknown": count(3),
        "without_input": all().filter(|compared| compared.unknown().contains(&ComparisonPart::Input)).count(),
        "levels": levels(all()),
        "scatter": scatter,
        "quantities": groups.iter().map(quantity).collect::<Vec<_>>(),
    });
    (!groups.is_empty()).then(|| fill("comparisons.html", &page))
}

/// Least, middle and greatest relative u_val of the comparisons that are within their uncertainty, where the reference is not 0 `[%]`.
fn levels<'c>(all: impl Iterator<Item = &'c Comparison<'c>>) -> Option<[String; 3]> {
    let is_within = |compared: &&Comparison<'_>| matches!(compared.model_error(), ModelError::Within(_));
    let mut levels: Vec<f64> = all.filter(is_within).filter_map(Comparison::level).collect();
    levels.sort_by(f64::total_cmp);
    let of = |place: usize| Some(two_digits(100.0 * levels.get(place)?).to_string());
    Some([of(0)?, of(levels.len() / 2)?, of(levels.len().checked_sub(1)?)?])
}

fn quantity(((name, _), own): &QuantityComparisons<'_>) -> Value {
    json!({ "name": words(name), "rows": own.iter().map(row).collect::<Vec<_>>() })
}

fn row(compared: &Comparison<'_>) -> Value {
    let metric = compared.metric;
    let unit = |value: f64| with_unit(value, &metric.unit);
    let part = |value: Option<f64>| match value {
        None => NOT_KNOWN.to_owned(),
        Some(0.0) => "none".to_owned(),
        Some(value) => two_digits(value).to_string(),
    };
    let words = |part: ComparisonPart| {
        let own = metric.uncertainty.parts().iter().filter(|own| part.origins().contains(&own.origin));
        own.map(|own| format!("{}: {}", two_digits(own.standard), own.source)).collect::<Vec<_>>().join("; ")
    };
    let (look, word, statement) = match compared.model_error() {
        ModelError::Within(own) => (VerdictMark::PASS, "validated", format!("to ± {}", unit(own))),
        ModelError::AtLeast(own) => {
            (VerdictMark::EXPECTED, "model error", format!("model error of at least {}", unit(own)))
        }
        ModelError::BeyondKnown(own) => (VerdictMark::OBSERVED, "beyond what is known", format!("by {}", unit(own))),
        ModelError::Unknown => (VerdictMark::OBSERVED, "open", "unknown uncertainty".to_owned()),
    };
    let unknown = compared.unknown();
    let lower_bound = if unknown.is_empty() || unknown.len() == 3 {
        String::new()
    } else {
        let symbols: Vec<&str> = unknown.iter().map(|part| part.symbol()).collect();
        format!("; {} unknown", symbols.join(" and "))
    };
    let stated = StatedUncertainty::of(compared.case);
    let reason = |part: &ComparisonPart| {
        let reason = stated.and_then(|stated| stated.reason(*part, metric))?;
        Some(format!("{}: {reason}", part.symbol()))
    };
    let reference = metric.reference.as_ref();
    json!({
        "case": compared.case,
        "anchor": anchor(compared.case, &metric.name, &metric.variant),
        "variant": metric.variant.to_string().replace(',', ", "),
        "source": reference.map_or("", |reference| &reference.source),
        "value": unit(metric.value),
        "reference": reference.and_then(|reference| reference.value).map(unit).unwrap_or_default(),
        "error": signed(compared.error),
        // u_num, u_input and u_D, each with where it comes from
        "parts": ComparisonPart::ALL.map(|own| (part(metric.uncertainty.of_part(own)), words(own))),
        "dominant": dominant(metric),
        "uncertainty": part(compared.uncertainty()),
        // u_val over the reference
        "level": compared.level().map(|level| format!("{} %", two_digits(100.0 * level))),
        "mark": VerdictMark { word, ..look },
        "statement": statement + &lower_bound,
        "reasons": unknown.iter().filter_map(reason).collect::<Vec<_>>(),
    })
}

/// The input that most of u_input comes from.
fn dominant(metric: &Metric) -> String {
    let most = metric.uncertainty.largest(ComparisonPart::Input);
    let words = |(own, share): (&UncertaintyComponent, f64)| {
        let is_alone = share > 0.995;
        if is_alone {
            own.name().to_owned()
        } else {
            format!("{} % of u_input²: {}", two_digits(100.0 * share), own.name())
        }
    };
    most.map(words).unwrap_or_default()
}
