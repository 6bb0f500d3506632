//! The page of the validated space: in which regimes each quantity was compared with measurements, and what that predicts.

use super::accepted::tier_name;
use super::template::fill;
use super::view::{FigureView, picture};
use super::{CaseReport, DrawnFigure, Report};
use crate::evidence::{ValidatedComparison, ValidationSet, WAY_OF_FRONT};
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{FlowRegime, Metric, PredictionInterval, REGIME_NUMBERS};
use crate::number::{four_digits, two_digits};
use serde::Serialize;
use std::collections::BTreeSet;

/// Folder of the figures.
pub(super) const FOLDER: &str = "validated";

#[derive(Serialize)]
struct ValidatedPage {
    title: String,
    tier: &'static str,
    numbers: [&'static str; 4],
    quantities: Vec<QuantityView>,
    predictions: Vec<PredictionRow>,
}

#[derive(Serialize)]
struct QuantityView {
    name: String,
    comparisons: usize,
    ranges: Vec<String>,
    bias: String,
    inputs: String,
    interval: String,
    figure: Option<FigureView>,
}

#[derive(Serialize)]
struct PredictionRow {
    case: String,
    metric: String,
    variant: String,
    interval: String,
    warnings: Vec<String>,
}

/// What is shown as one: its name and the quantities of metrics.
struct Group {
    name: String,
    quantities: Vec<String>,
}

impl Group {
    fn names(&self) -> Vec<&str> {
        self.quantities.iter().map(String::as_str).collect()
    }
}

/// The ways of fronts together, then every quantity by itself.
fn groups(set: &ValidationSet) -> Vec<Group> {
    let way = Group { name: "way of a front".to_owned(), quantities: WAY_OF_FRONT.map(str::to_owned).to_vec() };
    let names: BTreeSet<&str> = set.comparisons.iter().map(|row| row.quantity.as_str()).collect();
    let single = names.into_iter().filter(|name| !WAY_OF_FRONT.contains(name));
    let single = single.map(|name| Group { name: name.replace('_', " "), quantities: vec![name.to_owned()] });
    std::iter::once(way).chain(single).collect()
}

/// A metric of the report's own flows that has an interval by this set.
struct Predicted<'r> {
    case: &'r str,
    metric: &'r Metric,
    found: &'r PredictionInterval,
}

fn predictions(report: &Report) -> Vec<Predicted<'_>> {
    report.cases.iter().flat_map(predictions_of).collect()
}

fn predictions_of(case: &CaseReport) -> impl Iterator<Item = Predicted<'_>> {
    let of = |metric| Some(Predicted { case: &case.name, metric, found: metric.prediction.as_ref()? });
    case.metrics.iter().filter_map(of)
}

/// A figure of each quantity whose comparisons have known regimes, with its place among the quantities.
pub(super) fn figures(report: &Report) -> Vec<Figure> {
    let set = ValidationSet::shipped();
    groups(set).iter().filter_map(|group| figure(set, group, report)).collect()
}

fn figure(set: &ValidationSet, group: &Group, report: &Report) -> Option<Figure> {
    let names = group.names();
    let rows: Vec<&ValidatedComparison> = set.of(&names).collect();
    // what predicts nothing needs no map
    set.bias(&names)?;
    let predicted = predictions(report);
    let is_own = |predicted: &&Predicted<'_>| predicted.found.quantity == names.join(", ");
    let own: Vec<FlowRegime> = predicted.iter().filter(is_own).map(|predicted| predicted.found.regime).collect();
    let axis = |place: usize| match place {
        1 => Axis::linear(REGIME_NUMBERS[place]),
        _ => Axis::logarithmic(&format!("{} [-]", REGIME_NUMBERS[place])),
    };
    let panel = |(x, y)| panel(&rows, &own, (x, y), (axis(x), axis(y)));
    let mut panels: Vec<Panel> = [(0, 1), (3, 2)].into_iter().filter_map(panel).collect();
    if panels.is_empty() {
        // streams have neither an aspect ratio nor a speed of their own
        panels.extend(panel((3, 1)));
    }
    let caption = format!("{}: regimes of the flows that were compared with measurements.", group.name);
    (!panels.is_empty()).then(|| Figure::new(&group.name.replace(' ', "-"), &caption, panels))
}

/// Comparisons by two numbers of their regimes, case by case, and the report's own flows that were predicted by them.
fn panel(
    rows: &[&ValidatedComparison],
    own: &[FlowRegime],
    (x, y): (usize, usize),
    (across, upwards): (Axis, Axis),
) -> Option<Panel> {
    let place = |regime: FlowRegime| Some((regime.numbers()[x]?, regime.numbers()[y]?));
    let mut panel = Panel::new("", across, upwards);
    let cases: BTreeSet<&str> = rows.iter().map(|row| row.case.as_str()).collect();
    for (slot, case) in cases.iter().enumerate() {
        let points: Vec<(f64, f64)> =
            rows.iter().filter(|row| row.case == *case).filter_map(|row| place(row.regime())).collect();
        if !points.is_empty() {
            panel.points(case, slot, points);
        }
    }
    let first = panel.series.first()?.points.first().copied();
    if panel.series.iter().flat_map(|series| &series.points).all(|point| Some(*point) == first) {
        return None;
    }
    let points: Vec<(f64, f64)> = own.iter().filter_map(|regime| place(*regime)).collect();
    if !points.is_empty() {
        panel.points("predicted in this report", cases.len(), points);
    }
    Some(panel)
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, drawn: &[DrawnFigure]) -> Result<String, minijinja::Error> {
    let set = ValidationSet::shipped();
    let view = |group: &Group| {
        let names = group.names();
        let bias = set.bias(&names);
        let range = |range: &Option<(f64, f64)>| match range {
            None => "not known".to_owned(),
            Some((low, high)) if low == high => two_digits(*low).to_string(),
            Some((low, high)) => format!("{} … {}", two_digits(*low), two_digits(*high)),
        };
        let figure = group.name.replace(' ', "-");
        QuantityView {
            name: group.name.clone(),
            comparisons: set.number(&names),
            ranges: set.ranges(&names).iter().map(range).collect(),
            bias: bias.map_or_else(|| "none".to_owned(), |bias| four_digits(bias.bias).to_string()),
            inputs: set
                .input_uncertainty(&names)
                .map_or_else(|| "not known".to_owned(), |inputs| format!("{}\u{202f}%", two_digits(100.0 * inputs))),
            interval: set.next_ratio(&names).map_or_else(
                || "none".to_owned(),
                |(least, most)| format!("{} … {}", two_digits(least), two_digits(most)),
            ),
            figure: drawn.iter().find(|drawn| drawn.name == figure).map(picture),
        }
    };
    let row = |Predicted { case, metric, found }: &Predicted<'_>| PredictionRow {
        case: (*case).to_owned(),
        metric: metric.name.clone(),
        variant: metric.variant.to_string(),
        interval: format!("{} … {} {}", four_digits(found.lower), four_digits(found.upper), metric.unit),
        warnings: found.warnings.clone(),
    };
    let page = ValidatedPage {
        title: report.title.clone(),
        tier: tier_name(report.tier),
        numbers: REGIME_NUMBERS,
        quantities: groups(set).iter().map(view).collect(),
        predictions: predictions(report).iter().map(row).collect(),
    };
    fill("validated.html", &page)
}
