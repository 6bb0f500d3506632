//! Cases on the first page: a line with a picture each, and every gate in one table; `metrics.csv` with all metrics.

use super::DrawnFigure;
use super::case_page::{case_statement, pictures};
use super::judgement::{JudgedCase, Judgement, Rank};
use super::rows::row;
use super::view::VerdictMark;
use crate::output::csv_text;
use serde_json::{Value, json};

/// Folder of the small pictures.
pub(super) const FOLDER: &str = "overview";

/// The list of cases, the worst verdict first.
pub(super) fn case_lines(judgement: &Judgement<'_>, drawn: &[Vec<DrawnFigure>]) -> Vec<Value> {
    let line = |case: &JudgedCase<'_>| case_line(case, pictures(judgement.report, drawn, case.case).first());
    judgement.cases.iter().map(line).collect()
}

fn case_line(judged: &JudgedCase<'_>, picture: Option<&DrawnFigure>) -> Value {
    let case = judged.case;
    json!({
        "mark": VerdictMark::of_case(judged),
        "picture": picture.filter(|drawn| drawn.failure.is_none()),
        "name": case.name,
        "summary": case.summary,
        "statement": case_statement(judged),
    })
}

/// Every metric that is judged or has moved; what is only observed stands on its case's page.
pub(super) fn gates(judgement: &Judgement<'_>) -> Vec<Value> {
    let judged = judgement.metrics().filter(|(_, judged)| judged.rank() != Rank::Observed);
    judged.map(|(case, judged)| json!({ "case": case.case.name, "row": row(&case.case.name, judged) })).collect()
}

/// All metrics of all cases as CSV, with the word of each verdict.
pub(super) fn csv(judgement: &Judgement<'_>) -> String {
    let heading = ["case", "run", "metric", "value", "unit", "limit", "margin", "verdict", "reference"];
    let number =
        |value: Option<f64>| value.filter(|value| value.is_finite()).map_or_else(String::new, |own| own.to_string());
    let rows = judgement.metrics().map(|(case, judged)| {
        let metric = judged.metric;
        let limit = metric.gate.as_ref().map(|gate| gate.limit);
        [
            case.case.name.clone(),
            metric.variant.to_string(),
            metric.name.clone(),
            number(Some(metric.value)),
            metric.unit.clone(),
            limit.map_or_else(String::new, |limit| limit.in_words(|bound| bound.to_string())),
            number(limit.map(|limit| limit.margin(metric.value))),
            VerdictMark::of(judged.severity).word.to_owned(),
            number(metric.reference.as_ref().and_then(|reference| reference.value)),
        ]
    });
    csv_text(std::iter::once(heading.map(str::to_owned)).chain(rows)).expect("rows of one length always serialise")
}
