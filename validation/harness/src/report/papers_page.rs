//! The page of the papers: every element, what became of it, and where that is shown; and its card on the overview.

use super::accepted::tier_name;
use super::papers::{self, ElementOutcome, Ended, PaperSummary, Shown, Status};
use super::template::fill;
use super::view::{VerdictCount, VerdictMark, anchor};
use super::{CaseReport, Report};
use crate::case::Tier;
use crate::evidence::{MetricName, Printed, RunName};
use crate::number::{four_digits, with_unit};
use crate::observation::Outcome;
use serde::Serialize;

#[derive(Serialize)]
struct PapersPage {
    title: String,
    tier: &'static str,
    papers: Vec<PaperView>,
    script: &'static str,
}

#[derive(Serialize)]
struct PaperView {
    name: String,
    title: String,
    source: String,
    counts: Vec<Share>,
    by_tests: usize,
    elements: Vec<ElementView>,
}

#[derive(Serialize)]
struct Share {
    mark: VerdictMark,
    number: usize,
}

#[derive(Serialize)]
struct ElementView {
    anchor: String,
    id: String,
    place: String,
    statement: String,
    implemented: String,
    mark: VerdictMark,
    reason: String,
    note: String,
    values: Vec<ValueView>,
    /// Names of metrics and runs that are not in this report.
    missing: Vec<String>,
    tests: Vec<String>,
    /// Error that makes one of the tests fail; empty where metrics speak.
    control: String,
    figures: Vec<CasePageLink>,
}

#[derive(Serialize)]
struct ValueView {
    mark: VerdictMark,
    link: CasePageLink,
    variant: String,
    value: String,
    printed: String,
}

#[derive(Serialize)]
struct CasePageLink {
    case: String,
    /// Where it stands on the case's page.
    anchor: String,
    text: String,
}

/// A status as it looks.
fn mark(status: Status) -> VerdictMark {
    let of = |look: VerdictMark, symbol| VerdictMark { symbol, word: status.word(), ..look };
    match status {
        Status::Reproduced => of(VerdictMark::PASS, "✓"),
        Status::NotShown => of(VerdictMark::KNOWN, "○"),
        Status::NotReproduced => of(VerdictMark::KNOWN, "✗"),
        Status::Contradicted => of(VerdictMark::FAIL, "✗"),
        Status::Replaced => of(VerdictMark::DRIFT, "⇄"),
        Status::NotStatedClearly => of(VerdictMark::OBSERVED, "?"),
        Status::NotCovered => of(VerdictMark::OBSERVED, "–"),
        Status::NotInThisTier => of(VerdictMark::OBSERVED, "○"),
    }
}

/// The card of the papers among the counts of the overview; none without papers.
pub(super) fn count(accounts: &[PaperSummary<'_>]) -> Option<VerdictCount> {
    let all: usize = accounts.iter().map(|account| account.elements.len()).sum();
    let of = |status| papers::count(accounts, status);
    let open = of(Status::NotReproduced) + of(Status::Contradicted);
    let rest = Status::ALL.into_iter().filter(|status| *status != Status::Reproduced && of(*status) > 0);
    let details: Vec<String> = rest.map(|status| format!("{} {}", of(status), status.word())).collect();
    (all > 0).then(|| VerdictCount {
        mark: if open > 0 { VerdictMark::KNOWN } else { VerdictMark::PASS },
        name: "Papers",
        meaning: "both papers, element by element",
        statement: format!("{} of {all} elements reproduced", of(Status::Reproduced)),
        detail: details.join(" · "),
        link: Some("papers.html"),
    })
}

/// Fills the template of the page.
pub(super) fn render(report: &Report, accounts: &[PaperSummary<'_>]) -> Result<String, minijinja::Error> {
    let page = PapersPage {
        title: report.title.clone(),
        tier: tier_name(report.tier),
        papers: accounts.iter().map(|account| paper(account, &report.cases)).collect(),
        script: include_str!("template/page.js"),
    };
    fill("papers.html", &page)
}

fn paper(account: &PaperSummary<'_>, cases: &[CaseReport]) -> PaperView {
    let share = |status| Share { mark: mark(status), number: account.count(status) };
    PaperView {
        name: account.paper.name.clone(),
        title: account.paper.title.clone(),
        source: account.paper.source.clone(),
        counts: Status::ALL.into_iter().map(share).collect(),
        by_tests: account.elements.iter().filter(|fate| fate.rests_on_tests()).count(),
        elements: account.elements.iter().map(|fate| element(&account.paper.name, fate, cases)).collect(),
    }
}

fn element(paper: &str, fate: &ElementOutcome<'_>, cases: &[CaseReport]) -> ElementView {
    let element = fate.element;
    let is_missing = |name: &&MetricName| !fate.shown.iter().any(|shown| std::ptr::eq(shown.name, *name));
    let missing = element.metrics.iter().filter(is_missing);
    let missing = missing.map(|name| format!("{} {} [{}]", name.case, name.metric, name.variant));
    let is_gone = |name: &&RunName| !fate.ended.iter().any(|ended| std::ptr::eq(ended.name, *name));
    let gone = element.runs.iter().filter(is_gone).map(|name| format!("{} [{}]", name.case, name.variant));
    ElementView {
        anchor: format!("{paper}-{}", element.id),
        id: element.id.clone(),
        place: element.place.clone(),
        statement: element.statement.clone(),
        implemented: element.implemented.clone().unwrap_or_default(),
        mark: mark(fate.status),
        reason: element.settled.as_ref().map(|(_, reason)| reason.clone()).unwrap_or_else(|| stands_under(fate)),
        note: element.note.clone(),
        values: fate.shown.iter().map(value).chain(fate.ended.iter().map(run)).collect(),
        missing: missing.chain(gone).collect(),
        control: element.control.clone().unwrap_or_default(),
        tests: element.tests.iter().map(ToString::to_string).collect(),
        figures: figures(fate, cases),
    }
}

/// The controls under which it would count as reproduced too.
fn stands_under(fate: &ElementOutcome<'_>) -> String {
    let names: Vec<String> = fate.accepts.iter().map(|(case, control)| format!("{control} of {case}")).collect();
    if names.is_empty() { String::new() } else { format!("it stands with wrong physics as well: {}", names.join(", ")) }
}

fn value(shown: &Shown<'_>) -> ValueView {
    let Shown { name, metric, status } = shown;
    ValueView {
        mark: status.map_or(VerdictMark::OBSERVED, mark),
        link: CasePageLink {
            case: name.case.clone(),
            anchor: anchor(&name.case, &metric.name, &metric.variant),
            text: metric.name.clone(),
        },
        // with spaces, so that a narrow column breaks between its parts
        variant: metric.variant.to_string().replace(',', ", "),
        value: with_unit(metric.value, &metric.unit),
        printed: name.printed.map(|printed| range(printed, &metric.unit)).unwrap_or_default(),
    }
}

/// A run that had to end.
fn run(ended: &Ended<'_>) -> ValueView {
    let Ended { name, run, status } = ended;
    let outcome = match &run.outcome {
        Outcome::Diverged { message, .. } => message.clone(),
        _ => format!("ran to its end, {}\u{202f}s", four_digits(run.simulated_time)),
    };
    ValueView {
        mark: mark(*status),
        link: CasePageLink { case: name.case.clone(), anchor: "runs".to_owned(), text: "run".to_owned() },
        variant: run.variant.to_string().replace(',', ", "),
        value: outcome,
        printed: String::new(),
    }
}

/// A printed range in words.
fn range(printed: Printed, unit: &str) -> String {
    let (low, high) = (printed.lowest, printed.highest);
    match (low.is_finite(), high.is_finite()) {
        (true, true) if low == high => with_unit(low, unit),
        (true, true) => format!("{} … {}", four_digits(low), with_unit(high, unit)),
        (true, false) => format!("≥ {}", with_unit(low, unit)),
        _ => format!("≤ {}", with_unit(high, unit)),
    }
}

/// The first figure of this report for every name.
fn figures(fate: &ElementOutcome<'_>, cases: &[CaseReport]) -> Vec<CasePageLink> {
    let drawn = fate.element.figures.iter().filter_map(|wanted| {
        let case = cases.iter().find(|case| case.name == wanted.case)?;
        let figure = case.figures.iter().find(|figure| figure.name.starts_with(&wanted.figure))?;
        Some(CasePageLink {
            case: case.name.clone(),
            anchor: format!("figure-{}-{}", case.name, figure.name),
            text: figure.name.clone(),
        })
    });
    drawn.collect()
}

/// Counts and statuses as JSON, for programs.
pub(super) fn json(tier: Tier, accounts: &[PaperSummary<'_>]) -> String {
    let papers: Vec<serde_json::Value> = accounts
        .iter()
        .map(|account| {
            let counts: serde_json::Map<String, serde_json::Value> = Status::ALL
                .into_iter()
                .map(|status| (status.word().to_owned(), account.count(status).into()))
                .collect();
            let elements: Vec<serde_json::Value> = account
                .elements
                .iter()
                .map(|fate| serde_json::json!({ "id": fate.element.id, "status": fate.status.word() }))
                .collect();
            serde_json::json!({ "paper": account.paper.name, "counts": counts, "elements": elements })
        })
        .collect();
    format!("{:#}\n", serde_json::json!({ "tier": tier_name(tier), "papers": papers }))
}
