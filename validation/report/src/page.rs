//! The first page: judged report → text → template.

use super::baseline::Change;
use super::failures;
use super::flows;
use super::judgement::{Judgement, KINDS, Severity};
use super::origin::provenance;
use super::overview;
use super::papers::{self, Status};
use super::papers_page;
use super::template::fill;
use super::view::{VerdictMark, typed};
use super::{CaseReport, DrawnFigure, Exit, Report, comparison, moved};
use serde_json::{Value, json};

/// Fills the template; `drawn` holds the figures of the report's cases in the report's order, `small` a picture a case.
pub(super) fn render(
    judgement: &Judgement<'_>,
    (drawn, small): (&[Vec<DrawnFigure>], &[DrawnFigure]),
    scatter: Vec<Value>,
) -> Result<String, minijinja::Error> {
    let report = judgement.report;
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "banner": banner(judgement),
        "counts": counts(judgement),
        "flows": flows::panels(judgement, drawn, small),
        "cases": overview::case_lines(&judgement.cases, small),
        "gates": overview::gates(judgement),
        "moved": moved::table(judgement),
        "scatter": scatter,
        "has_papers": !judgement.papers.is_empty(),
        "has_coverage": report.features.is_some(),
        "has_comparisons": !comparison::comparisons(report).is_empty(),
        "provenance": provenance(&report.generated),
        "command": typed(&report.generated.command),
        "script": include_str!("template/page.js"),
    });
    fill("index.html", &page)
}

/// The figures of a case among those of all.
pub(super) fn pictures<'d>(report: &Report, drawn: &'d [Vec<DrawnFigure>], case: &CaseReport) -> &'d [DrawnFigure] {
    let position = report.cases.iter().position(|other| std::ptr::eq(other, case));
    position.and_then(|position| drawn.get(position)).map_or(&[][..], Vec::as_slice)
}

fn banner(judgement: &Judgement<'_>) -> Value {
    let (mark, headline, detail) = headline(judgement);
    let items = failures::of(&judgement.cases);
    let weakest = failures::weakest(&items);
    json!({ "mark": mark, "headline": headline, "detail": detail, "weakest": weakest, "items": items })
}

/// Headline of the report and what it is made up of.
fn headline(judgement: &Judgement<'_>) -> (VerdictMark, String, String) {
    let tally = judgement.tally(None);
    let [new, expected] = [Severity::NewFailure, Severity::ExpectedFailure].map(|severity| tally.of(severity));
    let (failing, all) = (new + expected, plural(tally.all(), "gate"));
    let is_error = judgement.exit() != Exit::Held;
    if failing > 0 || is_error {
        let verb = if failing == 1 { "fails" } else { "fail" };
        let headline = if failing == 0 { "Failed".to_owned() } else { format!("{failing} of {all} {verb}") };
        // Expected failures are red as well: a gate outside its limit is not green for being expected.
        let mark = if is_error { VerdictMark::FAIL } else { VerdictMark::EXPECTED };
        return (mark, headline, details(judgement).join(" · "));
    }
    if judgement.moved() > 0 {
        let headline = format!("{} moved", plural(judgement.moved(), "value"));
        return (VerdictMark::MOVED, headline, format!("all {all} are within their limits"));
    }
    if tally.all() == 0 {
        let detail = "no metric of this report has a gate".to_owned();
        return (VerdictMark::OBSERVED, "Nothing was judged".to_owned(), detail);
    }
    let mut details = details(judgement);
    let unchanged = unchanged(judgement);
    if unchanged > 0 {
        details.insert(0, format!("{} as in the baseline", plural(unchanged, "value")));
    }
    let inconclusive = tally.of(Severity::Inconclusive);
    if inconclusive > 0 {
        let headline = format!("{} of {all} pass", tally.of(Severity::Pass));
        return (VerdictMark::INCONCLUSIVE, headline, details.join(" · "));
    }
    (VerdictMark::PASS, format!("All {all} pass"), details.join(" · "))
}

/// Values that are as in the baseline.
fn unchanged(judgement: &Judgement<'_>) -> usize {
    judgement.metrics().filter(|(_, judged)| matches!(judged.change, Change::Unchanged { .. })).count()
}

fn details(judgement: &Judgement<'_>) -> Vec<String> {
    let tally = judgement.tally(None);
    let open = [Status::NotReproduced, Status::Contradicted].map(|status| papers::count(&judgement.papers, status));
    let parts = [
        (tally.of(Severity::ExpectedFailure), "expected failure", ""),
        (open.iter().sum(), "element", " of the papers not reproduced or contradicted"),
        (judgement.listed_elsewhere, "expected failure", " at other tiers or cases"),
        (judgement.contradictions.len(), "result", " at odds with the list of expected failures"),
        (tally.of(Severity::Inconclusive), "inconclusive gate", ""),
        (judgement.not_judged(), "gate", " not judged"),
        (judgement.diverged(), "run", " diverged"),
        (judgement.moved(), "value", " moved from the baseline"),
    ];
    let words = parts.iter().filter(|(number, ..)| *number > 0);
    words.map(|(number, what, more)| format!("{}{more}", plural(*number, what))).collect()
}

fn counts(judgement: &Judgement<'_>) -> Vec<Value> {
    let meanings = [
        "against experiments and published fits",
        "against what the two papers say",
        "against exact solutions",
        "nothing lost; mass, momentum and energy add up",
    ];
    let names = ["Validation", "Statements", "Verification", "Bookkeeping"];
    let gates = |place: usize| {
        let tally = judgement.tally(Some(KINDS[place]));
        // the worst of them, in the order of severities
        let found = Severity::ALL.into_iter().filter(|severity| tally.of(*severity) > 0);
        let details = found.clone().filter(|severity| *severity != Severity::Pass);
        let details: Vec<String> = details.map(|own| format!("{} {}", tally.of(own), own.word())).collect();
        let statement = match tally.all() {
            0 => "no gates".to_owned(),
            all => format!("{} of {all} gates pass", tally.of(Severity::Pass)),
        };
        json!({
            "mark": VerdictMark::of(found.min()),
            "name": names[place],
            "meaning": meanings[place],
            "statement": statement,
            "detail": details.join(" · "),
        })
    };
    let mut counts: Vec<Value> = (0..KINDS.len()).map(gates).collect();
    counts.push(regression(judgement));
    counts.extend(papers_page::count(&judgement.papers));
    counts
}

/// The card of the changes from the baseline.
fn regression(judgement: &Judgement<'_>) -> Value {
    let (moved, unchanged) = (judgement.moved(), unchanged(judgement));
    let new = judgement.metrics().filter(|(_, judged)| judged.change == Change::New).count();
    let changes = [(moved, "moved"), (new, "new")].into_iter().filter(|(count, _)| *count > 0);
    json!({
        "mark": match (moved, unchanged) {
            (0, 0) => VerdictMark::OBSERVED,
            (0, _) => VerdictMark::PASS,
            _ => VerdictMark::MOVED,
        },
        "name": "Regression",
        "meaning": "against the committed baseline",
        "statement": match moved + unchanged {
            0 => "no baseline".to_owned(),
            compared => format!("{unchanged} of {compared} values unchanged"),
        },
        "detail": changes.map(|(count, what)| format!("{count} {what}")).collect::<Vec<_>>().join(" · "),
    })
}

fn plural(number: usize, word: &str) -> String {
    if number == 1 { format!("1 {word}") } else { format!("{number} {word}s") }
}
