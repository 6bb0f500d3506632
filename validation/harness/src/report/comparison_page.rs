//! The page of the comparisons with measurements: a figure and a table per quantity.

use super::accepted::tier_name;
use super::comparison::{self, Comparison, ModelError, QuantityComparisons};
use super::template::fill;
use super::view::{FigureView, VerdictMark, anchor, picture};
use super::{DrawnFigure, Report};
use crate::evidence::StatedUncertainty;
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{ComparisonPart, Metric, UncertaintyComponent};
use crate::number::{two_digits, with_unit};
use serde::Serialize;

/// Folder of the figures.
pub(super) const FOLDER: &str = "comparisons";

/// Half width of a reference's dash, in rows `[-]`.
const DASH: f64 = 0.35;
/// Distance of the bar of the inputs alone from that of all, in rows `[-]`.
const BESIDE: f64 = 0.22;
/// Ratio of the largest to the least number of a quantity from which its axis is logarithmic `[-]`.
const WIDE: f64 = 20.0;

#[derive(Serialize)]
struct ComparisonPage {
    title: String,
    tier: &'static str,
    within: usize,
    beyond: usize,
    partly: usize,
    unknown: usize,
    /// Comparisons without u_input.
    without_input: usize,
    /// Least, middle and greatest level of those that are within their uncertainty `[%]`.
    levels: Option<[String; 3]>,
    quantities: Vec<QuantityView>,
}

#[derive(Serialize)]
struct QuantityView {
    name: String,
    figure: Option<FigureView>,
    rows: Vec<RowView>,
}

#[derive(Serialize)]
struct RowView {
    number: usize,
    case: String,
    anchor: String,
    variant: String,
    source: String,
    value: String,
    reference: String,
    error: String,
    /// u_num, u_input and u_D, each with where it comes from.
    parts: [(String, String); 3],
    /// The input that most of u_input comes from, with its share.
    dominant: String,
    uncertainty: String,
    /// u_val over the reference.
    level: String,
    mark: VerdictMark,
    statement: String,
    /// Why parts are not known.
    reasons: Vec<String>,
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
pub(super) fn render(report: &Report, drawn: &[DrawnFigure]) -> Option<Result<String, minijinja::Error>> {
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
        without_input: groups.iter().flat_map(|(_, own)| own).filter(|compared| compared.input.is_none()).count(),
        levels: levels(groups.iter().flat_map(|(_, own)| own)),
        quantities: groups.iter().enumerate().map(|(place, group)| quantity(group, drawn.get(place))).collect(),
    };
    (!groups.is_empty()).then(|| fill("comparisons.html", &page))
}

/// Least, middle and greatest level of the comparisons that are within their uncertainty, where the reference is not 0 `[%]`.
fn levels<'c>(all: impl Iterator<Item = &'c Comparison<'c>>) -> Option<[String; 3]> {
    let is_within = |compared: &&Comparison<'_>| matches!(compared.model_error(), ModelError::Within(_));
    let mut levels: Vec<f64> = all.filter(is_within).filter_map(Comparison::level).collect();
    levels.sort_by(f64::total_cmp);
    let of = |place: usize| Some(two_digits(100.0 * levels.get(place)?).to_string());
    Some([of(0)?, of(levels.len() / 2)?, of(levels.len().checked_sub(1)?)?])
}

/// A figure of each quantity, in the order of the page: predictions with their bars beside what they are compared with.
pub(super) fn figures(report: &Report) -> Vec<Figure> {
    let groups = comparison::comparisons(report);
    let mut figures: Vec<Figure> = groups.iter().map(figure).collect();
    for place in 1..figures.len() {
        if groups[place].0.0 == groups[place - 1].0.0 {
            figures[place].name += &format!("-{}", place + 1);
        }
    }
    figures
}

fn figure(((name, unit), own): &QuantityComparisons<'_>) -> Figure {
    let label = format!("{} [{unit}]", name.replace('_', " "));
    let reference = |compared: &Comparison<'_>| compared.metric.value - compared.error;
    let numbers = || own.iter().flat_map(|compared| [compared.metric.value, reference(compared)]);
    let (least, most) =
        numbers().fold((f64::INFINITY, 0.0_f64), |(least, most), value| (least.min(value), most.max(value)));
    let y = if least > 0.0 && most > WIDE * least { Axis::logarithmic(&label) } else { Axis::linear(&label) };
    let x = Axis::linear("row of the table [-]").between(0.0, own.len() as f64 + 1.0);
    let mut panel = Panel::new("", x, y);
    for (place, compared) in own.iter().enumerate() {
        let (row, value) = (place as f64 + 1.0, reference(compared));
        let entry = if place == 0 { "reference" } else { "" };
        panel.reference(entry, [(row - DASH, value), (row + DASH, value)]);
    }
    let mut cases: Vec<&str> = own.iter().map(|compared| compared.case).collect();
    cases.dedup();
    for (slot, case) in cases.iter().enumerate() {
        let rows = || own.iter().enumerate().filter(|(_, compared)| compared.case == *case);
        let points: Vec<(f64, f64)> =
            rows().map(|(place, compared)| (place as f64 + 1.0, compared.metric.value)).collect();
        panel.points(case, slot, points).error =
            rows().map(|(_, compared)| compared.uncertainty().unwrap_or(0.0)).collect();
    }
    let of_inputs: Vec<(f64, f64, f64)> = own
        .iter()
        .enumerate()
        .filter_map(|(place, compared)| Some((place as f64 + 1.0 + BESIDE, compared.metric.value, compared.input?)))
        .collect();
    if !of_inputs.is_empty() {
        let points = of_inputs.iter().map(|&(x, y, _)| (x, y));
        panel.points("u_input alone", cases.len(), points).error = of_inputs.iter().map(|own| own.2).collect();
    }
    let caption = format!(
        "{}: predictions with ± u_val, as far as it is known, and with ± u_input alone, beside their references, row by row of the table. A row without the second bar \
         has inputs of which nothing is known.",
        name.replace('_', " ")
    );
    Figure::new(&name.replace('_', "-"), &caption, vec![panel])
}

fn quantity(((name, _), own): &QuantityComparisons<'_>, drawn: Option<&DrawnFigure>) -> QuantityView {
    let extent = |compared: &Comparison<'_>| compared.error.abs().max(compared.uncertainty().unwrap_or(0.0));
    let widest = own.iter().map(extent).fold(0.0, f64::max);
    let rows = own.iter().enumerate().map(|(place, compared)| row(place + 1, compared, widest)).collect();
    QuantityView { name: name.replace('_', " "), figure: drawn.map(picture), rows }
}

fn row(number: usize, compared: &Comparison<'_>, widest: f64) -> RowView {
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
    let (mark, statement) = match compared.model_error() {
        ModelError::Within(level) => (
            VerdictMark { word: "validated", ..VerdictMark::PASS },
            format!("at the level {} and no finer", unit(level)),
        ),
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
        let symbols: Vec<&str> = unknown.iter().map(|part| part.symbol()).collect();
        format!("; {} not known", symbols.join(" and "))
    };
    let stated = StatedUncertainty::of(compared.case);
    let reason = |part: &ComparisonPart| {
        let reason = stated.and_then(|stated| stated.reason(*part, metric))?;
        Some(format!("{}: {reason}", part.symbol()))
    };
    let reference = metric.reference.as_ref();
    RowView {
        number,
        case: compared.case.to_owned(),
        anchor: anchor(compared.case, &metric.name, &metric.variant),
        variant: metric.variant.to_string().replace(',', ", "),
        source: reference.map(|reference| reference.source.clone()).unwrap_or_default(),
        value: unit(metric.value),
        reference: reference.and_then(|reference| reference.value).map(unit).unwrap_or_default(),
        error: format!("{}{}", if compared.error > 0.0 { "+" } else { "" }, two_digits(compared.error)),
        parts: [
            (part(compared.numerical), words(ComparisonPart::Numerical)),
            (part(compared.input), words(ComparisonPart::Input)),
            (part(compared.reference), words(ComparisonPart::Reference)),
        ],
        dominant: dominant(metric),
        uncertainty: part(compared.uncertainty()),
        level: compared.level().map(|level| format!("{} %", two_digits(100.0 * level))).unwrap_or_default(),
        mark,
        statement: statement + &lower_bound,
        reasons: unknown.iter().filter_map(reason).collect(),
        bar: bar(compared, widest),
    }
}

/// The input that most of u_input comes from.
fn dominant(metric: &Metric) -> String {
    let most = metric.uncertainty.largest(ComparisonPart::Input);
    let words = |(own, share): (&UncertaintyComponent, f64)| {
        let is_alone = share > 0.995;
        if is_alone {
            own.name().to_owned()
        } else {
            format!("{} % of its square: {}", two_digits(100.0 * share), own.name())
        }
    };
    most.map(words).unwrap_or_default()
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
