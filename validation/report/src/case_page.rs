//! The page of one case: what fails, its figures, then verdicts, parameters and runs. `run` writes it alone, `report` among others.

use super::failures;
use super::judgement::{JudgedCase, JudgedMetric, Rank};
use super::origin::{provenance, seconds};
use super::rows::{rows, vanished};
use super::template::fill;
use super::view::{VerdictMark, typed};
use super::{CaseReport, DrawnFigure, Report, power};
use crate::case::RunSummary;
use crate::evidence::shipped_tables;
use crate::metric::{self, Metric, MetricKind, Variant};
use crate::number::{count, four_digits};
use crate::observation::Outcome;
use serde_json::{Value, json};

/// Fills the template for one case: in its report's folder `cases/CASE` if it has neighbours there, else in a folder of its
/// own.
pub(super) fn render(
    report: &Report,
    judged: &JudgedCase<'_>,
    drawn: &[DrawnFigure],
    neighbours: Option<Value>,
) -> Result<String, minijinja::Error> {
    let page = json!({
        "title": report.title,
        "tier": report.tier.name(),
        "case": case(judged, drawn),
        // whether there is a baseline to have moved from
        "compared": !report.baseline.is_empty(),
        // the report that the page belongs to, if it does
        "report": neighbours,
        "provenance": provenance(&report.generated),
        "script": include_str!("template/page.js"),
    });
    fill("case.html", &page)
}

/// Names, within the case's folder, and texts of the tables of reference data that belong to a case.
pub(super) fn tables(case: &str) -> impl Iterator<Item = (&'static str, &'static str)> {
    shipped_tables().filter_map(move |(name, text)| Some((name.strip_prefix(case)?.strip_prefix('/')?, text)))
}

/// The figures of a case among those of all.
pub(super) fn pictures<'d>(report: &Report, drawn: &'d [Vec<DrawnFigure>], case: &CaseReport) -> &'d [DrawnFigure] {
    let position = report.cases.iter().position(|other| std::ptr::eq(other, case));
    position.and_then(|position| drawn.get(position)).map_or(&[][..], Vec::as_slice)
}

fn case(judged: &JudgedCase<'_>, drawn: &[DrawnFigure]) -> Value {
    let case = judged.case;
    let mut rows = rows(&case.name, &judged.metrics);
    let runs: Vec<&Variant> = case.runs.iter().map(|run| &run.variant).collect();
    for (row, judged) in rows.iter_mut().zip(&judged.metrics) {
        if judged.metric.kind != MetricKind::Bookkeeping {
            row["figure"] = figure(judged.metric, drawn, &runs).into();
        }
    }
    let not_judged = case.not_judged.iter().map(|(key, reason)| format!("{}: {reason}", vanished(key)));
    json!({
        "name": case.name,
        "summary": case.summary,
        "description": case.description.split("\n\n").collect::<Vec<_>>(),
        "mark": VerdictMark::of_case(judged),
        "statement": case_statement(judged),
        "failures": failures::of(std::slice::from_ref(judged)),
        "groups": groups(rows, &judged.metrics),
        "vanished": judged.vanished.iter().map(vanished).collect::<Vec<_>>(),
        "not_judged": not_judged.collect::<Vec<_>>(),
        "controls": power::table(case),
        "figures": drawn,
        // tables of reference data that are written beside the page
        "tables": tables(&case.name).map(|(name, _)| name).collect::<Vec<_>>(),
        "parameters": shown(&case.parameters_toml),
        "command": typed(&case.command),
        "runs": case.runs.iter().map(run).collect::<Vec<_>>(),
    })
}

/// Rows of a table that is shown unfolded, at most.
const SHORT: usize = 12;

/// The rows by what they say: judged ones, the run's own account, and what is only observed. The latter two are folded, and a
/// long table too: the page's failures and figures stand above.
fn groups(rows: Vec<Value>, metrics: &[JudgedMetric<'_>]) -> Vec<Value> {
    let titles = [("judged", "Judged"), ("bookkeeping", "Bookkeeping"), ("observed", "Observed only")];
    let mut groups = titles.map(|title| (title, Vec::new()));
    for (row, judged) in rows.into_iter().zip(metrics) {
        let place = match (judged.metric.kind, judged.rank()) {
            (MetricKind::Bookkeeping, _) => 1,
            (_, Rank::Observed) => 2,
            _ => 0,
        };
        groups[place].1.push(row);
    }
    let view = |((name, title), rows): &((&str, &str), Vec<Value>)| {
        let is_open = *name == "judged" && rows.len() <= SHORT;
        json!({ "name": name, "title": title, "is_open": is_open, "rows": rows })
    };
    groups.iter().filter(|(_, rows)| !rows.is_empty()).map(view).collect()
}

/// The figure that is named like a value of a metric's variant, else the one that shares most words with its name and, of equals, that of
/// the metric's own run. Nothing where a single word of a caption is all that is shared, and no figure that is named like another run.
fn figure(metric: &Metric, drawn: &[DrawnFigure], runs: &[&Variant]) -> String {
    // a figure `velocity-sand-0.9-20` is that of the run with the values `sand-0.9-20`
    let run_of = |drawn: &DrawnFigure| {
        let named = |run: &&&Variant| drawn.name.ends_with(&format!("-{}", run.file_name_of_values()));
        runs.iter().filter(named).max_by_key(|run| run.parts().count())
    };
    let is_own = |run: &&Variant| metric.variant.includes(run);
    let is_word_of = |text: &str, word: &str| text.split(|c: char| !c.is_alphanumeric()).any(|other| other == word);
    let shared = |drawn: &DrawnFigure| {
        let caption = drawn.caption.to_lowercase();
        let weight = |word: &str| match word {
            _ if word.len() < 4 => 0,
            _ if is_word_of(&drawn.name, word) => 3,
            _ if is_word_of(&caption, word) => 1,
            _ => 0,
        };
        metric.name.split('_').map(weight).sum::<usize>()
    };
    // a figure `heap` is that of a run `heap`, or else of one `local-heap`
    let of_run = |drawn: &DrawnFigure| {
        let by_value = |value: &str| match value {
            _ if value == drawn.name => 2,
            _ if value.split('-').any(|word| word == drawn.name) => 1,
            _ => 0,
        };
        metric.variant.parts().map(|(_, value)| by_value(value.text())).max().unwrap_or_default()
    };
    let fit = |drawn: &DrawnFigure| (of_run(drawn), shared(drawn), run_of(drawn).is_some());
    // `energy-budget-sand` shows nothing of a run with another material
    let is_of_another = |drawn: &&DrawnFigure| {
        let differs = |(key, value): &(&str, &metric::Value)| metric.variant.get(key).is_some_and(|own| own != *value);
        let others = runs.iter().flat_map(|run| run.parts()).filter(differs);
        let mut words = others.map(|(_, value)| value.text()).filter(|word| word.len() > 1);
        run_of(drawn).is_none() && words.any(|word| is_word_of(&drawn.name, word))
    };
    let is_sound = |drawn: &&DrawnFigure| drawn.failure.is_none() && run_of(drawn).is_none_or(is_own);
    let candidates = drawn.iter().filter(is_sound).filter(|drawn| !is_of_another(drawn));
    // the first of equals
    let best = candidates.rev().max_by_key(|drawn| fit(drawn));
    let is_enough = |(of_run, words, is_own): (usize, usize, bool)| of_run > 0 || words > 1 || words > 0 && is_own;
    best.filter(|best| is_enough(fit(best))).map(|best| best.name.clone()).unwrap_or_default()
}

/// The gates of a case and its other metrics, in words.
pub(super) fn case_statement(judged: &JudgedCase<'_>) -> String {
    let tally = judged.tally();
    let observed = judged.metrics.iter().filter(|metric| metric.rank() == Rank::Observed).count();
    let moved = judged.metrics.iter().filter(|metric| metric.change.has_moved()).count();
    let others = [
        (observed, "observed"),
        (moved, "moved"),
        (judged.vanished.len(), "vanished"),
        (judged.diverged.len(), "diverged"),
    ];
    let others = others.iter().filter(|(number, _)| *number > 0).map(|(number, word)| format!("{number} {word}"));
    let words: Vec<String> = (tally.all() > 0).then(|| tally.in_words()).into_iter().chain(others).collect();
    if words.is_empty() { "no metrics".to_owned() } else { words.join("; ") }
}

fn run(run: &RunSummary) -> Value {
    let (look, word, outcome) = match &run.outcome {
        Outcome::Finished => (VerdictMark::PASS, "finished", ""),
        Outcome::Stopped { criterion } => (VerdictMark::PASS, "stopped", criterion.as_str()),
        Outcome::Diverged { message, expected: true } => (VerdictMark::OBSERVED, "diverged as expected", &**message),
        Outcome::Diverged { message, expected: false } => (VerdictMark::FAIL, "diverged", &**message),
    };
    json!({
        "variant": run.variant.to_string(),
        "mark": VerdictMark { word, ..look },
        "outcome": outcome,
        "particles": count(run.particles as u64),
        "steps": count(run.steps),
        "simulated_time": four_digits(run.simulated_time),
        "wall_seconds": seconds(run.wall_seconds),
        "threads": run.threads,
        "pace": run.microseconds_per_particle_step.map_or_else(|| "–".to_owned(), four_digits),
        "hash": run.state_hash,
        "short_hash": run.state_hash.chars().take(12).collect::<String>(),
        "from_store": run.from_store,
    })
}

/// A document with its longest lines cut, which hold meshes: a page is for readers.
fn shown(document: &str) -> String {
    const LONGEST: usize = 100_000;
    let line = |line: &str| match line.char_indices().nth(LONGEST) {
        None => format!("{line}\n"),
        Some(_) => format!("{} … (whole in case.toml)\n", line.chars().take(LONGEST / 100).collect::<String>()),
    };
    document.lines().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_metric_links_to_the_figure_of_its_own_run() {
        let caption = "velocity over depth, with a line through the flowing layer";
        let drawn = ["scaling", "velocity-sand-0.9-20", "velocity-sand-3-20"].map(|name| DrawnFigure {
            caption: caption.to_owned(),
            name: name.to_owned(),
            files: crate::FIGURE_FILES,
            size: None,
            failure: None,
        });
        let [shallow, tall, other] = ["0.9", "3", "5"].map(|ratio| {
            format!("material=sand,aspect_ratio={ratio},resolution=20").parse::<Variant>().expect("a variant")
        });
        let runs = [&shallow, &tall, &other];
        let linked = |name: &str, run: &Variant| {
            let metric = Metric::observed(name, &run.clone().and("part", 1), 1.0, "-");
            figure(&metric, &drawn, &runs)
        };
        assert_eq!(linked("flowing_layer_r_squared", &tall), "velocity-sand-3-20");
        assert_eq!(linked("flowing_layer_r_squared", &shallow), "velocity-sand-0.9-20");
        assert_eq!(linked("flowing_layer_r_squared", &other), "scaling", "not that of another run");
        assert_eq!(linked("rest_time", &tall), "", "a run's figure that says nothing of it");
    }
}
