//! Cases on the first page: the worst margins, a line with a picture each, and every gate in one table.

use super::DrawnFigure;
use super::case_page::case_statement;
use super::judgement::{JudgedCase, JudgedMetric, Judgement, Severity};
use super::rows::{margin_share, mark, row, statement, whole, worst_mark};
use super::view::picture;
use super::view::{CaseLine, GateRow, VerdictMark, WorstMetric, anchor};
use crate::metric::{GateOwner, MetricKind};

/// Folder of the small pictures.
pub(super) const FOLDER: &str = "overview";

/// Lines of a short list: so many fit beside the counts on a laptop's first screen.
const LINES: usize = 6;

/// Gates that fail, the user's own before those of the case and the known ones last, then those that hold by the least share of their limit. Bookkeeping is shown where
/// it fails only: what is exact holds by nothing.
pub(super) fn worst(judgement: &Judgement<'_>) -> Vec<WorstMetric> {
    let mut all: Vec<((Severity, GateOwner), f64, WorstMetric)> = Vec::new();
    for (case, judged) in metrics(judgement) {
        let fails = judged.severity() <= Severity::KnownFailure;
        let Some(share) =
            margin_share(judged.metric).filter(|_| fails || judged.metric.kind != MetricKind::Bookkeeping)
        else {
            continue;
        };
        let order = match fails {
            true => (judged.severity(), judged.metric.gate_owner()),
            false => (Severity::Pass, GateOwner::Case),
        };
        let number = if share.is_finite() { format!("{} %", whole(100.0 * share)) } else { "–".to_owned() };
        all.push((order, share, line(case, judged, worst_mark(judged), number)));
    }
    // Stable: equal ones keep the order of the page.
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all.into_iter().take(LINES).map(|(_, _, line)| line).collect()
}

fn line(case: &JudgedCase<'_>, judged: &JudgedMetric<'_>, mark: VerdictMark, number: String) -> WorstMetric {
    WorstMetric {
        mark,
        case: case.case.name.clone(),
        anchor: anchor(&case.case.name, &judged.metric.name, &judged.metric.variant),
        metric: judged.metric.name.clone(),
        variant: judged.metric.variant.to_string(),
        number,
        statement: statement(judged),
    }
}

/// A case's line in the list of cases.
pub(super) fn case_line(judged: &JudgedCase<'_>, small: &[DrawnFigure]) -> CaseLine {
    let case = judged.case;
    let gates = judged.metrics.iter().filter(|judged| judged.metric.kind != MetricKind::Bookkeeping);
    let least = gates.filter_map(|judged| margin_share(judged.metric)).min_by(f64::total_cmp);
    CaseLine {
        mark: if case.metrics.is_empty() { VerdictMark::OBSERVED } else { mark(judged.severity()) },
        picture: small.iter().find(|drawn| drawn.name == case.name && drawn.failure.is_none()).map(picture),
        name: case.name.clone(),
        summary: case.summary.clone(),
        statement: case_statement(judged),
        least_margin: match least {
            Some(share) if share.is_finite() => format!("{} %", whole(100.0 * share)),
            _ => "–".to_owned(),
        },
    }
}

/// Every metric that is judged or has drifted; what is only observed stands on its case's page.
pub(super) fn gates(judgement: &Judgement<'_>) -> Vec<GateRow> {
    let judged = metrics(judgement).filter(|(_, judged)| judged.severity() != Severity::Observed);
    judged.map(|(case, judged)| GateRow { case: case.case.name.clone(), row: row(&case.case.name, judged) }).collect()
}

fn metrics<'a, 'r>(judgement: &'a Judgement<'r>) -> impl Iterator<Item = (&'a JudgedCase<'r>, &'a JudgedMetric<'r>)> {
    judgement.cases.iter().flat_map(|case| case.metrics.iter().map(move |judged| (case, judged)))
}
