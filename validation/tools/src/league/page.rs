//! Files of a league: the page and its numbers.

use super::archive::archive;
use super::studies::Study;
use super::{League, LeagueRow};
use crate::judge::{JudgedCode, mark, other_limit};
use crate::metric::Metric;
use crate::number::{four_digits, two_digits};
use crate::output::FileError;
use crate::page;
use crate::report::{ReportError, Severity, Tally, put};
use crate::result::pretty;
use serde_json::{Value, json};
use std::path::Path;

/// Writes `index.html`, `league.json` and an archive of each submission into a folder.
///
/// # Errors
/// Files that cannot be read or written.
pub fn write(league: &League, studies: &[Study], folder: &Path) -> Result<(), ReportError> {
    let document = document(league, studies);
    for (_, _, JudgedCode { submission, .. }) in &league.judged {
        let (name, cell) = (archive_name(&submission.path), submission.path.parent().unwrap_or(Path::new("")));
        let read = |error| FileError::unreadable(cell, &error);
        put(&folder.join(format!("{name}.tar")), archive(cell, &submission.files(), &name).map_err(read)?)?;
    }
    put(&folder.join("league.json"), pretty(&document))?;
    let html = page::fill(&[("league.html", include_str!("league.html"))], "league.html", &document)?;
    Ok(put(&folder.join("index.html"), html)?)
}

/// Name of the archive of a submission: its code and case.
fn archive_name(file: &Path) -> String {
    let parts: Vec<_> =
        file.components().rev().skip(1).take(2).map(|part| part.as_os_str().to_string_lossy()).collect();
    parts.into_iter().rev().collect::<Vec<_>>().join("-")
}

/// Headings of [`orders`].
pub const ORDER_HEADINGS: [&str; 8] =
    ["code", "case", "metric", "run", "coarse mesh", "fine mesh", "ratio of cells", "observed order"];

/// Errors of codes on two meshes with the observed order, a row each.
pub fn orders(league: &League) -> Vec<[String; 8]> {
    let mut rows = Vec::new();
    for (code, case, judged) in &league.judged {
        rows.extend(judged.orders.iter().map(|order| {
            [
                league.codes[*code].clone(),
                league.cases[*case].clone(),
                format!("{} [{}]", order.fine.name, order.fine.unit),
                super::physics(&order.fine.variant).to_string(),
                two_digits(order.coarse),
                two_digits(order.fine.value),
                two_digits(order.ratio),
                order.order().map_or_else(|| "–".to_owned(), two_digits),
            ]
        }));
    }
    rows
}

fn document(league: &League, studies: &[Study]) -> Value {
    let count = |code: usize, case: usize| {
        let of = |tally: Tally| [Severity::Pass, Severity::NewFailure, Severity::NotJudged].map(|own| tally.of(own));
        league.tally(code, case).map(of).map(|of| json!({ "passing": of[0], "failing": of[1], "not_judged": of[2] }))
    };
    let matrix = league.codes.iter().enumerate().map(|(code, name)| {
        json!({ "code": name, "cells": (0..league.cases.len()).map(|case| count(code, case)).collect::<Vec<_>>() })
    });
    let of_case = |case: &String| {
        let rows: Vec<&LeagueRow> = league.rows.iter().filter(|row| row.case == *case && row.is_told()).collect();
        let gives = |code: usize| rows.iter().any(|row| row.values.iter().any(|value| value.0 == code));
        let codes: Vec<usize> = (0..league.codes.len()).filter(|code| gives(*code)).collect();
        let heads: Vec<&String> = codes.iter().map(|code| &league.codes[*code]).collect();
        let has_scatter = rows.iter().any(|row| row.of_one_law().or(row.of_grains()).is_some());
        json!({ "name": case, "has_scatter": has_scatter, "heads": heads, "rows": rows.iter().map(|row| entry(row, &codes)).collect::<Vec<_>>() })
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "cases": league.cases,
        "matrix": matrix.collect::<Vec<_>>(),
        "tables": league.cases.iter().map(of_case).collect::<Vec<_>>(),
        "orders": { "headings": ORDER_HEADINGS, "rows": orders(league) },
        "widths": { "headings": super::WIDTH_HEADINGS, "rows": super::widths(league) },
        "archives": league.judged.iter().map(|(code, case, judged)| {
            let file = &judged.submission.path;
            json!({ "code": league.codes[*code], "case": league.cases[*case], "file": format!("{}.tar", archive_name(file)) })
        }).collect::<Vec<_>>(),
        "studies": studies,
    })
}

fn entry(row: &LeagueRow, codes: &[usize]) -> Value {
    let own = &row.own;
    let reference = own.reference.as_ref();
    let theirs = codes.iter().map(|code| {
        let value = row.values.iter().find(|(own, _, _)| own == code);
        value.map(|(_, law, metric)| {
            let mut cell = cell(metric, json!(law));
            cell["limit"] = other_limit(own, metric).into();
            cell
        })
    });
    let words = |(mean, deviation): (f64, f64)| {
        let share = 100.0 * deviation / mean.abs();
        format!("{} ({} %)", two_digits(deviation), two_digits(share))
    };
    let grains = row.of_grains().map(|of| format!("grains {}", words(of)));
    let scatter: Vec<String> = row.of_one_law().map(words).into_iter().chain(grains).collect();
    json!({
        "metric": own.name,
        "unit": own.unit,
        "variant": row.variant().to_string(),
        "reference": reference.and_then(|of| of.value).map(four_digits),
        "source": reference.map(|of| &of.source),
        "limit": own.gate.as_ref().map(|gate| gate.limit.in_words(four_digits)),
        "own": cell(own, Value::Null),
        "cells": theirs.collect::<Vec<_>>(),
        "scatter": scatter.join("; "),
    })
}

fn cell(metric: &Metric, law: Value) -> Value {
    let [class, symbol, _] = mark(Some(metric.verdict()));
    let reference = metric.reference.as_ref().and_then(|of| of.value).filter(|value| *value != 0.0);
    let off = reference.map(|reference| {
        let share = 100.0 * (metric.value / reference - 1.0);
        format!("{}{} %", if share > 0.0 { "+" } else { "" }, two_digits(share))
    });
    json!({ "class": class, "symbol": symbol, "value": if metric.value.is_finite() { four_digits(metric.value) } else { "–".to_owned() }, "number": metric.value, "off": off, "law": law })
}
