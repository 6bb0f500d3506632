//! The first page and that of all gates: judged report → text → template.

use super::failures;
use super::flows;
use super::judgement::{Judgement, KINDS, Severity, plural};
use super::origin::provenance;
use super::overview;
use super::papers::Status;
use super::template::fill;
use super::view::{VerdictMark, typed};
use super::{DrawnFigure, Exit, comparison, moved};
use crate::metric::MetricKind;
use serde_json::{Value, json};

/// Fills the template; `drawn` holds the figures of the report's cases in the report's order, `small` those of the flows.
pub(super) fn render(
    judgement: &Judgement<'_>,
    (drawn, small): (&[Vec<DrawnFigure>], &[DrawnFigure]),
) -> Result<String, minijinja::Error> {
    let report = judgement.report;
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "banner": banner(judgement),
        "counts": counts(judgement),
        "flows": flows::panels(judgement, drawn, small),
        "cases": overview::case_lines(judgement, drawn),
        "moved": moved::table(judgement),
        "papers": papers(judgement),
        "has_coverage": report.features.is_some(),
        "has_comparisons": !comparison::comparisons(report).is_empty(),
        "provenance": provenance(&report.generated),
        "command": typed(&report.generated.command),
        "script": include_str!("template/page.js"),
    });
    fill("index.html", &page)
}

/// Number of reproduced elements of both papers, in words; none without papers.
fn papers(judgement: &Judgement<'_>) -> Option<String> {
    let fates = || judgement.papers.iter().flat_map(|account| &account.elements);
    let (all, tested) = (fates().count(), fates().filter(|fate| fate.rests_on_tests()).count());
    let reproduced = fates().filter(|fate| fate.status == Status::Reproduced).count();
    let by_results = reproduced - tested;
    (all > 0).then(|| {
        format!(
            "{reproduced} of {all} elements reproduced ({by_results} by results of runs, {tested} by tests of equations and inputs alone)"
        )
    })
}

/// Fills the template of the page of all gates.
pub(super) fn gates(judgement: &Judgement<'_>) -> Result<String, minijinja::Error> {
    let page = json!({
        "title": judgement.report.title,
        "tier": judgement.report.tier.name(),
        "statement": judgement.tally().in_words(),
        "gates": overview::gates(judgement),
        "script": include_str!("template/page.js"),
    });
    fill("gates.html", &page)
}

/// Effect of a change: new failures and values that moved from the baseline, then all gates.
fn banner(judgement: &Judgement<'_>) -> Value {
    let tally = judgement.tally();
    let (new, moved) = (tally.of(Severity::NewFailure), judgement.moved());
    let at_odds = judgement.metrics().filter(|(_, judged)| judged.listed.is_error()).count();
    let mark = match (judgement.exit() == Exit::Held, moved, tally.all()) {
        (false, ..) => VerdictMark::FAIL,
        (_, 1.., _) => VerdictMark::MOVED,
        (.., 0) => VerdictMark::OBSERVED,
        _ => VerdictMark::PASS,
    };
    let unchanged = judgement.unchanged();
    let compared = match moved + unchanged {
        0 => "no baseline".to_owned(),
        all => format!("{moved} of {} moved, {unchanged} unchanged", plural(all, "value")),
    };
    let others = [
        (judgement.diverged(), "run", "diverged"),
        (tally.of(Severity::UnexpectedPass), "expected failure", "no longer failing: update the list"),
        (judgement.contradictions.len().saturating_sub(at_odds), "expected failure", "not measured by any study"),
    ];
    let others = others.iter().filter(|(number, ..)| *number > 0);
    let others = others.map(|(number, what, how)| format!("; {} {how}", plural(*number, what))).collect::<String>();
    let headline = match tally.all() {
        0 => "Nothing was judged".to_owned(),
        _ => format!("{}; {compared}{others}", plural(new, Severity::NewFailure.word())),
    };
    let items = failures::of(&judgement.cases);
    json!({ "mark": mark, "headline": headline, "detail": tally.in_words(), "weakest": failures::weakest(&items), "items": items })
}

/// Gates of each kind, those against measurements first.
fn counts(judgement: &Judgement<'_>) -> Vec<Value> {
    let meanings = [
        "experiments and published fits",
        "statements of the two papers",
        "solutions of the same equations",
        "balances of mass, momentum and energy",
    ];
    let count = |((kind, name), meaning): ((MetricKind, &str), &str)| {
        let tally = judgement.tally_of(kind);
        let mark = VerdictMark::of(tally.0.iter().min().copied());
        json!({ "mark": mark, "name": name, "meaning": meaning, "statement": tally.in_words() })
    };
    KINDS.into_iter().zip(meanings).map(count).collect()
}
