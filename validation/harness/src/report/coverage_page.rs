//! The page of the coverage: a row per option, a column per case.

use super::Report;
use super::accepted::tier_name;
use super::coverage::{self, CaseCoverage, Grade, OptionCoverage};
use super::template::fill;
use crate::case::Features;
use serde::Serialize;

#[derive(Serialize)]
struct CoveragePage {
    title: String,
    tier: &'static str,
    grades: Vec<(char, &'static str)>,
    cases: Vec<String>,
    features: Vec<FeatureView>,
    unused: usize,
    open: usize,
}

#[derive(Serialize)]
struct FeatureView {
    name: String,
    options: Vec<OptionView>,
}

#[derive(Serialize)]
struct OptionView {
    name: String,
    /// What is declared of an option that no case of the report uses.
    elsewhere: Option<Elsewhere>,
    cells: Vec<CellView>,
}

#[derive(Serialize)]
struct Elsewhere {
    /// Whether nothing tests it.
    is_open: bool,
    tests: Vec<String>,
    remark: String,
}

#[derive(Serialize)]
struct CellView {
    class: &'static str,
    /// Letters of the grades, the strongest first.
    letters: String,
    /// The same in words.
    meaning: String,
}

impl CellView {
    fn of(covered: Option<&CaseCoverage>) -> Self {
        let Some(covered) = covered else {
            return Self { class: "", letters: String::new(), meaning: String::new() };
        };
        if covered.gates.is_empty() {
            let grade = Grade::Accepted;
            return Self {
                class: "observed",
                letters: grade.letter().to_string(),
                meaning: grade.meaning().to_owned(),
            };
        }
        let letters: String = covered.gates.keys().map(|grade| grade.letter()).collect();
        let mut parts: Vec<String> =
            covered.gates.iter().map(|(grade, number)| format!("{number} {}", grade.meaning())).collect();
        if covered.failing > 0 {
            parts.push(format!("{} fail", covered.failing));
        }
        let (class, failing) = if covered.failing > 0 { ("known", "✗") } else { ("pass", "") };
        Self { class, letters: letters + failing, meaning: parts.join("; ") }
    }
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, features: &Features) -> Result<String, minijinja::Error> {
    let rows = coverage::coverage(features, &report.cases);
    let is_open = |row: &&OptionCoverage| row.is_unused() && row.declared.is_some_and(|own| own.tests.is_empty());
    let page = CoveragePage {
        title: report.title.clone(),
        tier: tier_name(report.tier),
        grades: Grade::ALL.map(|grade| (grade.letter(), grade.meaning())).to_vec(),
        cases: report.cases.iter().map(|case| case.name.clone()).collect(),
        unused: rows.iter().filter(|row| row.is_unused()).count(),
        open: rows.iter().filter(is_open).count(),
        features: grouped(&rows),
    };
    fill("coverage.html", &page)
}

/// Rows of one feature stand side by side already.
fn grouped(rows: &[OptionCoverage]) -> Vec<FeatureView> {
    let of_feature = |rows: &[OptionCoverage]| FeatureView {
        name: rows[0].option.feature.replace('_', " "),
        options: rows.iter().map(option).collect(),
    };
    rows.chunk_by(|one, other| one.option.feature == other.option.feature).map(of_feature).collect()
}

fn option(row: &OptionCoverage) -> OptionView {
    let declared = || match row.declared {
        Some(own) => Elsewhere { is_open: own.tests.is_empty(), tests: own.tests.clone(), remark: own.open.clone() },
        None => {
            let remark = "used by other tiers or cases than those of this report".to_owned();
            Elsewhere { is_open: false, tests: Vec::new(), remark }
        }
    };
    OptionView {
        name: row.option.option.clone(),
        elsewhere: row.is_unused().then(declared),
        cells: row.cases.iter().map(|covered| CellView::of(covered.as_ref())).collect(),
    }
}
