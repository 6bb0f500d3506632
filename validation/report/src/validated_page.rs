//! The page of the validated space: in which regimes each quantity was compared with measurements, and what that predicts.

use super::template::fill;
use super::view::words;
use super::{CaseReport, DrawnFigure, Report};
use crate::evidence::{HeldOutDatum, HeldOutJudgement, ValidatedComparison, ValidationSet, WAY_OF_FRONT};
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Metric, REGIME_NUMBERS};
use crate::number::{four_digits, two_digits};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Folder of the figures.
pub(super) const FOLDER: &str = "validated";

/// Ratio of the ends of an interval from which its axis is logarithmic `[-]`.
const WIDE: f64 = 10.0;

/// Group of quantities that a page shows as one, with its name.
struct Group {
    name: String,
    quantities: Vec<&'static str>,
}

/// The ways of fronts together, then every quantity by itself.
fn groups(set: &'static ValidationSet) -> Vec<Group> {
    let way = Group { name: "front displacement".to_owned(), quantities: WAY_OF_FRONT.to_vec() };
    let names: BTreeSet<&str> = set.comparisons.iter().map(|row| row.quantity.as_str()).collect();
    let single = names.into_iter().filter(|name| !WAY_OF_FRONT.contains(name));
    let single = single.map(|name| Group { name: words(name), quantities: vec![name] });
    std::iter::once(way).chain(single).collect()
}

/// A figure of each quantity whose comparisons differ in a number of their regimes.
pub(super) fn figures() -> Vec<Figure> {
    let set = ValidationSet::shipped();
    groups(set).iter().filter_map(|group| figure(set, group)).collect()
}

fn figure(set: &ValidationSet, group: &Group) -> Option<Figure> {
    let names = &group.quantities;
    // what predicts nothing needs no figure
    set.bias(names)?;
    let mut panels: Vec<Panel> = (0..REGIME_NUMBERS.len()).filter_map(|number| panel(set, names, number)).collect();
    // one legend for all
    for panel in panels.iter_mut().skip(1) {
        panel.series.iter_mut().for_each(|series| series.label.clear());
        panel.bands.iter_mut().for_each(|band| band.label.clear());
    }
    let caption = format!(
        "{}: ratio of prediction and measurement, with ± u_val, over dimensionless numbers of the flow. Band: 95 % prediction interval.",
        group.name
    );
    (!panels.is_empty()).then(|| Figure::new(&group.name.replace(' ', "-"), &caption, panels))
}

/// Ratios over a number of the regime, case by case; none where all known comparisons have one value of it.
fn panel(set: &ValidationSet, names: &[&str], number: usize) -> Option<Panel> {
    let place = |row: &ValidatedComparison| row.regime().numbers()[number];
    let ends = set.ranges(names)[number].filter(|(least, most)| least < most)?;
    let unit = REGIME_NUMBERS[number];
    let x = if unit.contains('[') { Axis::linear(unit) } else { Axis::logarithmic(&format!("{unit} [-]")) };
    let interval = set.next_ratio(names);
    let is_wide = interval.is_some_and(|(least, most)| most > WIDE * least);
    let label = "prediction/measurement [-]";
    let mut panel = Panel::new("", x, if is_wide { Axis::logarithmic(label) } else { Axis::linear(label) });
    let ends = [ends.0, ends.1];
    if let Some((least, most)) = interval {
        panel.band("95 % prediction interval", ends.map(|x| (x, least, most)));
    }
    panel.reference("prediction = measurement", ends.map(|x| (x, 1.0)));
    let cases: BTreeSet<&str> = set.ratios(names).map(|(row, _)| row.case.as_str()).collect();
    for (slot, case) in cases.into_iter().enumerate() {
        let own = || set.ratios(names).filter(|(row, _)| row.case == case && place(row).is_some());
        let points = own().filter_map(|(row, ratio)| Some((place(row)?, ratio)));
        let series = panel.points(case, slot, points);
        series.error = own().map(|(row, _)| row.uncertainty.unwrap_or(0.0) / row.reference).collect();
    }
    panel.series.retain(|series| !series.points.is_empty());
    Some(panel)
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, drawn: &[DrawnFigure]) -> Result<String, minijinja::Error> {
    let set = ValidationSet::shipped();
    let view = |group: &Group| -> Value {
        let names = &group.quantities;
        let bias = set.bias(names);
        let range = |range: &Option<(f64, f64)>| match range {
            None => String::new(),
            Some((low, high)) if low == high => two_digits(*low).to_string(),
            Some((low, high)) => format!("{} … {}", two_digits(*low), two_digits(*high)),
        };
        let figure = group.name.replace(' ', "-");
        let inputs = set.input_uncertainty(names).map(|inputs| format!("{}\u{202f}%", two_digits(100.0 * inputs)));
        let interval = set.next_ratio(names);
        let interval = interval.map(|(least, most)| format!("{} … {}", two_digits(least), two_digits(most)));
        json!({
            "name": group.name,
            "comparisons": set.number(names),
            "ranges": set.ranges(names).iter().map(range).collect::<Vec<_>>(),
            "bias": bias.map(|bias| four_digits(bias.bias)).unwrap_or_default(),
            "inputs": inputs.unwrap_or_default(),
            "interval": interval.unwrap_or_default(),
            "figure": drawn.iter().find(|drawn| drawn.name == figure),
        })
    };
    let row = |case: &CaseReport, metric: &Metric| {
        let found = metric.prediction.as_ref()?;
        Some(json!({
            "case": case.name,
            "metric": metric.name,
            "variant": metric.variant.to_string(),
            "interval": format!("{} … {} {}", four_digits(found.lower), four_digits(found.upper), metric.unit),
            "warnings": found.warnings,
        }))
    };
    let predicted = |case: &CaseReport| case.metrics.iter().filter_map(|metric| row(case, metric)).collect::<Vec<_>>();
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "numbers": REGIME_NUMBERS,
        "quantities": groups(set).iter().map(view).collect::<Vec<_>>(),
        "predictions": report.cases.iter().flat_map(predicted).collect::<Vec<_>>(),
        "held_out": HeldOutJudgement::shipped().iter().map(held_out).collect::<Vec<_>>(),
    });
    fill("validated.html", &page)
}

/// A stored judgement of a calibration as the page shows it.
fn held_out((name, judgement): &(&str, HeldOutJudgement)) -> Value {
    let row = |datum: &HeldOutDatum| {
        let interval = |(low, high): (f64, f64)| format!("{} … {}", four_digits(low), four_digits(high));
        let [below, middle, above] = datum.datum;
        vec![
            datum.quantity.clone(),
            datum.unit.clone(),
            format!("{} ({})", four_digits(middle), interval((below, above))),
            four_digits(datum.model),
            datum.predicted.map(interval).unwrap_or_default(),
            two_digits(datum.deviation).to_string(),
            datum.agrees().map_or("○ inconclusive", |agrees| if agrees { "✓ agrees" } else { "✗ differs" }).to_owned(),
        ]
    };
    let sources: BTreeSet<&str> = judgement.data.iter().map(|datum| datum.source.as_str()).collect();
    json!({
        "name": name,
        "title": judgement.title,
        "sources": sources.iter().zip(1..).map(|(source, number)| format!("({number}) {source}")).collect::<Vec<_>>().join("; "),
        "sentence": judgement.in_words(),
        "parameters": judgement.parameters,
        "findings": judgement.findings.iter().map(|finding| finding.replace('`', "")).collect::<Vec<_>>(),
        "rows": judgement.data.iter().map(row).collect::<Vec<_>>(),
        "digest": judgement.digest,
        "made_by": judgement.made_by,
    })
}
