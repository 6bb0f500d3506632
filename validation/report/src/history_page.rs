//! The page of the history: small plots of value, bias and speed over the commits at which the baseline was taken.

use super::accepted::MetricKey;
use super::judgement::{JudgedMetric, Judgement};
use super::rows::limit;
use super::template::fill;
use super::view::anchor;
use super::{History, Report};
use crate::metric::{Limit, Metric};
use crate::number::{four_digits, two_digits, with_unit};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Size of a small plot `[px]`.
const WIDTH: f64 = 168.0;
const HEIGHT: f64 = 30.0;
/// Room at its edges for a point `[px]`.
const EDGE: f64 = 3.0;
/// Fewest values that make a trend.
const FEWEST: usize = 2;
/// Share of the range of a plot's values by which a limit may lie outside of it and is still drawn `[-]`.
const NEAR: f64 = 1.5;

/// A line through values over time, and lines that it is held against; places in `[px]`. The plot of values over times from 0 to `end`, with marks where they lie near.
fn plot(series: &[(usize, f64)], end: usize, marks: &[f64]) -> Value {
    let values = || series.iter().map(|point| point.1).filter(|value| value.is_finite());
    let (least, most) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let scale = (most - least).max(1e-3 * least.abs().max(most.abs())).max(f64::MIN_POSITIVE);
    let near: Vec<f64> =
        marks.iter().copied().filter(|mark| *mark >= least - NEAR * scale && *mark <= most + NEAR * scale).collect();
    let (low, high) = near.iter().fold((least, most), |(low, high), mark| (low.min(*mark), high.max(*mark)));
    let range = (high - low).max(scale);
    let across = |time: usize| EDGE + (WIDTH - 2.0 * EDGE) * time as f64 / end.max(1) as f64;
    let upwards = |value: f64| HEIGHT - EDGE - (HEIGHT - 2.0 * EDGE) * (value - low) / range;
    let place = |(time, value): &(usize, f64)| (format!("{:.1}", across(*time)), format!("{:.1}", upwards(*value)));
    let places: Vec<(String, String)> = series.iter().filter(|point| point.1.is_finite()).map(place).collect();
    json!({
        "points": places.iter().map(|(x, y)| format!("{x},{y}")).collect::<Vec<_>>().join(" "),
        "last": places.last().cloned().unwrap_or_default(),
        "marks": near.iter().map(|mark| format!("{:.1}", upwards(*mark))).collect::<Vec<_>>(),
        "words": format!("{} values from {} to {}", places.len(), two_digits(least), two_digits(most)),
    })
}

fn bounds(limit: Limit) -> Vec<f64> {
    match limit {
        Limit::AtMost(bound) | Limit::AtLeast(bound) => vec![bound],
        Limit::Within(lower, upper) => vec![lower, upper],
    }
}

/// A gate over time; none of fewer than two values, or where they have not moved by their own tolerance.
fn of_gate(history: &History, case: &str, judged: &JudgedMetric<'_>) -> Option<Value> {
    let metric = judged.metric;
    let series = history.series(&MetricKey::of(case, metric));
    if series.len() < FEWEST {
        return None;
    }
    let unit = |value: f64| with_unit(value, &metric.unit);
    let gate = metric.gate.as_ref()?;
    Some(json!({
        "what": metric.name,
        "variant": metric.variant.to_string().replace(',', ", "),
        "anchor": format!("cases/{case}/index.html#{}", anchor(case, &metric.name, &metric.variant)),
        "first": unit(series[0].1),
        "last": unit(series[series.len() - 1].1),
        "limit": limit(gate.limit, &metric.unit),
        "plot": plot(&series, history.commits().len().saturating_sub(1), &bounds(gate.limit)),
    }))
}

/// Whether a gate's values have moved by more than the tolerance of its accepted value.
fn has_moved(history: &History, case: &str, metric: &Metric) -> bool {
    let values = history.of(&MetricKey::of(case, metric));
    let Some(last) = values.last() else { return false };
    let tolerance = (metric.snapshot_tolerance * last.abs()).max(metric.snapshot_floor);
    values.iter().any(|value| (value - last).abs() > tolerance)
}

/// Bias of every quantity that is gated against measurements: the geometric mean of prediction over today's reference, over all of
/// its gates with their values of that time.
fn biases(report: &Report) -> Vec<Value> {
    let history = &report.history;
    type Ratios = Vec<Vec<(usize, f64)>>;
    let mut quantities: BTreeMap<&str, Ratios> = BTreeMap::new();
    for case in &report.cases {
        for metric in &case.metrics {
            let Some(reference) = metric.compared_with().filter(|reference| *reference > 0.0) else { continue };
            let series = history.series(&MetricKey::of(&case.name, metric)).into_iter();
            let ratios: Vec<(usize, f64)> = series
                .filter(|(_, value)| *value > 0.0)
                .map(|(time, value)| (time, libm::log(value / reference)))
                .collect();
            if !ratios.is_empty() {
                quantities.entry(&metric.name).or_default().push(ratios);
            }
        }
    }
    let last = history.commits().len().saturating_sub(1);
    let of_quantity = |(name, ratios): (&str, Ratios)| {
        let at = |time: usize| {
            // before a gate came it counts with its first value: a line moves where values do
            let of_time = |series: &Vec<(usize, f64)>| {
                series.iter().rev().find(|(own, _)| *own <= time).or(series.first()).map_or(0.0, |point| point.1)
            };
            (time, libm::exp(ratios.iter().map(of_time).sum::<f64>() / ratios.len() as f64))
        };
        let first = ratios.iter().filter_map(|series| series.first()).map(|point| point.0).min().unwrap_or(0);
        let series: Vec<(usize, f64)> = (first..=last).map(at).collect();
        (series.len() >= FEWEST).then(|| {
            json!({
                "what": name.replace('_', " "),
                "variant": format!("{} gates", ratios.len()),
                "anchor": "comparisons.html",
                "first": four_digits(series[0].1),
                "last": four_digits(series[series.len() - 1].1),
                "limit": "1",
                "plot": plot(&series, last, &[1.0]),
            })
        })
    };
    quantities.into_iter().filter_map(of_quantity).collect()
}

fn speeds(report: &Report) -> Vec<Value> {
    let of_case = |case: &super::CaseReport| {
        let values = report.speeds.of(&case.name);
        let series: Vec<(usize, f64)> = values.iter().copied().enumerate().collect();
        let (first, last) = (values.first()?, values.last()?);
        Some(json!({
            "what": case.name,
            "anchor": format!("cases/{}/index.html#runs", case.name),
            "first": format!("{} µs", two_digits(*first)),
            "last": format!("{} µs", two_digits(*last)),
            "plot": plot(&series, series.len().saturating_sub(1), &[]),
        }))
    };
    report.cases.iter().filter_map(of_case).collect()
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, judgement: &Judgement<'_>) -> Result<String, minijinja::Error> {
    let of_case = |case: &super::CaseReport| {
        let judged = judgement.cases.iter().find(|judged| std::ptr::eq(judged.case, case));
        let metrics = judged.map_or(&[][..], |judged| &judged.metrics);
        let (moved, steady): (Vec<&JudgedMetric<'_>>, Vec<&JudgedMetric<'_>>) =
            metrics.iter().partition(|judged| has_moved(&report.history, &case.name, judged.metric));
        let rows: Vec<Value> =
            moved.into_iter().filter_map(|judged| of_gate(&report.history, &case.name, judged)).collect();
        let is_gate = |judged: &&&JudgedMetric<'_>| of_gate(&report.history, &case.name, judged).is_some();
        json!({ "name": case.name, "rows": rows, "steady": steady.iter().filter(is_gate).count() })
    };
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "commits": report.history.commits().len(),
        "biases": biases(report),
        "speeds": speeds(report),
        "cases": report.cases.iter().map(of_case).collect::<Vec<_>>(),
    });
    fill("history.html", &page)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plot_runs_from_the_first_time_to_the_last_and_shows_marks_that_lie_near() {
        let drawn = plot(&[(0, 1.0), (2, 3.0), (4, 2.0)], 4, &[0.5, 100.0]);
        // from 0.5, the mark, to 3: 24 px between the edges
        assert_eq!(drawn["points"], "3.0,22.2 84.0,3.0 165.0,12.6");
        assert_eq!((&drawn["last"], &drawn["marks"]), (&json!(["165.0", "12.6"]), &json!(["27.0"])));
        let still = plot(&[(0, 2.0), (1, 2.0)], 1, &[]);
        assert_eq!(still["points"], "3.0,27.0 165.0,27.0");
    }
}
