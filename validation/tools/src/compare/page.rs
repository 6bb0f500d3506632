//! The page of a comparison.

use super::difference::{Difference, differences};
use super::figures;
use super::parameters::changed;
use super::reading::Results;
use crate::figure::{Figure, FigureFormat};
use crate::judge::mark;
use crate::number::{four_digits, two_digits};
use crate::page;
use crate::report::{ReportError, put};
use crate::result::{MetricEntry, pretty};
use crate::store::provenance::short_commit;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::path::Path;

/// Writes `index.html`, `differences.json`, `parameters.json` and `figures/` into a folder; returns the numbers that differ by more
/// than their tolerance, the largest difference first.
///
/// # Errors
/// Files that cannot be written.
pub fn write(all: &[Results], folder: &Path) -> Result<Vec<Difference>, ReportError> {
    let found = differences(all);
    let cases: BTreeSet<&String> = all.iter().flat_map(|results| results.cases.keys()).collect();
    let figures: Vec<Figure> = cases.into_iter().flat_map(|case| figures::all(all, case)).collect();
    let pictures = page::draw(&figures, &folder.join("figures"), FigureFormat::SCREEN)?;
    put(&folder.join("differences.json"), pretty(&found.iter().map(line).collect::<Vec<_>>()))?;
    let parameters = changed(all);
    put(&folder.join("parameters.json"), pretty(&parameters))?;
    let moved = found.iter().filter(|one| is_moved(one)).count();
    let document = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "folders": all.iter().map(self::folder).collect::<Vec<_>>(),
        "moved": moved,
        "same": found.len() - moved,
        "parameters": parameters,
        "rows": found.iter().map(row).collect::<Vec<_>>(),
        "pictures": pictures,
    });
    let html = page::fill(&[("compare.html", include_str!("template/compare.html"))], "compare.html", &document)?;
    put(&folder.join("index.html"), html)?;
    Ok(found.into_iter().filter(is_moved).collect())
}

/// A line of `differences.json`.
fn line(one: &Difference) -> Value {
    json!({
        "case": one.case,
        "metric": one.metric,
        "variant": one.variant.to_string(),
        "unit": one.unit,
        "values": one.entries.iter().map(|entry| entry.as_ref().and_then(|entry| entry.value)).collect::<Vec<_>>(),
        // from the first, over its size; null where that is zero, missing or the same
        "relative_changes": (0..one.entries.len()).map(|folder| one.change(folder)?.1).collect::<Vec<_>>(),
        // largest difference from the first in its tolerances; null where it is not finite or one folder has it only
        "tolerances": one.tolerances.filter(|tolerances| tolerances.is_finite()),
    })
}

fn is_moved(one: &Difference) -> bool {
    one.tolerances.is_some_and(|tolerances| tolerances > 1.0)
}

fn folder(results: &Results) -> Value {
    let first = results.cases.values().next().map(|case| &case.document);
    let hash = first.map(|document| document.provenance.source_hash.chars().take(12).collect::<String>());
    json!({
        "label": results.label,
        "path": results.folder.display().to_string(),
        "tier": first.map(|document| document.tier.to_string()).unwrap_or_default(),
        "commit": first.map(|document| short_commit(&document.provenance.commit)).unwrap_or_default(),
        "hash": hash.unwrap_or_default(),
    })
}

fn row(one: &Difference) -> Value {
    let cells = one.entries.iter().enumerate();
    json!({
        "case": one.case,
        "metric": one.metric,
        "variant": one.variant.to_string(),
        "unit": one.unit,
        "tolerances": match one.tolerances {
            None => "not in all".to_owned(),
            Some(tolerances) if tolerances.is_finite() => two_digits(tolerances),
            Some(_) => "∞".to_owned(),
        },
        "is_moved": is_moved(one),
        "cells": cells.map(|(folder, entry)| cell(entry.as_ref(), one.change_in_words(folder))).collect::<Vec<_>>(),
    })
}

fn cell(entry: Option<&MetricEntry>, change: Option<String>) -> Value {
    let [class, symbol, _] = mark(entry.map(|entry| entry.verdict));
    let Some(entry) = entry else { return json!({ "class": class, "symbol": symbol, "value": "" }) };
    json!({
        "class": class,
        "symbol": symbol,
        "value": entry.value.map_or_else(|| "not a number".to_owned(), four_digits),
        "change": change,
    })
}
