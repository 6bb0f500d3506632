//! The page of the coverage: a row per option, a column per case.

use super::Report;
use super::coverage::{self, CaseCoverage, Grade, OptionCoverage};
use super::template::fill;
use crate::case::Features;
use serde_json::{Value, json};

/// Class of a cell, letters of its grades, the strongest first, and the same in words.
fn cell(covered: Option<&CaseCoverage>) -> Value {
    let (class, letters, meaning) = match covered {
        None => ("", String::new(), String::new()),
        Some(covered) if covered.gates.is_empty() => {
            let (letter, meaning) = Grade::Baseline.letter_and_meaning();
            ("observed", letter.to_string(), meaning.to_owned())
        }
        Some(covered) => {
            let words = covered.gates.iter().map(|(grade, number)| (grade.letter_and_meaning(), number));
            let letters: String = words.clone().map(|((letter, _), _)| letter).collect();
            let mut parts: Vec<String> = words.map(|((_, meaning), number)| format!("{number} {meaning}")).collect();
            if covered.failing > 0 {
                parts.push(format!("{} fail", covered.failing));
            }
            let (class, failing) = if covered.failing > 0 { ("expected", "△") } else { ("pass", "") };
            (class, letters + failing, parts.join("; "))
        }
    };
    json!({ "class": class, "letters": letters, "meaning": meaning })
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, features: &Features) -> Result<String, minijinja::Error> {
    let rows = coverage::coverage(features, &report.cases);
    let is_open = |row: &&OptionCoverage| row.is_unused() && row.declared.is_some_and(|own| own.tests.is_empty());
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "grades": Grade::ALL.map(Grade::letter_and_meaning),
        "cases": report.cases.iter().map(|case| &case.name).collect::<Vec<_>>(),
        "unused": rows.iter().filter(|row| row.is_unused()).count(),
        "open": rows.iter().filter(is_open).count(),
        "features": grouped(&rows),
    });
    fill("coverage.html", &page)
}

/// Rows of one feature stand side by side already.
fn grouped(rows: &[OptionCoverage]) -> Vec<Value> {
    let of_feature = |rows: &[OptionCoverage]| {
        let options: Vec<Value> = rows.iter().map(option).collect();
        json!({ "name": rows[0].option.feature.replace('_', " "), "options": options })
    };
    rows.chunk_by(|one, other| one.option.feature == other.option.feature).map(of_feature).collect()
}

/// An option, with what is declared of it where no case of the report uses it.
fn option(row: &OptionCoverage) -> Value {
    let declared = || match row.declared {
        Some(own) => json!({ "is_open": own.tests.is_empty(), "tests": own.tests, "remark": own.open }),
        None => json!({
            "is_open": false,
            "tests": [],
            "remark": "used only by tiers or cases outside this report",
        }),
    };
    let cells: Vec<Value> = row.cases.iter().map(|covered| cell(covered.as_ref())).collect();
    json!({ "name": row.option.option, "elsewhere": row.is_unused().then(declared), "cells": cells })
}
