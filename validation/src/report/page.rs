//! The page: judged report → text → template.

use super::accepted::tier_name;
use super::judgement::{JudgedCase, Judgement, Severity, Tally};
use super::papers::{self, Status};
use super::papers_page;
use super::rows::{mark, note, rows, statement, vanished, worst_mark};
use super::template::fill;
use super::view::{Banner, BannerItem, Case, Count, Mark, Page, Picture, Run};
use super::{CaseReport, Drawn, Provenance, Report, drift, scatter};
use crate::case::RunSummary;
use crate::metric::Verdict;
use crate::number::{count, four_digits};
use crate::observation::Outcome;

/// More lines than this do not fit on a first screen; the rest stands in the table right below.
const BANNER_LINES: usize = 14;

/// Fills the template; `drawn` holds the figures of the report's cases in the report's order.
pub(super) fn render(
    report: &Report,
    judgement: &Judgement<'_>,
    drawn: &[Vec<Drawn>],
    scatter: Vec<scatter::Row>,
) -> Result<String, minijinja::Error> {
    let pictures = |case: &CaseReport| {
        let position = report.cases.iter().position(|other| std::ptr::eq(other, case));
        position.and_then(|position| drawn.get(position)).map_or(&[][..], Vec::as_slice)
    };
    let page = Page {
        title: report.title.clone(),
        tier: tier_name(report.tier),
        banner: banner(judgement),
        counts: counts(judgement),
        drift: drift::table(report, judgement),
        scatter,
        cases: judgement.cases.iter().map(|judged| case(judged, pictures(judged.case))).collect(),
        provenance: provenance(&report.generated),
        command: report.generated.command.clone(),
        date: report.generated.date.clone(),
        style: include_str!("template/style.css"),
        script: include_str!("template/filter.js"),
    };
    let partials = [
        ("drift.html", include_str!("template/drift.html")),
        ("scatter.html", include_str!("template/scatter.html")),
        ("width.html", include_str!("template/width.html")),
    ];
    fill("index.html", include_str!("template/index.html"), &partials, &page)
}

fn banner(judgement: &Judgement<'_>) -> Banner {
    let mut items: Vec<(Severity, BannerItem)> = Vec::new();
    for case in &judgement.cases {
        for &(variant, message) in &case.diverged {
            let item = BannerItem {
                mark: Mark { word: "diverged", ..Mark::FAIL },
                case: case.case.name.clone(),
                what: "a run diverged".to_owned(),
                variant: variant.to_string(),
                statement: message.to_owned(),
                note: String::new(),
            };
            items.push((Severity::Failure, item));
        }
        for judged in case.metrics.iter().filter(|judged| judged.severity() <= Severity::Drifted) {
            let item = BannerItem {
                mark: worst_mark(judged),
                case: case.case.name.clone(),
                what: judged.metric.name.clone(),
                variant: judged.metric.variant.to_string(),
                statement: statement(judged),
                note: note(judged),
            };
            items.push((judged.severity(), item));
        }
        for key in &case.vanished {
            let item = BannerItem {
                mark: Mark { word: "vanished", ..Mark::DRIFT },
                case: case.case.name.clone(),
                what: key.metric.clone(),
                variant: key.variant.to_string(),
                statement: "in the baseline, but no longer measured".to_owned(),
                note: String::new(),
            };
            items.push((Severity::Drifted, item));
        }
    }
    items.sort_by_key(|(severity, _)| *severity);
    let omitted = items.len().saturating_sub(BANNER_LINES);
    let (mark, headline, detail) = headline(judgement);
    Banner {
        mark,
        headline,
        detail,
        items: items.into_iter().take(BANNER_LINES).map(|(_, item)| item).collect(),
        omitted,
    }
}

fn headline(judgement: &Judgement<'_>) -> (Mark, String, String) {
    let failing = judgement.failing_gates();
    let holding = judgement.holding_gates();
    let all = failing + holding;
    let not_reproduced = judgement.statements.known;
    let known = judgement.tallies().iter().map(|tally| tally.known).sum::<usize>() - not_reproduced;
    let mut details = Vec::new();
    if known > 0 {
        details.push(format!("{known} of them known"));
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
        (if judgement.has_unexpected_failure() { Mark::FAIL } else { Mark::KNOWN }, headline, detail)
    } else if judgement.drift.drifted > 0 {
        (
            Mark::DRIFT,
            format!("{} drifted", plural(judgement.drift.drifted, "value")),
            format!("all {} hold", plural(all, "gate")),
        )
    } else if judgement.is_green() {
        let unchanged = judgement.drift.unchanged;
        if unchanged > 0 {
            details.insert(0, format!("{} as in the baseline", plural(unchanged, "value")));
        }
        let detail = details.join(" · ");
        (Mark::PASS, format!("All {} hold", plural(all, "gate")), detail)
    } else {
        (Mark::OBSERVED, "Nothing was judged".to_owned(), "no metric of this report has a gate".to_owned())
    }
}

fn counts(judgement: &Judgement<'_>) -> Vec<Count> {
    let gates = |name, meaning, tally: Tally, known: &str| {
        let all = tally.hold + tally.fail + tally.known;
        let mut details = Vec::new();
        if tally.fail > 0 {
            details.push(format!("{} {}", tally.fail, if tally.fail == 1 { "fails" } else { "fail" }));
        }
        if tally.known > 0 {
            details.push(format!("{} {known}", tally.known));
        }
        let mark = match tally {
            Tally { hold: 0, fail: 0, known: 0 } => Mark::OBSERVED,
            Tally { fail: 0, known: 0, .. } => Mark::PASS,
            Tally { fail: 0, .. } => Mark::KNOWN,
            Tally { .. } => Mark::FAIL,
        };
        let statement = if all == 0 { "no gates".to_owned() } else { format!("{} of {all} gates hold", tally.hold) };
        Count { mark, name, meaning, statement, detail: details.join(" · "), link: None }
    };
    let Judgement { bookkeeping, verification, validation, statements, drift, .. } = judgement;
    let compared = drift.unchanged + drift.drifted;
    let changes = [(drift.drifted, "drifted"), (drift.new, "new")].into_iter().filter(|(count, _)| *count > 0);
    let regression = Count {
        mark: match (drift.drifted, compared) {
            (0, 0) => Mark::OBSERVED,
            (0, _) => Mark::PASS,
            _ => Mark::DRIFT,
        },
        name: "Regression",
        meaning: "against the committed baseline",
        statement: match compared {
            0 => "no baseline".to_owned(),
            _ => format!("{} of {compared} values unchanged", drift.unchanged),
        },
        detail: changes.map(|(count, what)| format!("{count} {what}")).collect::<Vec<_>>().join(" · "),
        link: None,
    };
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

fn case(judged: &JudgedCase<'_>, drawn: &[Drawn]) -> Case {
    let case = judged.case;
    let severity = judged.severity();
    Case {
        name: case.name.clone(),
        summary: case.summary.clone(),
        description: case.description.split("\n\n").map(|text| text.trim().to_owned()).collect(),
        mark: mark(severity),
        open: severity <= Severity::Drifted,
        statement: case_statement(judged),
        rows: rows(&case.name, &judged.metrics),
        vanished: judged.vanished.iter().map(vanished).collect(),
        figures: drawn.iter().map(picture).collect(),
        parameters: case.parameters_toml.clone(),
        command: case.command.clone(),
        runs: case.runs.iter().map(run).collect(),
    }
}

fn case_statement(judged: &JudgedCase<'_>) -> String {
    let drifted = judged.metrics.iter().filter(|metric| metric.drift.is_failure()).count();
    let parts = [
        (judged.count(Severity::Failure), "failing"),
        (judged.count(Severity::KnownFailure), "known to fail"),
        (judged.metrics.iter().filter(|metric| metric.verdict == Verdict::Pass).count(), "holding"),
        (judged.count(Severity::Observed), "observed"),
        (drifted, "drifted"),
        (judged.vanished.len(), "vanished"),
        (judged.diverged.len(), "diverged"),
    ];
    let words: Vec<String> =
        parts.iter().filter(|(number, _)| *number > 0).map(|(number, word)| format!("{number} {word}")).collect();
    if words.is_empty() { "no metrics".to_owned() } else { words.join(" · ") }
}

pub(super) fn picture(drawn: &Drawn) -> Picture {
    Picture {
        name: drawn.name.clone(),
        caption: drawn.caption.clone(),
        moves: drawn.moves,
        failure: drawn.failure.clone(),
    }
}

fn run(run: &RunSummary) -> Run {
    let (mark, outcome) = match &run.outcome {
        Outcome::Finished => (Mark { word: "finished", ..Mark::PASS }, String::new()),
        Outcome::Stopped { criterion } => (Mark { word: "stopped", ..Mark::PASS }, criterion.clone()),
        Outcome::Diverged { message, expected: true } => {
            (Mark { word: "diverged as expected", ..Mark::OBSERVED }, message.clone())
        }
        Outcome::Diverged { message, expected: false } => (Mark { word: "diverged", ..Mark::FAIL }, message.clone()),
    };
    Run {
        variant: run.variant.to_string(),
        mark,
        outcome,
        particles: count(run.particles as u64),
        steps: count(run.steps),
        simulated_time: four_digits(run.simulated_time),
        wall_seconds: seconds(run.wall_seconds),
        threads: run.threads,
        pace: run.microseconds_per_particle_step.map_or_else(|| "–".to_owned(), four_digits),
        hash: run.state_hash.clone(),
        short_hash: run.state_hash.chars().take(12).collect(),
        from_store: run.from_store,
    }
}

fn provenance(provenance: &Provenance) -> Vec<(&'static str, String)> {
    let commit = if provenance.commit.is_empty() { "unknown".to_owned() } else { provenance.commit.clone() };
    vec![
        ("version", provenance.version.clone()),
        ("commit", commit),
        ("threads", provenance.threads.to_string()),
        ("wall time", format!("{}\u{202f}s", seconds(provenance.wall_seconds))),
    ]
}

/// Wall times are known to a tenth of a second at best.
fn seconds(seconds: f64) -> String {
    if seconds.is_finite() { format!("{seconds:.1}") } else { "unknown".to_owned() }
}

fn plural(number: usize, word: &str) -> String {
    if number == 1 { format!("1 {word}") } else { format!("{number} {word}s") }
}
