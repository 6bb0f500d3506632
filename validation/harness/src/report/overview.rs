//! Cases on the first page: a line with a picture each, and every gate in one table.

use super::DrawnFigure;
use super::case_page::case_statement;
use super::judgement::{JudgedCase, JudgedMetric, Judgement, Severity};
use super::rows::{margin_share, mark, row, whole};
use super::view::{GateRow, VerdictMark, picture};
use crate::metric::MetricKind;

/// Folder of the small pictures.
pub(super) const FOLDER: &str = "overview";

/// A case's line in the list of cases.
pub(super) fn case_line(judged: &JudgedCase<'_>, small: &[DrawnFigure]) -> serde_json::Value {
    let case = judged.case;
    // what is exact holds by nothing
    let counts = |judged: &&JudgedMetric<'_>| {
        judged.metric.kind != MetricKind::Bookkeeping || judged.severity() <= Severity::KnownFailure
    };
    let gates = judged.metrics.iter().filter(counts);
    let least = gates.filter_map(|judged| margin_share(judged.metric)).min_by(f64::total_cmp);
    serde_json::json!({
        "mark": if case.metrics.is_empty() { VerdictMark::OBSERVED } else { mark(judged.severity()) },
        "picture": small.iter().find(|drawn| drawn.name == case.name && drawn.failure.is_none()).map(picture),
        "name": case.name,
        "summary": case.summary,
        "statement": case_statement(judged),
        "least_margin": match least {
            Some(share) if share.is_finite() => format!("{} %", whole(100.0 * share)),
            _ => "–".to_owned(),
        },
    })
}

/// Every metric that is judged or has drifted; what is only observed stands on its case's page.
pub(super) fn gates(judgement: &Judgement<'_>) -> Vec<GateRow> {
    let judged = metrics(judgement).filter(|(_, judged)| judged.severity() != Severity::Observed);
    judged.map(|(case, judged)| GateRow { case: case.case.name.clone(), row: row(&case.case.name, judged) }).collect()
}

fn metrics<'a, 'r>(judgement: &'a Judgement<'r>) -> impl Iterator<Item = (&'a JudgedCase<'r>, &'a JudgedMetric<'r>)> {
    judgement.cases.iter().flat_map(|case| case.metrics.iter().map(move |judged| (case, judged)))
}
