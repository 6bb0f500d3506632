//! From the runs' records to one tidy table, the list of failures and pair plots.

use super::folder::{SweepFolder, SweepProgress};
use super::manifest::{Manifest, SweepRun};
use super::map::{self, MetricMap};
use crate::case::Registry;
use crate::evaluation::{EvaluationRecord, MetricValue};
use crate::figure::{Axis, Figure, FigureError, FigureFormat, Panel};
use crate::metric::{Variant, Verdict};
use crate::output::{FileError, csv_text, write_whole};
use crate::{ToolError, page};
use std::collections::BTreeSet;

/// Metrics that are drawn for a case if the plan names none.
const DRAWN: usize = 4;

/// Writes `results.csv`, `failures.csv` and the figures from the records that are there.
///
/// # Errors
/// Files that cannot be written.
pub fn gather(sweep: &SweepFolder, registry: Registry) -> Result<SweepProgress, ToolError> {
    let unwritable = |error: std::io::Error| FileError::unwritable(sweep.path(), &error);
    let records: Vec<(&SweepRun, EvaluationRecord)> =
        sweep.manifest().entries.iter().filter_map(|entry| sweep.record(entry).map(|record| (entry, record))).collect();
    let names = &sweep.manifest().parameters;
    let tables = [("results.csv", results(names, &records, registry)), ("failures.csv", failures(names, &records))];
    for (name, rows) in tables {
        let text = csv_text(rows).map_err(|error| unwritable(error.into()))?;
        write_whole(&sweep.path().join(name), text.as_bytes()).map_err(unwritable)?;
    }
    for name in unknown_metrics(sweep.manifest(), &records) {
        tracing::warn!("no run has the metric `{name}` that the plan draws; results.csv lists the existing ones");
    }
    let figures = figures(sweep.manifest(), &records);
    let undrawn = |error: FigureError| unwritable(std::io::Error::other(error.to_string()));
    page::draw(&figures, &sweep.path().join("figures"), FigureFormat::SCREEN).map_err(undrawn)?;
    let empty = |record: &EvaluationRecord| record.metrics.iter().filter(|metric| !metric.value.is_finite()).count();
    let whole = records.iter().filter(|(_, record)| record.failure.is_none());
    Ok(SweepProgress { without_value: whole.map(|(_, record)| empty(record)).sum(), ..sweep.tally() })
}

/// Metrics that the plan names and no run has, once there is a run that could have them.
fn unknown_metrics<'a>(manifest: &'a Manifest, records: &[(&SweepRun, EvaluationRecord)]) -> Vec<&'a str> {
    let given: BTreeSet<&str> =
        records.iter().flat_map(|(_, record)| &record.metrics).map(|metric| metric.name.as_str()).collect();
    if given.is_empty() {
        return Vec::new();
    }
    manifest.metrics.iter().map(String::as_str).filter(|name| !given.contains(name)).collect()
}

/// One line per metric: run, case, tier, parameters, metric, variant, value, unit, verdict, and the reason of a value that is not a number.
fn results(names: &[String], records: &[(&SweepRun, EvaluationRecord)], registry: Registry) -> Vec<Vec<String>> {
    let mut rows = vec![heading(names, &["metric", "variant", "value", "unit", "verdict", "reason"])];
    for (entry, record) in records.iter().filter(|(_, record)| record.failure.is_none()) {
        rows.extend(record.metrics.iter().map(|metric| {
            let tail = [
                metric.name.clone(),
                metric.variant.to_string(),
                metric.value.to_string(),
                metric.unit.clone(),
                metric.verdict.word().to_owned(),
                reason(metric, &record.case, registry),
            ];
            [first(entry), tail.to_vec()].concat()
        }));
    }
    rows
}

/// Headings of the first cells, and those of what a table is about.
fn heading(names: &[String], tail: &[&str]) -> Vec<String> {
    let names = names.iter().map(String::as_str);
    ["run", "case", "tier"].into_iter().chain(names).chain(tail.iter().copied()).map(str::to_owned).collect()
}

/// Reason of a value that is not a number: the one that the case states, else what the run did not give; empty beside a number.
fn reason(metric: &MetricValue, case: &str, registry: Registry) -> String {
    if metric.value.is_finite() {
        return String::new();
    }
    let quantities = registry.find(case).map(|case| case.quantities()).unwrap_or_default();
    let described =
        quantities.iter().find(|quantity| quantity.name == metric.name).map(|quantity| quantity.description);
    let stated = metric.remark.clone();
    stated.unwrap_or_else(|| format!("the run ended, but gave no {}", described.unwrap_or("such value")))
}

/// One line per run that failed: run, case, tier, parameters, reason.
fn failures(names: &[String], records: &[(&SweepRun, EvaluationRecord)]) -> Vec<Vec<String>> {
    let row =
        |(entry, record): &(&SweepRun, EvaluationRecord)| Some([first(entry), vec![record.failure.clone()?]].concat());
    std::iter::once(heading(names, &["reason"])).chain(records.iter().filter_map(row)).collect()
}

/// First cells of every line: number, label, tier and parameters. Words lose TOML's quotes.
fn first(entry: &SweepRun) -> Vec<String> {
    let plain = |value: &String| value.trim_matches(|mark| mark == '"' || mark == '\'').to_owned();
    let head = [entry.number.to_string(), entry.label.clone(), entry.tier.to_string()];
    head.into_iter().chain(entry.point.iter().map(plain)).collect()
}

/// A case's metrics, one per row of panels, over the parameters that are numbers; and as a map where those are two.
fn figures(manifest: &Manifest, records: &[(&SweepRun, EvaluationRecord)]) -> Vec<Figure> {
    let mut cases: Vec<&str> = records.iter().map(|(entry, _)| entry.label.as_str()).collect();
    // the runs of a case follow each other
    cases.dedup();
    cases.into_iter().flat_map(|case| pairs(manifest, case, records)).collect()
}

fn pairs(manifest: &Manifest, case: &str, records: &[(&SweepRun, EvaluationRecord)]) -> Vec<Figure> {
    let own: Vec<&(&SweepRun, EvaluationRecord)> =
        records.iter().filter(|(entry, record)| entry.label == case && record.failure.is_none()).collect();
    let numbers = |parameter: usize| -> Option<Vec<f64>> {
        let values: Option<Vec<f64>> = own.iter().map(|(entry, _)| entry.point[parameter].parse().ok()).collect();
        values.filter(|values| values.iter().any(|value| *value != values[0]))
    };
    let varied: Vec<(usize, Vec<f64>)> =
        (0..manifest.parameters.len()).filter_map(|k| numbers(k).map(|values| (k, values))).collect();
    let metrics = drawn_metrics(manifest, &own);
    if varied.is_empty() || metrics.is_empty() {
        return Vec::new();
    }
    let rows: Vec<String> =
        metrics.iter().map(|(name, variant)| format!("{name} {variant}").trim_end().to_owned()).collect();
    let (mut panels, mut surfaces) = (Vec::new(), Vec::new());
    for (name, variant) in &metrics {
        let value_of = |record: &EvaluationRecord| {
            let found = record.metrics.iter().find(|metric| metric.name == *name && metric.variant == *variant);
            found.filter(|metric| metric.value.is_finite()).map(|metric| (metric.value, metric.unit.clone()))
        };
        if let [(_, x), (_, y)] = &varied[..] {
            let values = own.iter().zip(x.iter().zip(y));
            let points = values.filter_map(|((_, record), (&x, &y))| Some((x, y, value_of(record)?.0))).collect();
            surfaces.push(MetricMap { metric: format!("{name} {variant}"), points });
        }
        for (parameter, values) in &varied {
            let found = own.iter().zip(values).filter_map(|((_, record), &x)| Some((x, value_of(record)?)));
            let found: Vec<(f64, (f64, String))> = found.collect();
            let unit = found.last().map_or("", |(_, (_, unit))| unit.as_str());
            let label = &manifest.parameters[*parameter];
            let mut panel = Panel::new("", Axis::linear(label), Axis::linear(&format!("{name} [{unit}]")));
            panel.points("", 0, found.iter().map(|(x, (value, _))| (*x, *value)));
            panels.push(panel);
        }
    }
    let name = format!("pairs-{}", case.replace([' ', '/'], "-"));
    let caption = format!("Metrics of every run over the varied parameters; rows of panels: {}.", rows.join("; "));
    let pairs = Figure::new(&name, &caption, panels).in_columns(varied.len().min(3));
    let map = match &varied[..] {
        [(x, _), (y, _)] => map::figure(case, [&manifest.parameters[*x], &manifest.parameters[*y]], &surfaces),
        _ => None,
    };
    std::iter::once(pairs).chain(map).collect()
}

/// The metrics that the plan names, else the first that the parameters change, gated ones first; each with its variant.
fn drawn_metrics(manifest: &Manifest, own: &[&(&SweepRun, EvaluationRecord)]) -> Vec<(String, Variant)> {
    let mut seen = BTreeSet::new();
    let all: Vec<_> = own
        .iter()
        .flat_map(|(_, record)| &record.metrics)
        .filter(|metric| seen.insert((metric.name.clone(), metric.variant.clone())))
        .collect();
    let changes = |metric: &MetricValue| {
        let same = |other: &&MetricValue| other.name == metric.name && other.variant == metric.variant;
        let mut values = own.iter().filter_map(|(_, record)| record.metrics.iter().find(same)).map(|other| other.value);
        values.any(|value| value != metric.value)
    };
    let chosen: Vec<&MetricValue> = if manifest.metrics.is_empty() {
        let (gated, others): (Vec<&MetricValue>, Vec<&MetricValue>) =
            all.into_iter().filter(|metric| changes(metric)).partition(|metric| metric.verdict != Verdict::Observed);
        gated.into_iter().chain(others).take(DRAWN).collect()
    } else {
        all.into_iter().filter(|metric| manifest.metrics.contains(&metric.name)).take(3 * DRAWN).collect()
    };
    chosen.into_iter().map(|metric| (metric.name.clone(), metric.variant.clone())).collect()
}
