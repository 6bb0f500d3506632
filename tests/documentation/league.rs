//! The page of the book on other codes, from their stored results.

use crate::documentation::reference::{assert_page, cell, wrapped};
use bagnold_harness::case::{Silent, execute};
use bagnold_harness::metric::{Metric, Verdict};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_reference::collapse::{AT_REST, CodeQuantity, PLANAR_CODES};
use bagnold_report::{Severity, Tally};
use bagnold_tools::judge::{LawOrigin, judge};
use bagnold_tools::league::{
    League, LeagueRow, ORDER_HEADINGS, WIDTH_HEADINGS, league, orders, read, split, studies, submissions, widths,
};
use bagnold_validation::REGISTRY;
use std::fmt::Write;
use std::path::{Path, PathBuf};

const HEAD: &str = "# Other codes under the same gates

Public codes computed some of the cases from the same inputs. Their stored results are measured and
judged as those of Bagnold. `bagnold league` writes the page with all sources;
`validation/league/README.md` tells how to run a deck and how to add a code.

## Gates that pass, fail and lack data

";

const VALUES: &str = "
✓ passes, ✗ fails, · is not judged. The standard deviation is that of Bagnold and of the codes of
the same law; it measures the scatter between methods under one law. *grains*: that of the codes
of the same grains.
";

const ORDERS: &str = "
## Order of convergence of the codes

The observed order is ln(error on the coarse mesh/error on the fine mesh) over ln(ratio of the
cells). An error that changes its sign has no order, and one that is about to change it has a high
order. An error of the law or of an operator that no mesh reduces lowers the order.

";

const WIDTHS: &str = "
## Limits compared with the scatter of codes

The table holds gated quantities of at least three codes of one law, Bagnold included. The width is
half of an interval; for a bound it is the distance from the mean of the codes. A width below one
standard deviation is narrow, from two on it is wide; its reason is that of the gate.

";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/league")
}

fn stored() -> League {
    let files = submissions(&folder()).unwrap_or_else(|error| panic!("{error}"));
    let (prepared, entries) = split(read(&files, *REGISTRY).unwrap_or_else(|error| panic!("{error}")));
    let own = execute(prepared, &Store::open(StorePolicy::Use), &Silent).unwrap_or_else(|error| panic!("{error}"));
    let judged = own.into_iter().zip(&entries).map(|(own, entries)| judge(own, entries));
    league(&judged.collect::<Result<Vec<_>, _>>().unwrap_or_else(|error| panic!("{error}")))
}

/// Three significant digits.
fn number(value: f64) -> String {
    let digits = if value == 0.0 { 2.0 } else { 2.0 - value.abs().log10().floor() };
    format!("{value:.0$}", digits.max(0.0) as usize)
}

fn value(metric: &Metric) -> String {
    if !metric.value.is_finite() {
        return "–".to_owned();
    }
    let symbol = match metric.verdict() {
        Verdict::Pass => "✓",
        Verdict::Fail => "✗",
        Verdict::Observed => "·",
    };
    format!("{symbol} {}", number(metric.value))
}

fn row(row: &LeagueRow, codes: &[usize]) -> String {
    let theirs = codes.iter().map(|code| {
        let own = row.values.iter().find(|(own, _, _)| own == code);
        own.map_or_else(String::new, |(_, law, metric)| {
            let limit = metric.gate.as_ref().map(|gate| gate.limit);
            let other = limit.filter(|limit| row.own.gate.as_ref().is_none_or(|own| own.limit != *limit));
            let other = other.map(|limit| format!(" (limit {})", limit.in_words(number))).unwrap_or_default();
            value(metric) + &other + if *law == LawOrigin::Same { "" } else { " (other law)" }
        })
    });
    let theirs: Vec<String> = theirs.collect();
    let own = row.of_one_law().map(|(_, deviation)| number(deviation));
    let grains = row.of_grains().map(|(_, deviation)| format!("grains {}", number(deviation)));
    let scatter = own.into_iter().chain(grains).collect::<Vec<_>>().join("; ");
    let limit = row.own.gate.as_ref().map(|gate| gate.limit.in_words(number)).unwrap_or_default();
    let name = format!("`{}` [{}] {}", row.own.name, row.own.unit, row.variant());
    format!("| {} | {limit} | {} | {} | {scatter} |", cell(&name), value(&row.own), theirs.join(" | "))
}

/// Runs are gated by what other codes tell of the deposit: these numbers are those of the stored results.
fn deposits_of_other_codes_are_those_of(league: &League) {
    for (quantity, of_codes) in
        [("centroid", CodeQuantity::CentroidAtRest), ("front_at_0.05_r0", CodeQuantity::FrontAtRest)]
    {
        for aspect_ratio in ["1", "3"] {
            let variant = format!("quantity={quantity},material=lagree,aspect_ratio={aspect_ratio}");
            let row = league.rows.iter().find(|row| row.own.name == "run_out" && row.variant().to_string() == variant);
            let of_law = row.expect("a row").values.iter().filter(|(_, law, _)| *law == LawOrigin::Same);
            let values: Vec<f64> = of_law.map(|(_, _, metric)| metric.value).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            let flow = aspect_ratio.parse().expect("a number");
            let (reference, _) = PLANAR_CODES.at(flow, of_codes, AT_REST).expect("two codes");
            assert_eq!(values.len(), 2, "{variant}");
            assert!((reference - mean).abs() < 1e-3, "{variant}: {reference} instead of {mean}");
        }
    }
}

#[test]
fn the_page_on_other_codes_is_that_of_the_stored_results() {
    let league = stored();
    deposits_of_other_codes_are_those_of(&league);
    let mut text = HEAD.to_owned();
    let _ = writeln!(text, "| code | {} |\n|---|{}", league.cases.join(" | "), "---|".repeat(league.cases.len()));
    for (code, name) in league.codes.iter().enumerate() {
        let cells = (0..league.cases.len()).map(|case| {
            let of =
                |tally: Tally| [Severity::Pass, Severity::NewFailure, Severity::NotJudged].map(|own| tally.of(own));
            league
                .tally(code, case)
                .map(of)
                .map_or_else(String::new, |[pass, fail, open]| format!("{pass} / {fail} / {open}"))
        });
        let _ = writeln!(text, "| {name} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
    text.push_str(VALUES);
    for case in &league.cases {
        let rows: Vec<&LeagueRow> = league.rows.iter().filter(|row| row.case == *case && row.is_told()).collect();
        let gives = |code: &usize| rows.iter().any(|row| row.values.iter().any(|value| value.0 == *code));
        let codes: Vec<usize> = (0..league.codes.len()).filter(gives).collect();
        let heads: Vec<&str> = codes.iter().map(|code| league.codes[*code].as_str()).collect();
        let line = "---|".repeat(codes.len());
        let _ = write!(
            text,
            "\n## {case}\n\n| metric | limit | Bagnold | {} | standard deviation |\n|---|---|---|{line}---|\n",
            heads.join(" | ")
        );
        for own in rows {
            let _ = writeln!(text, "{}", row(own, &codes));
        }
    }
    let _ = writeln!(text, "{ORDERS}| {} |\n|{}", ORDER_HEADINGS.join(" | "), "---|".repeat(ORDER_HEADINGS.len()));
    for row in orders(&league) {
        let _ = writeln!(text, "| {} |", row.map(|words| cell(&words)).join(" | "));
    }
    let _ = writeln!(text, "{WIDTHS}| {} |\n|{}", WIDTH_HEADINGS.join(" | "), "---|".repeat(WIDTH_HEADINGS.len()));
    for row in widths(&league) {
        let _ = writeln!(text, "| {} |", row.map(|words| cell(&words)).join(" | "));
    }
    for study in studies::studies(&folder()).unwrap_or_else(|error| panic!("{error}")) {
        let paragraphs = [study.about, study.columns].map(wrapped).join("\n\n");
        let line = "---|".repeat(study.headings.len());
        let paragraphs = paragraphs + "\n\nVerdicts and u are [defined](uncertainty.md) elsewhere.";
        let _ = writeln!(text, "\n## {}\n\n{paragraphs}\n\n| {} |\n|{line}", study.title, study.headings.join(" | "));
        for row in study.rows {
            let _ = writeln!(text, "| {} |", row.join(" | "));
        }
    }
    assert_page("other-codes.md", &text);
}
