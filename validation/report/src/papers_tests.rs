//! Statuses follow from the numbers; every row is on the page, and its links land.

use super::super::tests::write;
use super::super::{Report, Severity, judge, papers_page, tests};
use super::*;
use crate::control::{Control, ControlTrial, Found};
use crate::figure::Figure;
use crate::metric::{Limit, MetricKind, Origin, Variant};
use crate::store::Drawings;

const ROWS: &str = r#"
title = "A paper"
source = "its text"

[[element]]
id = "eq-1"
place = "1"
says = "gated"
metrics = [{ case = "film", metric = "velocity_l2", variant = "fluid=newtonian" }]

[[element]]
id = "number-1"
place = "1"
says = "printed <5>"
metrics = [{ case = "film", metric = "thickness", printed = { value = 5.0, at_least = 4.5, at_most = 5.5 } }]
figures = ["film/oper"]

[[element]]
id = "number-2"
place = "1"
says = "a shortcoming of ours"
metrics = [{ case = "film", metric = "thickness", printed = { at_least = 5.0, shortcoming = true } }]

[[element]]
id = "claim-1"
place = "1"
says = "both"
implemented = "solver/src/vector.rs"
tests = ["solver/src/vector.rs::a_deviator_has_no_trace"]
metrics = [{ case = "film", metric = "velocity_l2" }, { case = "film", metric = "thickness", printed = { at_most = 6.0 } }]

[[element]]
id = "claim-2"
place = "1"
says = "tested only"
implemented = "solver/src/vector.rs"
tests = ["solver/src/vector.rs::a_deviator_has_no_trace"]

[[element]]
id = "claim-3"
place = "1"
says = "settled"
metrics = [{ case = "film", metric = "thickness" }]
not_covered = "replaced: by something else"
"#;

fn gated(value: f64) -> Metric {
    Metric::observed("velocity_l2", &Variant::of("fluid", "newtonian"), value, "%")
        .gated(Limit::AtMost(1.0), "a reason")
}

fn thickness(value: f64) -> Metric {
    Metric::observed("thickness", &Variant::default(), value, "cm")
}

fn report(metrics: Vec<Metric>) -> Report {
    let paper = Paper::parse("made-up", ROWS).expect("readable");
    let figure = Figure { name: "operators".to_owned(), caption: String::new(), panels: Vec::new(), columns: 1 };
    let mut film = tests::case("film", metrics);
    film.result.figures = vec![figure];
    film.controls =
        vec![trial("velocity_l2", &gated(2.0)), trial("other", &thickness(9.0)), trial("other", &thickness(4.0))];
    Report { papers: vec![paper].leak(), ..tests::report(vec![film]) }
}

fn statuses(metrics: Vec<Metric>) -> Vec<&'static str> {
    let report = report(metrics);
    judge(&report).papers[0].elements.iter().map(|fate| fate.status.word()).collect()
}

#[test]
fn statuses_are_computed_from_gates_and_printed_numbers() {
    let good = ["reproduced", "reproduced", "reproduced", "reproduced", "reproduced", "not covered"];
    assert_eq!(statuses(vec![gated(0.5), thickness(5.2)]), good);
    let off = ["not reproduced", "contradicted", "reproduced", "contradicted", "reproduced", "not covered"];
    assert_eq!(statuses(vec![gated(2.0), thickness(6.1)]), off, "the worst of several counts");
    let short = ["reproduced", "contradicted", "not reproduced", "reproduced", "reproduced", "not covered"];
    assert_eq!(statuses(vec![gated(0.5), thickness(4.0)]), short);
    let lost = ["reproduced", "not reproduced", "not reproduced", "not reproduced", "reproduced", "not covered"];
    assert_eq!(statuses(vec![gated(0.5), thickness(f64::NAN)]), lost, "no number contradicts nothing");
    let absent = ["not covered", "not covered", "not covered", "not covered", "reproduced", "not covered"];
    assert_eq!(statuses(Vec::new()), absent);
    let half = statuses(vec![gated(0.5)]);
    assert_eq!((half[0], half[3]), ("reproduced", "not covered"), "half of what a row names does not reproduce it");
    assert_eq!(statuses(vec![gated(2.0)])[3], "not reproduced", "but half of it can fail it");
    let observed = Metric { gate: None, ..gated(0.5) };
    assert_eq!(statuses(vec![observed])[0], "not covered", "what is only observed judges nothing");
}

#[test]
fn a_run_that_ends_shows_nothing_and_one_that_diverges_fails() {
    let rows = r#"
title = "A paper"
source = "its text"

[[element]]
id = "claim-1"
place = "1"
says = "it runs"
runs = [{ case = "film", variant = "numerics=paper" }]
"#;
    let run = |outcome| RunSummary {
        variant: "fluid=newtonian,numerics=paper".parse().expect("a variant"),
        outcome,
        particles: 1,
        steps: 1,
        simulated_time: 1.0,
        wall_seconds: 1.0,
        threads: 1,
        microseconds_per_particle_step: None,
        state_hash: String::new(),
        from_store: false,
    };
    let diverged = |expected| Outcome::Diverged { message: "diverged at t = 0.2 s".to_owned(), expected };
    let papers: &[Paper] = vec![Paper::parse("made-up", rows).expect("readable")].leak();
    for (runs, expected) in [
        (Vec::new(), Status::NotCovered),
        (vec![run(Outcome::Finished)], Status::NotCovered),
        (vec![run(diverged(true))], Status::NotReproduced),
        (vec![run(Outcome::Finished), run(diverged(false))], Status::NotReproduced),
    ] {
        let mut report = Report { papers, ..report(Vec::new()) };
        report.cases[0].result.runs = runs;
        let judgement = judge(&report);
        assert_eq!(judgement.papers[0].elements[0].status, expected);
        let page = papers_page::render(&report, &judgement.papers).expect("a page");
        assert_eq!(page.contains("diverged at t = 0.2 s"), expected == Status::NotReproduced);
    }
}

#[test]
fn the_page_has_every_row_and_its_links_land() {
    let report = report(vec![gated(2.0), thickness(6.1)]);
    let folder = tempfile::tempdir().expect("a folder");
    write(&report, folder.path(), &Drawings::default()).expect("written");
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect(name);
    let (page, overview, film) = (read("papers.html"), read("index.html"), read("cases/film/index.html"));
    for element in &report.papers[0].elements {
        assert!(page.contains(&format!("id=\"made-up-{}\"", element.id)), "{}", element.id);
    }
    assert!(page.contains("printed &lt;5&gt;") && !page.contains("<5>"), "escaped");
    assert!(page.contains("6.1\u{202f}cm") && page.contains("4.5 … 5.5\u{202f}cm"), "our number beside the paper's");
    let targets: Vec<&str> =
        page.split("href=\"cases/film/index.html#").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    assert!(targets.contains(&"figure-film-operators") && targets.len() >= 6, "{targets:?}");
    for target in targets {
        assert!(film.contains(&format!("id=\"{target}\"")), "the case's page has no {target}");
    }
    assert!(
        overview.contains("href=\"papers.html\"")
            && overview.contains(
                "2 of 6 elements reproduced (1 by results of runs, 1 by tests of equations and inputs alone)"
            )
    );
    assert!(!page.contains("http"), "nothing is loaded from elsewhere");
    let json: serde_json::Value = serde_json::from_str(&read("papers.json")).expect("json");
    assert_eq!(json["papers"][0]["counts"]["contradicted"], 2);
    assert_eq!(json["papers"][0]["elements"].as_array().map(Vec::len), Some(6));
}

#[test]
fn a_report_without_papers_has_no_page_of_them() {
    let report = Report { papers: &[], ..report(vec![gated(0.5)]) };
    let folder = tempfile::tempdir().expect("a folder");
    write(&report, folder.path(), &Drawings::default()).expect("written");
    assert!(!folder.path().join("papers.html").exists());
}

#[test]
fn the_papers_are_accounted_for_where_their_cases_run() {
    let film = report(Vec::new()).cases;
    assert_eq!(accounted(&film).len(), 2);
    let own = tests::case("own", Vec::new());
    assert!(accounted(&[own]).is_empty());
    for paper in PAPERS.iter() {
        let account = PaperSummary::of(paper, &film);
        let counted: usize = Status::ALL.into_iter().map(|status| account.count(status)).sum();
        assert_eq!(counted, paper.elements.len(), "{}: a row without a status", paper.name);
    }
}

/// A control of which the element names a metric, as the control has it.
fn trial(metric: &str, found: &Metric) -> ControlTrial {
    let solver = Some("an-error".to_owned());
    let (name, error, rejected_by) = ("an-error".to_owned(), "wrong".to_owned(), vec![metric.to_owned()]);
    let control = Control { name, error, solver, rejected_by, ..Control::default() };
    ControlTrial { control, found: vec![Found::of(found, Some(found))], diverged: false, tried_at: None }
}

#[test]
fn an_element_that_stands_under_a_control_of_its_metric_is_not_shown() {
    let status = |trial: ControlTrial| {
        let mut report = report(vec![gated(0.5)]);
        report.cases[0].controls = vec![trial];
        PaperSummary::of(&report.papers[0], &report.cases).elements[0].status
    };
    assert_eq!(status(trial("velocity_l2", &gated(2.0))), Status::Reproduced, "it falls");
    assert_eq!(status(trial("velocity_l2", &gated(0.6))), Status::NotShown);
    assert_eq!(status(trial("flux", &gated(0.6))), Status::NotShown, "no control makes it fall");
    let diverged = ControlTrial { diverged: true, ..trial("velocity_l2", &gated(f64::NAN)) };
    assert_eq!(status(diverged), Status::NotShown, "a run that diverged shows nothing");
}

#[test]
fn a_value_that_is_known_too_badly_shows_nothing() {
    let known = |standard| thickness(5.2).known_to(Origin::Input, Some(standard), "draws");
    let status = |metric: Metric, element: usize| statuses(vec![gated(0.5), metric])[element];
    // between 4.5 and 5.5, and at least 5
    assert_eq!([status(known(0.2), 1), status(known(0.3), 1)], ["reproduced", "not shown"]);
    assert_eq!([status(known(0.09), 2), status(known(0.2), 2)], ["reproduced", "not shown"]);
    // what misses by less than it is known to is no finding either
    let short = |standard| thickness(4.9).known_to(Origin::Input, Some(standard), "draws");
    assert_eq!([status(short(0.04), 2), status(short(0.06), 2)], ["not reproduced", "not shown"]);
}

#[test]
fn a_gate_that_rejects_no_control_is_inconclusive() {
    let tally = |controls: Vec<ControlTrial>| {
        let mut report = report(vec![gated(0.5)]);
        report.cases[0].controls = controls;
        let tally = judge(&report).tally_of(MetricKind::Verification);
        [Severity::Pass, Severity::Inconclusive].map(|severity| tally.of(severity))
    };
    assert_eq!(tally(Vec::new()), [1, 0], "not asked");
    assert_eq!(tally(vec![trial("velocity_l2", &gated(2.0))]), [1, 0]);
    assert_eq!(tally(vec![trial("velocity_l2", &gated(0.6))]), [0, 1]);
}

#[test]
fn controls_that_escape_are_named_where_they_are_few() {
    let words = |wrong: f64, number: usize| {
        let mut report = report(vec![gated(0.5)]);
        report.cases[0].controls = vec![trial("velocity_l2", &gated(wrong)); number];
        crate::power::rejected_inputs(&report.cases[0])
    };
    assert_eq!(words(2.0, 1).as_deref(), Some("film: 1 of 1 negative controls are rejected"));
    assert_eq!(words(0.6, 1).as_deref(), Some("film: 0 of 1 negative controls are rejected; not rejected: an-error"));
    assert_eq!(words(0.6, 4).as_deref(), Some("film: 0 of 4 negative controls are rejected"));
}
