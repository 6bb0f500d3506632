//! The first page: judged report → text → template.

use super::failures;
use super::flows;
use super::judgement::{GateTally, Judgement};
use super::origin::provenance;
use super::overview;
use super::papers::{self, Status};
use super::papers_page;
use super::template::fill;
use super::view::{VerdictMark, typed};
use super::{CaseReport, DrawnFigure, Report, comparison, drift};
use serde_json::{Value, json};

/// Fills the template; `drawn` holds the figures of the report's cases in the report's order, `small` a picture a case.
pub(super) fn render(
    report: &Report,
    judgement: &Judgement<'_>,
    (drawn, small): (&[Vec<DrawnFigure>], &[DrawnFigure]),
    scatter: Vec<Value>,
) -> Result<String, minijinja::Error> {
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "banner": banner(judgement),
        "counts": counts(judgement),
        "flows": flows::panels(report, drawn, small),
        "cases": overview::case_lines(&judgement.cases, small),
        "gates": overview::gates(judgement),
        "drift": drift::table(report, judgement),
        "scatter": scatter,
        "has_papers": !judgement.papers.is_empty(),
        "has_coverage": report.features.is_some(),
        "has_comparisons": !comparison::comparisons(report).is_empty(),
        "provenance": provenance(&report.generated),
        "command": typed(&report.generated.command),
        "date": report.generated.date,
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

fn headline(judgement: &Judgement<'_>) -> (VerdictMark, String, String) {
    let failing = judgement.failing_gates();
    let holding = judgement.holding_gates();
    let blind = judgement.blind_gates();
    let all = failing + holding + blind;
    let not_reproduced = judgement.statements.known;
    let known = judgement.tallies().iter().map(|tally| tally.known).sum::<usize>() - not_reproduced;
    let mut details = Vec::new();
    if known > 0 {
        details.push(format!("{known} are known defects"));
    }
    let open: usize = [Status::NotReproduced, Status::Contradicted]
        .map(|status| papers::count(&judgement.papers, status))
        .iter()
        .sum();
    if not_reproduced > 0 {
        details.push(format!("{} of the papers not reproduced", plural(not_reproduced, "statement")));
    }
    if open > 0 {
        details.push(format!("{open} of the papers' elements not reproduced or contradicted"));
    }
    if judgement.known_elsewhere > 0 {
        details.push(format!("{} at other tiers or cases", plural(judgement.known_elsewhere, "known failure")));
    }
    if judgement.contradictions > 0 {
        details.push(format!("{} at odds with the list of known failures", plural(judgement.contradictions, "result")));
    }
    if blind > 0 {
        details.push(format!("{} would hold with wrong physics as well", plural(blind, "gate")));
    }
    if judgement.not_judged > 0 {
        details.push(format!("{} no longer judged", plural(judgement.not_judged, "gate")));
    }
    if judgement.diverged > 0 {
        details.push(format!("{} diverged", plural(judgement.diverged, "run")));
    }
    if judgement.drift.drifted > 0 {
        details.push(format!("{} drifted from the baseline", plural(judgement.drift.drifted, "value")));
    }
    let detail = details.join(" · ");
    if judgement.has_unexpected_failure() || failing > 0 {
        let verb = if failing == 1 { "fails" } else { "fail" };
        let headline =
            if failing == 0 { "Failed".to_owned() } else { format!("{failing} of {} {verb}", plural(all, "gate")) };
        // Known failures are red as well: a gate that does not hold is not green for being expected.
        (if judgement.has_unexpected_failure() { VerdictMark::FAIL } else { VerdictMark::KNOWN }, headline, detail)
    } else if judgement.drift.drifted > 0 {
        (
            VerdictMark::DRIFT,
            format!("{} drifted", plural(judgement.drift.drifted, "value")),
            format!("all {} hold", plural(all, "gate")),
        )
    } else if judgement.is_green() {
        let unchanged = judgement.drift.unchanged;
        if unchanged > 0 {
            details.insert(0, format!("{} as in the baseline", plural(unchanged, "value")));
        }
        let detail = details.join(" · ");
        let headline = format!("All {} hold", plural(all, "gate"));
        (if blind > 0 { VerdictMark::KNOWN } else { VerdictMark::PASS }, headline, detail)
    } else {
        (VerdictMark::OBSERVED, "Nothing was judged".to_owned(), "no metric of this report has a gate".to_owned())
    }
}

fn counts(judgement: &Judgement<'_>) -> Vec<Value> {
    let gates = |name: &str, meaning: &str, tally: GateTally, known: &str| {
        let all = tally.hold + tally.cannot_tell + tally.fail + tally.known;
        let mut details = Vec::new();
        if tally.fail > 0 {
            details.push(format!("{} {}", tally.fail, if tally.fail == 1 { "fails" } else { "fail" }));
        }
        if tally.known > 0 {
            details.push(format!("{} {known}", tally.known));
        }
        if tally.cannot_tell > 0 {
            details.push(format!(
                "{} cannot tell: they reject no control, or are narrower than the uncertainty",
                tally.cannot_tell
            ));
        }
        let mark = match tally {
            GateTally { hold: 0, cannot_tell: 0, fail: 0, known: 0 } => VerdictMark::OBSERVED,
            GateTally { cannot_tell: 0, fail: 0, known: 0, .. } => VerdictMark::PASS,
            GateTally { fail: 0, .. } => VerdictMark::KNOWN,
            GateTally { .. } => VerdictMark::FAIL,
        };
        let statement = if all == 0 { "no gates".to_owned() } else { format!("{} of {all} gates hold", tally.hold) };
        let detail = details.join(" · ");
        json!({ "mark": mark, "name": name, "meaning": meaning, "statement": statement, "detail": detail })
    };
    let Judgement { bookkeeping, verification, validation, statements, drift, .. } = judgement;
    let compared = drift.unchanged + drift.drifted;
    let changes = [(drift.drifted, "drifted"), (drift.new, "new")].into_iter().filter(|(count, _)| *count > 0);
    let regression = json!({
        "mark": match (drift.drifted, compared) {
            (0, 0) => VerdictMark::OBSERVED,
            (0, _) => VerdictMark::PASS,
            _ => VerdictMark::DRIFT,
        },
        "name": "Regression",
        "meaning": "against the committed baseline",
        "statement": match compared {
            0 => "no baseline".to_owned(),
            _ => format!("{} of {compared} values unchanged", drift.unchanged),
        },
        "detail": changes.map(|(count, what)| format!("{count} {what}")).collect::<Vec<_>>().join(" · "),
    });
    let mut counts = vec![
        gates("Validation", "against experiments and published fits", *validation, "known to fail"),
        gates("Statements", "against what the two papers say", *statements, "not reproduced"),
        gates("Verification", "against exact solutions", *verification, "known to fail"),
        gates("Bookkeeping", "nothing lost; mass, momentum and energy add up", *bookkeeping, "known to fail"),
        regression,
    ];
    counts.extend(papers_page::count(&judgement.papers));
    counts
}

fn plural(number: usize, word: &str) -> String {
    if number == 1 { format!("1 {word}") } else { format!("{number} {word}s") }
}
