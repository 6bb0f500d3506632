//! Bias and scatter of every quantity that is compared with experiments or published fits often enough.

use super::judgement::{Judgement, KINDS};
use super::view::words;
use super::{DrawnFigure, Report, with_numbers};
use crate::evidence::StatedUncertainty;
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{ComparisonPart, Metric};
use crate::number::{four_digits, two_digits};
use crate::statistics::{Comparison, ModelBias, model_bias};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Folder of the figures.
pub(super) const FOLDER: &str = "scatter";

/// Share of a decade by which the plot extends beyond its points.
const ROOM: f64 = 1.2;

/// All comparisons of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct QuantityBias {
    /// Name of the metric.
    pub quantity: String,
    /// Unit of prediction and reference.
    pub unit: String,
    /// Cases in the order of the report, each with its comparisons.
    pub cases: Vec<(String, Vec<Comparison>)>,
    /// Comparisons without a ratio: where a value is not positive.
    pub left_out: usize,
    /// Bias and scatter of all the comparisons together.
    pub found: ModelBias,
}

/// The quantities of a report with at least three comparisons, by name. Metrics of one name and unit are one quantity,
/// whatever their case; a reference that is unverified, or exact for the model, is no measurement.
pub fn quantities(report: &Report) -> Vec<QuantityBias> {
    quantities_of(report.cases.iter().map(|case| (case.name.as_str(), case.metrics.iter().collect())))
}

/// Bias of every quantity, from the metrics of these cases.
pub fn quantities_of<'a>(cases: impl IntoIterator<Item = (&'a str, Vec<&'a Metric>)>) -> Vec<QuantityBias> {
    type Group = (Vec<(String, Vec<Comparison>)>, usize);
    let mut groups: BTreeMap<(String, String), Group> = BTreeMap::new();
    for (case, metrics) in cases {
        // what is there to show what an input does is no comparison of its own
        let stated = StatedUncertainty::of(case);
        let is_own = |metric: &&Metric| !stated.is_some_and(|stated| stated.is_altered(&metric.variant));
        for (metric, compared) in
            metrics.into_iter().filter(is_own).filter_map(|metric| Some((metric, comparison(metric)?)))
        {
            let (own, left_out) = groups.entry((metric.name.clone(), metric.unit.clone())).or_default();
            if !(compared.predicted > 0.0 && compared.measured > 0.0 && compared.predicted.is_finite()) {
                *left_out += 1;
            } else if let Some((_, same)) = own.last_mut().filter(|(name, _)| *name == case) {
                same.push(compared);
            } else {
                own.push((case.to_owned(), vec![compared]));
            }
        }
    }
    let bias = |((quantity, unit), (cases, left_out)): ((String, String), Group)| {
        let all: Vec<Comparison> = cases.iter().flat_map(|(_, own)| own.iter().copied()).collect();
        model_bias(&all).map(|found| QuantityBias { quantity, unit, cases, left_out, found })
    };
    groups.into_iter().filter_map(bias).collect()
}

fn comparison(metric: &Metric) -> Option<Comparison> {
    let measured = metric.compared_with()?;
    let uncertainty = metric.uncertainty.of_part(ComparisonPart::Reference).map(|standard| standard / measured.abs());
    Some(Comparison { predicted: metric.value, measured, uncertainty })
}

/// A figure of each quantity; two of one name in different units are distinguished by a number.
pub(super) fn figures(quantities: &[QuantityBias]) -> Vec<Figure> {
    with_numbers(quantities.iter().map(figure).collect())
}

/// Predictions over references in logarithms, with the lines M = E and M = δ E and, where σ_M is known, the bands
/// δ (1 ± 2 σ_M) E.
fn figure(quantity: &QuantityBias) -> Figure {
    let unit = &quantity.unit;
    let axis = |what: &str| Axis::logarithmic(&format!("{what} {} [{unit}]", words(&quantity.quantity)));
    let all = quantity.cases.iter().flat_map(|(_, own)| own);
    let (least, most) = all.fold((f64::INFINITY, 0.0_f64), |(least, most), of| {
        (least.min(of.measured.min(of.predicted)), most.max(of.measured.max(of.predicted)))
    });
    let (least, most) = (least / ROOM, most * ROOM);
    let mut panel = Panel::new("", axis("reference").between(least, most), axis("predicted").between(least, most));
    let bias = quantity.found.bias;
    let ends = [least, most];
    let model = quantity.found.model_deviation();
    if let Some(model) = model {
        let lower = (1.0 - 2.0 * model).max(1e-3);
        panel.band("δ (1 ± 2 σ_M)", ends.map(|x| (x, lower * bias * x, (1.0 + 2.0 * model) * bias * x)));
    }
    panel.reference("prediction = reference", ends.map(|x| (x, x)));
    panel.line("δ", quantity.cases.len(), ends.map(|x| (x, bias * x)));
    for (slot, (case, own)) in quantity.cases.iter().enumerate() {
        panel.points(case, slot, own.iter().map(|of| (of.measured, of.predicted)));
    }
    let number = quantity.found.comparisons;
    let bands = if model.is_some() { "; bands: twice the model's standard deviation" } else { "" };
    let caption = format!(
        "Predictions of {} against references, {number} comparisons; mean ratio δ = {}{bands}.",
        quantity.quantity,
        two_digits(bias)
    );
    Figure::new(&quantity.quantity.replace('_', "-"), &caption, vec![panel])
}

/// The table, with the figures that were drawn of the same quantities.
pub(super) fn rows(quantities: &[QuantityBias], drawn: &[DrawnFigure]) -> Vec<Value> {
    let row = |(place, of): (usize, &QuantityBias)| {
        let found = &of.found;
        let percent = |share: f64| format!("{}\u{202f}%", two_digits(100.0 * share));
        let (model, experiment) = match (found.model_deviation(), found.experimental_deviation) {
            (Some(model), Some(experiment)) => (percent(model), percent(experiment)),
            (None, Some(experiment)) => ("within σ_E".to_owned(), percent(experiment)),
            (_, None) => ("none".to_owned(), "not known".to_owned()),
        };
        let cases: Vec<&str> = of.cases.iter().map(|(case, _)| case.as_str()).collect();
        json!({
            "quantity": of.quantity,
            "cases": cases.join(", "),
            "comparisons": found.comparisons,
            "left_out": of.left_out,
            "bias": four_digits(found.bias),
            "interval": format!("{} … {}", two_digits(found.interval.0), two_digits(found.interval.1)),
            "scatter": percent(found.scatter),
            "model": model,
            "experiment": experiment,
            "figure": drawn.get(place),
        })
    };
    quantities.iter().enumerate().map(row).collect()
}

/// Text of the report's `metrics.json`: bias of the quantities and gates by kind.
pub(super) fn json(judgement: &Judgement<'_>, quantities: &[QuantityBias]) -> String {
    let entry = |of: &QuantityBias| {
        let found = &of.found;
        json!({
            "quantity": of.quantity,
            "unit": of.unit,
            "cases": of.cases.iter().map(|(case, _)| case).collect::<Vec<_>>(),
            "comparisons": found.comparisons,
            "left_out": of.left_out,
            // δ with its 95 % interval, standard deviation of ln(M/E), σ_M and σ_E `[-]`; null for what is not known
            "bias": found.bias,
            "bias_interval": found.interval,
            "scatter": found.scatter,
            "model_deviation": found.model_deviation(),
            "experimental_deviation": found.experimental_deviation,
        })
    };
    let kinds = KINDS.map(|(kind, name)| (name.to_owned(), judgement.tally_of(kind).by_word()));
    let gates: BTreeMap<String, _> =
        kinds.into_iter().chain([("all".to_owned(), judgement.tally().by_word())]).collect();
    crate::result::pretty(&json!({
        "gates": gates,
        "values_moved": judgement.moved(),
        "quantities": quantities.iter().map(entry).collect::<Vec<_>>(),
    }))
}

#[cfg(test)]
#[path = "scatter_tests.rs"]
mod tests;
