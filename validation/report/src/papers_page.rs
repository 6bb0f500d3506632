//! The page of the papers: every element, what became of it, and where that is shown.

use super::papers::{ElementOutcome, Ended, PaperSummary, Shown, Status};
use super::template::fill;
use super::view::{VerdictMark, anchor};
use super::{CaseReport, Report};
use crate::case::Tier;
use crate::evidence::{MetricName, Printed, RunName};
use crate::number::{four_digits, with_unit};
use crate::observation::Outcome;
use serde_json::{Value, json};

/// A status as it looks.
fn mark(status: Status) -> VerdictMark {
    let of = |look: VerdictMark, symbol| VerdictMark { symbol, word: status.word(), ..look };
    match status {
        Status::Reproduced => of(VerdictMark::PASS, "✓"),
        Status::NotShown => of(VerdictMark::EXPECTED, "○"),
        Status::NotReproduced => of(VerdictMark::EXPECTED, "△"),
        Status::Contradicted => of(VerdictMark::FAIL, "✗"),
        Status::NotCovered => of(VerdictMark::OBSERVED, "–"),
    }
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, accounts: &[PaperSummary<'_>]) -> Result<String, minijinja::Error> {
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "papers": accounts.iter().map(|account| paper(account, &report.cases)).collect::<Vec<_>>(),
        "script": include_str!("template/page.js"),
    });
    fill("papers.html", &page)
}

fn paper(account: &PaperSummary<'_>, cases: &[CaseReport]) -> Value {
    json!({
        "name": account.paper.name,
        "title": account.paper.title,
        "source": account.paper.source,
        "counts": Status::ALL.map(|status| json!({ "mark": mark(status), "number": account.count(status) })),
        "by_tests": account.elements.iter().filter(|fate| fate.rests_on_tests()).count(),
        "elements": account.elements.iter().map(|fate| element(&account.paper.name, fate, cases)).collect::<Vec<_>>(),
    })
}

fn element(paper: &str, fate: &ElementOutcome<'_>, cases: &[CaseReport]) -> Value {
    let element = fate.element;
    let is_missing = |name: &&MetricName| !fate.shown.iter().any(|shown| std::ptr::eq(shown.name, *name));
    let missing = element.metrics.iter().filter(is_missing);
    let missing = missing.map(|name| format!("{} {} {}", name.case, name.metric, name.variant));
    let is_gone = |name: &&RunName| !fate.ended.iter().any(|ended| std::ptr::eq(ended.name, *name));
    let gone = element.runs.iter().filter(is_gone).map(|name| format!("{} {}", name.case, name.variant));
    json!({
        "anchor": format!("{paper}-{}", element.id),
        "id": element.id,
        "place": element.place,
        "statement": element.statement,
        "implemented": element.implemented,
        "mark": mark(fate.status),
        "reason": reason(fate),
        "note": element.note,
        "values": fate.shown.iter().map(value).chain(fate.ended.iter().map(run)).collect::<Vec<_>>(),
        // names of metrics and runs that are not in this report
        "missing": missing.chain(gone).collect::<Vec<_>>(),
        // error that makes one of the tests fail; none where metrics speak
        "control": element.control,
        "tests": element.tests,
        "figures": figures(fate, cases),
    })
}

/// Reason of a status: what is written where it is settled, or the controls under which it would count as reproduced too.
fn reason(fate: &ElementOutcome<'_>) -> String {
    let names: Vec<String> = fate.accepts.iter().map(|(case, control)| format!("{control} of {case}")).collect();
    match (&fate.element.not_covered, fate.status) {
        (Some(reason), _) => reason.clone(),
        (None, Status::NotCovered) => {
            "the metric or run of this element is not part of this tier, or is not judged".to_owned()
        }
        (None, Status::NotShown) if !names.is_empty() => {
            format!("negative controls (faulty runs) also reproduce this: {}", names.join(", "))
        }
        (None, Status::NotShown) if !fate.falls => "no negative control makes this element fail".to_owned(),
        (None, Status::NotShown) => "the uncertainty exceeds the printed range or the limit".to_owned(),
        _ => String::new(),
    }
}

/// A link to a place on a case's page.
fn link(case: &str, anchor: &str, text: &str) -> Value {
    json!({ "case": case, "anchor": anchor, "text": text })
}

fn value(shown: &Shown<'_>) -> Value {
    let Shown { name, metric, status } = shown;
    json!({
        "mark": status.map_or(VerdictMark::OBSERVED, mark),
        "link": link(&name.case, &anchor(&name.case, &metric.name, &metric.variant), &metric.name),
        // with spaces, so that a narrow column breaks between its parts
        "variant": metric.variant.to_string().replace(',', ", "),
        "value": with_unit(metric.value, &metric.unit),
        "printed": name.printed.map(|printed| range(printed, &metric.unit)),
    })
}

/// A run that had to end.
fn run(ended: &Ended<'_>) -> Value {
    let Ended { name, run, status } = ended;
    let outcome = match &run.outcome {
        Outcome::Diverged { message, .. } => message.clone(),
        _ => format!("completed, {}\u{202f}s simulated", four_digits(run.simulated_time)),
    };
    json!({
        "mark": status.map_or(VerdictMark::OBSERVED, mark),
        "link": link(&name.case, "runs", "run"),
        "variant": run.variant.to_string().replace(',', ", "),
        "value": outcome,
    })
}

/// A printed number with the range that counts as equal, or the range in which a statement without a number is read, in words.
fn range(printed: Printed, unit: &str) -> String {
    let (low, high) = (printed.at_least, printed.at_most);
    let range = match (low, high) {
        (Some(low), Some(high)) if low == high => with_unit(low, unit),
        (Some(low), Some(high)) => format!("{} … {}", four_digits(low), with_unit(high, unit)),
        (Some(low), None) => format!("≥ {}", with_unit(low, unit)),
        (None, high) => format!("≤ {}", with_unit(high.unwrap_or(f64::INFINITY), unit)),
    };
    match printed.value {
        Some(_) if low == high => format!("paper: {range}"),
        Some(value) => format!("paper: {}, our tolerance: {range}", with_unit(value, unit)),
        None => format!("required by our interpretation of the paper: {range}"),
    }
}

/// The first figure of this report for every name.
fn figures(fate: &ElementOutcome<'_>, cases: &[CaseReport]) -> Vec<Value> {
    let drawn = fate.element.figures.iter().filter_map(|wanted| {
        let (name, beginning) = wanted.split_once('/')?;
        let case = cases.iter().find(|case| case.name == name)?;
        let figure = case.figures.iter().find(|figure| figure.name.starts_with(beginning))?;
        Some(link(&case.name, &format!("figure-{}-{}", case.name, figure.name), &figure.name))
    });
    drawn.collect()
}

/// Counts and statuses as JSON, for programs.
pub(super) fn json(tier: Tier, accounts: &[PaperSummary<'_>]) -> String {
    let paper = |account: &PaperSummary<'_>| {
        let counts = Status::ALL.into_iter().map(|status| (status.word().to_owned(), account.count(status).into()));
        let counts: serde_json::Map<String, Value> = counts.collect();
        let row = |fate: &ElementOutcome<'_>| json!({ "id": fate.element.id, "status": fate.status.word(), "reason": reason(fate) });
        let elements: Vec<Value> = account.elements.iter().map(row).collect();
        json!({ "paper": account.paper.name, "counts": counts, "elements": elements })
    };
    let papers: Vec<Value> = accounts.iter().map(paper).collect();
    format!("{:#}\n", json!({ "tier": tier.name(), "papers": papers }))
}
