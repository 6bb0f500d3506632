//! The page of the comparisons with measurements: a table and bars per quantity.

use super::Report;
use super::accepted::tier_name;
use super::comparison::{self, Comparison, ModelError};
use super::template::fill;
use super::view::{VerdictMark, anchor};
use crate::number::{two_digits, with_unit};
use serde::Serialize;

#[derive(Serialize)]
struct ComparisonPage {
    title: String,
    tier: &'static str,
    within: usize,
    beyond: usize,
    partly: usize,
    unknown: usize,
    quantities: Vec<QuantityView>,
}

#[derive(Serialize)]
struct QuantityView {
    name: String,
    rows: Vec<RowView>,
}

#[derive(Serialize)]
struct RowView {
    case: String,
    anchor: String,
    variant: String,
    source: String,
    value: String,
    reference: String,
    error: String,
    numerical: String,
    input: String,
    reference_uncertainty: String,
    uncertainty: String,
    mark: VerdictMark,
    statement: String,
    bar: BarView,
}

/// E as a point and ± u_val as a bar, on the scale of the quantity.
#[derive(Serialize)]
struct BarView {
    point: String,
    left: String,
    width: String,
    words: String,
}

/// Half of the length of a bar `[px]`.
const HALF: f64 = 90.0;

const NOT_KNOWN: &str = "not known";

/// Fills the template of the page; none where nothing is compared with measurements.
pub(super) fn render(report: &Report) -> Option<Result<String, minijinja::Error>> {
    let groups = comparison::comparisons(report);
    let count = |is_it: fn(ModelError) -> bool| {
        groups.iter().flat_map(|(_, own)| own).filter(|compared| is_it(compared.model_error())).count()
    };
    let page = ComparisonPage {
        title: report.title.clone(),
        tier: tier_name(report.tier),
        within: count(|error| matches!(error, ModelError::Within(_))),
        beyond: count(|error| matches!(error, ModelError::AtLeast(_))),
        partly: count(|error| matches!(error, ModelError::BeyondKnown(_))),
        unknown: count(|error| error == ModelError::Unknown),
        quantities: groups.iter().map(|((name, _), own)| quantity(name, own)).collect(),
    };
    (!groups.is_empty()).then(|| fill("comparisons.html", &page))
}

fn quantity(name: &str, own: &[Comparison<'_>]) -> QuantityView {
    let extent = |compared: &Comparison<'_>| compared.error.abs().max(compared.uncertainty().unwrap_or(0.0));
    let widest = own.iter().map(extent).fold(0.0, f64::max);
    QuantityView { name: name.replace('_', " "), rows: own.iter().map(|compared| row(compared, widest)).collect() }
}

fn row(compared: &Comparison<'_>, widest: f64) -> RowView {
    let metric = compared.metric;
    let unit = |value: f64| with_unit(value, &metric.unit);
    let part = |value: Option<f64>| value.map_or_else(|| NOT_KNOWN.to_owned(), |value| two_digits(value).to_string());
    let (mark, statement) = match compared.model_error() {
        ModelError::Within(level) => {
            (VerdictMark { word: "validated", ..VerdictMark::PASS }, format!("validated at the level {}", unit(level)))
        }
        ModelError::AtLeast(least) => (
            VerdictMark { word: "model error", ..VerdictMark::KNOWN },
            format!("model error of at least {}", unit(least)),
        ),
        ModelError::BeyondKnown(by) => {
            let mark = VerdictMark { word: "beyond what is known", ..VerdictMark::OBSERVED };
            (mark, format!("by {}", unit(by)))
        }
        ModelError::Unknown => {
            (VerdictMark { word: "open", ..VerdictMark::OBSERVED }, "no uncertainty is known".to_owned())
        }
    };
    let unknown = compared.unknown();
    let lower_bound = if unknown.is_empty() || unknown.len() == 3 {
        String::new()
    } else {
        format!("; {} not known", unknown.join(" and "))
    };
    let reference = metric.reference.as_ref();
    RowView {
        case: compared.case.to_owned(),
        anchor: anchor(compared.case, &metric.name, &metric.variant),
        variant: metric.variant.to_string().replace(',', ", "),
        source: reference.map(|reference| reference.source.clone()).unwrap_or_default(),
        value: unit(metric.value),
        reference: reference.and_then(|reference| reference.value).map(unit).unwrap_or_default(),
        error: format!("{}{}", if compared.error > 0.0 { "+" } else { "" }, two_digits(compared.error)),
        numerical: part(compared.numerical),
        input: part(compared.input),
        reference_uncertainty: part(compared.reference),
        uncertainty: part(compared.uncertainty()),
        mark,
        statement: statement + &lower_bound,
        bar: bar(compared, widest),
    }
}

fn bar(compared: &Comparison<'_>, widest: f64) -> BarView {
    let scale = if widest > 0.0 { HALF / widest } else { 0.0 };
    let half = scale * compared.uncertainty().unwrap_or(0.0);
    let unit = |value: f64| with_unit(value, &compared.metric.unit);
    let words = match compared.uncertainty() {
        Some(uncertainty) => format!("E = {}, u_val = {}", unit(compared.error), unit(uncertainty)),
        None => format!("E = {}, u_val not known", unit(compared.error)),
    };
    BarView {
        point: format!("{:.1}", HALF + 6.0 + scale * compared.error),
        left: format!("{:.1}", HALF + 6.0 - half),
        width: format!("{:.1}", 2.0 * half),
        words,
    }
}
