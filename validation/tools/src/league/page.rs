//! Files of a league: the page and its numbers.

use super::blind::{self, BlindComparison};
use super::{League, LeagueRow};
use crate::judge::other_limit;
use crate::metric::{Metric, Verdict};
use crate::number::{four_digits, two_digits};
use crate::page;
use crate::report::ReportError;
use crate::result::pretty;
use serde_json::{Value, json};
use std::path::Path;

/// Writes `index.html` and `league.json` into a folder.
///
/// # Errors
/// Files that cannot be written.
pub fn write(league: &League, blind: &[BlindComparison], folder: &Path) -> Result<(), ReportError> {
    let document = document(league, blind);
    let put = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(|source| ReportError::Write { path, source })
    };
    put("league.json", &pretty(&document))?;
    put("index.html", &page::fill(&[("league.html", include_str!("league.html"))], "league.html", &document)?)
}

fn document(league: &League, blind: &[BlindComparison]) -> Value {
    let count = |code: usize, case: usize| {
        let counts = league.count(code, case);
        counts.map(|(holding, failing, open)| json!({ "holding": holding, "failing": failing, "not_given": open }))
    };
    let matrix = league.codes.iter().enumerate().map(|(code, name)| {
        json!({ "code": name, "cells": (0..league.cases.len()).map(|case| count(code, case)).collect::<Vec<_>>() })
    });
    let of_case = |case: &String| {
        let rows: Vec<&LeagueRow> = league.rows.iter().filter(|row| row.case == *case && row.is_told()).collect();
        let gives = |code: usize| rows.iter().any(|row| row.values.iter().any(|value| value.0 == code));
        let codes: Vec<usize> = (0..league.codes.len()).filter(|code| gives(*code)).collect();
        let heads: Vec<&String> = codes.iter().map(|code| &league.codes[*code]).collect();
        let has_scatter = rows.iter().any(|row| row.of_one_law().is_some());
        json!({ "name": case, "has_scatter": has_scatter, "heads": heads, "rows": rows.iter().map(|row| entry(row, &codes)).collect::<Vec<_>>() })
    };
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "cases": league.cases,
        "matrix": matrix.collect::<Vec<_>>(),
        "tables": league.cases.iter().map(of_case).collect::<Vec<_>>(),
        "blind": { "headings": blind::HEADINGS, "rows": blind::table(blind) },
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
    let scatter = row.of_one_law().map(|(mean, deviation)| {
        let share = 100.0 * deviation / mean.abs();
        format!("{} ({} %)", two_digits(deviation), two_digits(share))
    });
    json!({
        "metric": own.name,
        "unit": own.unit,
        "variant": row.variant().to_string(),
        "reference": reference.and_then(|of| of.value).map(four_digits),
        "source": reference.map(|of| &of.source),
        "limit": own.gate.as_ref().map(|gate| gate.limit.in_words(four_digits)),
        "own": cell(own, Value::Null),
        "cells": theirs.collect::<Vec<_>>(),
        "scatter": scatter,
    })
}

fn cell(metric: &Metric, law: Value) -> Value {
    let (class, symbol) = match metric.verdict() {
        Verdict::Pass => ("pass", "✓"),
        Verdict::Fail => ("fail", "✗"),
        Verdict::Observed => ("observed", "○"),
    };
    let reference = metric.reference.as_ref().and_then(|of| of.value).filter(|value| *value != 0.0);
    let off = reference.map(|reference| {
        let share = 100.0 * (metric.value / reference - 1.0);
        format!("{}{} %", if share > 0.0 { "+" } else { "" }, two_digits(share))
    });
    json!({ "class": class, "symbol": symbol, "value": if metric.value.is_finite() { four_digits(metric.value) } else { "–".to_owned() }, "number": metric.value, "off": off, "law": law })
}
