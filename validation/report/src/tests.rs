//! The page as a whole: what a reader sees first, escaping, and reports with nothing in them.

use super::pages_tests::links;
use super::*;
use crate::figure::{Animation, AnimationFrame, Axis, Panel, Scale};
use crate::metric::{Confidence, Limit, Metric, MetricKind, Variant};
use crate::store::{CodeOrigin, Drawings, Store, StorePolicy};

pub(super) fn gated(name: &str, value: f64) -> Metric {
    Metric::observed(name, &Variant::of("resolution", 40), value, "%")
        .gated(Limit::AtMost(0.7), "prototype reached 0.56 %")
        .against(Some(0.0), "Eq. (36)", Confidence::Exact)
        .with_snapshot_tolerance(0.05, 0.0)
}

pub(super) fn case(name: &str, metrics: Vec<Metric>) -> CaseReport {
    let result = CaseResult {
        name: name.to_owned(),
        origin: CodeOrigin::PACKAGE,
        summary: format!("summary of {name}"),
        description: "First paragraph.\n\nSecond paragraph.".to_owned(),
        tier: Tier::Quick,
        parameters_toml: "depth = 0.01\n".to_owned(),
        command: format!("bagnold run {name}"),
        metrics,
        figures: Vec::new(),
        animations: Vec::new(),
        tables: Vec::new(),
        runs: Vec::new(),
        run_parameters: Vec::new(),
        regimes: Vec::new(),
        frames: Vec::new(),
        first_bad: Vec::new(),
        state_hash: String::new(),
    };
    CaseReport { result, quantities: &[], not_judged: Vec::new(), controls: Vec::new(), measured: Vec::new() }
}

pub(super) fn report(cases: Vec<CaseReport>) -> Report {
    Report::of("Report".to_owned(), Tier::Quick, cases)
}

pub(super) fn known(case: &str, metric: &str, best_value: f64) -> ExpectedFailures {
    ExpectedFailures {
        failures: vec![ExpectedFailure {
            case: case.to_owned(),
            metric: metric.to_owned(),
            variant: Variant::of("resolution", 40),
            best_value,
            date: "2025-01-31".to_owned(),
            reason: "two attempts".to_owned(),
            kind: FailureKind::Defect,
            tried: String::new(),
        }],
    }
}

pub(super) fn write(report: &Report, folder: &Path, drawings: &Drawings) -> Result<(), ReportError> {
    super::write(&judge(report), folder, drawings)
}

pub(super) fn html(report: &Report) -> String {
    page::render(&judge(report), (&[], &[])).expect("page")
}

pub(super) fn place(text: &str, part: &str) -> usize {
    text.find(part).unwrap_or_else(|| panic!("{part:?} is not on the page"))
}

pub(super) fn drawing(name: &str) -> Figure {
    let axis = |label: &str| Axis { label: label.to_owned(), scale: Scale::Linear, limits: None, ratio: None };
    let panel = Panel {
        title: String::new(),
        x: axis("u [m/s]"),
        y: axis("y [m]"),
        bands: Vec::new(),
        series: Vec::new(),
        field: None,
        opposite: None,
    };
    Figure { name: name.to_owned(), caption: "a caption".to_owned(), panels: vec![panel], columns: 1 }
}

fn moving(name: &str, frames: usize) -> Animation {
    let axis = Axis { label: "x [m]".to_owned(), scale: Scale::Linear, limits: Some((0.0, 1.0)), ratio: None };
    let frame = AnimationFrame {
        title: "t = 0 s".to_owned(),
        points: vec![[0.5, 0.5]],
        values: vec![1.0],
        diameter: 0.1,
        lines: Vec::new(),
    };
    Animation {
        name: name.to_owned(),
        caption: "a moving caption".to_owned(),
        x: axis.clone(),
        y: axis,
        label: "|v| [m/s]".to_owned(),
        limits: (0.0, 1.0),
        seconds_per_frame: 0.1,
        frames: vec![frame; frames],
    }
}

#[test]
fn a_failing_gate_is_the_first_thing_on_the_page() {
    let report = report(vec![
        case("film", vec![gated("velocity_l2", 0.5)]),
        case("bagnold", vec![gated("wall_slip", 0.3), gated("velocity_l2", 0.9)]),
    ]);
    let page = html(&report);
    assert!(page.contains("1 new failure; no baseline") && page.contains("3 gates: 2 pass, 1 new failure"));
    assert!(page.contains("class=\"banner fail\""));
    let gates = page::gates(&judge(&report)).expect("page");
    assert!(place(&gates, "velocity_l2") < place(&gates, "wall_slip"), "failures come first");
    assert!(page.contains("No value has moved against the baseline"), "there are none");
    let line_of = |case: &str| place(&page, &format!("<a href=\"cases/{case}/index.html\">"));
    assert!(line_of("bagnold") < line_of("film"), "so do failing cases");
    assert!(place(&page, "id=\"attention\"") < place(&page, "id=\"cases\""), "what fails stands above the table");
    assert!(judge(&report).exit() != Exit::Held);
}

#[test]
fn an_expected_failure_is_first_but_no_alarm() {
    let mut report = report(vec![case("bagnold", vec![gated("wall_slip", 0.3), gated("velocity_l2", 0.9)])]);
    report.expected_failures = known("bagnold", "velocity_l2", 0.9);
    let judgement = judge(&report);
    assert!(judgement.exit() == Exit::Held);
    let tally = judgement.tally_of(MetricKind::Verification);
    let counts = [Severity::ExpectedFailure, Severity::NewFailure, Severity::Pass].map(|own| tally.of(own));
    assert_eq!(counts, [1, 0, 1]);
    let page = html(&report);
    assert!(page.contains("class=\"banner pass\"") && page.contains("class=\"word expected\""));

    report.expected_failures = known("bagnold", "velocity_l2", 0.8);
    assert!(judge(&report).exit() != Exit::Held, "worse than its best value");
    report.expected_failures = known("bagnold", "wall_slip", 0.8);
    let judgement = judge(&report);
    assert_eq!(judgement.contradictions.len(), 1, "a listed gate that passes");
    let counts = [Severity::UnexpectedPass, Severity::NewFailure].map(|own| judgement.tally().of(own));
    assert_eq!(counts, [1, 1], "the other gate fails and is not listed any more");
    let page = html(&report);
    assert!(page.contains("remove the entry") && page.contains("1 new failure; "));
    assert!(page.contains("1 expected failure no longer failing"), "which is no new failure");
}

#[test]
fn green_needs_a_gate_that_passes_and_no_moved_value() {
    let metrics = vec![gated("velocity_l2", 0.5)];
    let mut report = report(vec![case("bagnold", metrics.clone())]);
    assert!(html(&report).contains("class=\"banner pass\""));
    report.baseline = Baseline::of("bagnold", &metrics);
    assert!(html(&report).contains("class=\"banner pass\""));
    report.baseline = Baseline::of("bagnold", &[gated("velocity_l2", 0.4)]);
    let judgement = judge(&report);
    assert_eq!((judgement.moved(), judgement.exit()), (1, Exit::Held));
    let page = html(&report);
    assert!(page.contains("class=\"banner moved\"") && page.contains("+0.1"));
    report.baseline = Baseline::of("bagnold", &[gated("velocity_l2", 0.5), gated("gone", 0.4)]);
    assert_eq!(judge(&report).moved(), 1, "a vanished metric");
    assert!(html(&report).contains("no longer measured"));
}

#[test]
fn kinds_are_counted_apart_and_observed_values_not_at_all() {
    let report = report(vec![case(
        "collapse",
        vec![
            gated("run_out", 0.9).of_kind(MetricKind::Validation),
            gated("velocity_l2", 0.1),
            gated("gci", 0.9).against(None, "hearsay", Confidence::Unverified),
            Metric::observed("final_height", &Variant::default(), 1.0, "m"),
        ],
    )]);
    let judgement = judge(&report);
    let counts = |kind| {
        let tally = judgement.tally_of(kind);
        [Severity::NewFailure, Severity::Pass].map(|own| tally.of(own))
    };
    assert_eq!([MetricKind::Validation, MetricKind::Verification].map(counts), [[1, 0], [0, 1]]);
    let order: Vec<&str> = judgement.cases[0].metrics.iter().map(|judged| judged.metric.name.as_str()).collect();
    assert_eq!(order, ["run_out", "velocity_l2", "gci", "final_height"]);
}

#[test]
fn an_undeclared_divergence_is_a_failure_and_a_declared_one_is_not() {
    let run = |expected| crate::case::RunSummary {
        variant: Variant::of("slope_angle", 34),
        outcome: crate::observation::Outcome::Diverged { message: "speed of particle 17".to_owned(), expected },
        particles: 400,
        steps: 1000,
        simulated_time: 0.5,
        wall_seconds: 1.0,
        threads: 2,
        microseconds_per_particle_step: Some(0.4),
        state_hash: "0123456789abcdef".to_owned(),
        from_store: true,
    };
    let mut report = report(vec![case("bagnold", vec![gated("velocity_l2", 0.5)])]);
    report.cases[0].result.runs = vec![run(true)];
    assert_eq!(judge(&report).exit(), Exit::Held);
    report.cases[0].result.runs = vec![run(false)];
    assert_eq!(judge(&report).exit(), Exit::Diverged);
    let page = html(&report);
    assert!(place(&page, "speed of particle 17") < place(&page, "id=\"cases\""));
}

#[test]
fn everything_inserted_is_escaped() {
    let evil = "<script>alert(1)</script>\"'&";
    let mut case = case("film", vec![gated(evil, 0.9).gated(Limit::AtMost(0.1), evil)]);
    case.result.metrics[0].variant = Variant::of("a", evil);
    case.result.metrics[0].unit = evil.to_owned();
    case.result.summary = evil.to_owned();
    case.result.description = evil.to_owned();
    case.result.parameters_toml = evil.to_owned();
    case.result.command = evil.to_owned();
    let mut report = report(vec![case]);
    report.title = evil.to_owned();
    report.generated.commit = evil.to_owned();
    let judgement = judge(&report);
    let of_case = case_page::render(&report, &judgement.cases[0], &[], None).expect("page");
    for page in [html(&report), of_case] {
        assert!(!page.contains("<script>alert"));
        assert!(page.contains("&lt;script&gt;alert(1)"));
        assert_eq!(page.matches("</script>").count(), 1, "only the page's own");
    }
}

#[test]
fn the_folder_is_self_contained_and_reproducible() {
    let folder = tempfile::tempdir().expect("folder");
    let mut film = case("film", vec![gated("velocity_l2", 0.5)]);
    film.result.figures = vec![drawing("velocity-profile"), drawing("not a name")];
    film.result.animations = vec![moving("collapse", 2), moving("without-pictures", 0)];
    let report = report(vec![film]);
    write(&report, folder.path(), &Drawings::default()).expect("written");
    let read = |path: &str| std::fs::read_to_string(folder.path().join(path)).expect(path);
    let (overview, page) = (read("index.html"), read("cases/film/index.html"));
    assert!(read("cases/film/metrics.json").contains("velocity_l2"));
    assert_eq!(read("cases/film/case.toml"), "depth = 0.01\n");
    assert!(folder.path().join("figures/film/velocity-profile.png").exists());
    assert!(page.contains("href=\"../../figures/film/velocity-profile.svg\""));
    let (width, height) = figure::size_of(&folder.path().join("figures/film/velocity-profile.png")).expect("a picture");
    let sized =
        format!("velocity-profile.png\" alt=\"a caption\" loading=\"lazy\" width=\"{width}\" height=\"{height}\"");
    assert!(page.contains(&sized), "a picture that comes late must not move what is linked");
    assert!(folder.path().join("figures/film/collapse.gif").exists());
    assert!(page.contains("<img src=\"../../figures/film/collapse.gif\"") && page.contains("a moving caption"));
    assert!(!page.contains("collapse.svg") && page.contains("without-pictures could not be drawn"));
    assert!(page.contains("could not be drawn"), "a figure that fails is named on the page");
    assert!(!page.contains("http") && !overview.contains("http"), "nothing is loaded from elsewhere");
    assert!(links(folder.path()) > 10);
    let store = tempfile::tempdir().expect("folder");
    let names = ["svg", "png", "pdf", "csv"]
        .map(|ending| format!("velocity-profile.{ending}"))
        .into_iter()
        .chain(["collapse.gif".to_owned()]);
    let names: Vec<String> = names.collect();
    let read_bytes = |name: &String| std::fs::read(folder.path().join("figures/film").join(name)).expect(name);
    let bytes = || names.iter().map(read_bytes).collect::<Vec<_>>();
    let drawn = bytes();
    for (made, occasion) in
        [(6, "an SVG, two PNGs, a PDF and a GIF, and one that fails"), (1, "what fails is tried again")]
    {
        let drawings = Store::at(store.path(), StorePolicy::Use).drawings();
        write(&report, folder.path(), &drawings).expect("written again");
        assert_eq!(drawings.made(), made, "{occasion}");
        assert!(bytes() == drawn, "{occasion}");
    }
    assert_eq!((overview, page), (read("index.html"), read("cases/film/index.html")));
}

#[test]
fn empty_reports_and_escaping_names() {
    let folder = tempfile::tempdir().expect("folder");
    write(&report(Vec::new()), folder.path(), &Drawings::default()).expect("an empty report is a report");
    assert!(links(folder.path()) > 2, "the empty report's own places");
    let page = html(&report(vec![case("film", Vec::new())]));
    assert!(page.contains("Nothing was judged") && page.contains("no metrics"));
    assert!(matches!(
        write(&report(vec![case("../film", Vec::new())]), folder.path(), &Drawings::default()),
        Err(ReportError::Field(_))
    ));
}

#[test]
fn the_users_own_failing_gates_stand_above_those_of_the_case() {
    let of_case = gated("velocity_l2", 9.0).of_kind(MetricKind::Validation);
    let own = gated("front_at_rest", 0.8).of_kind(MetricKind::Verification).of_user();
    let held = gated("depth", 0.1).of_user();
    let report = report(vec![case("film", vec![of_case.clone()]), case("my-flume", vec![of_case, held, own])]);
    let judgement = judge(&report);
    let mine = judgement.cases.iter().find(|judged| judged.case.name == "my-flume").expect("judged");
    let names: Vec<&str> = mine.metrics.iter().map(|judged| judged.metric.name.as_str()).collect();
    assert_eq!(names, ["front_at_rest", "velocity_l2", "depth"], "what fails before what passes, then the user's own");
    // in the list too, although the case's gate fails by more
    let page = html(&report);
    let list = page.split("id=\"attention\"").nth(1).expect("a list");
    let first = |part: &str| place(list, part);
    assert!(first("front_at_rest") < first("velocity_l2"));
}

#[test]
fn page_terminal_numbers_and_junit_have_one_tally_in_the_same_words() {
    let metrics = vec![
        gated("run_out", 0.9).of_kind(MetricKind::Validation),
        gated("velocity_l2", 0.1),
        gated("mass", 0.1).of_kind(MetricKind::Bookkeeping),
    ];
    let mut report = report(vec![case("film", metrics)]);
    report.expected_failures = known("film", "run_out", 0.9);
    report.cases[0].not_judged = vec![(MetricKey::of("film", &gated("gone", 0.1)), "gone".to_owned())];
    let judgement = judge(&report);
    let tally = "4 gates: 2 pass, 1 expected failure, 1 not judged, 0 new failures";
    assert_eq!(judgement.in_words(), tally);
    assert!(html(&report).contains(tally) && html(&report).contains("1 gate: 1 expected failure, 0 new failures"));
    assert!(page::gates(&judgement).expect("page").contains(tally));
    assert!(junit::text(&judgement).contains(&format!("name=\"tally\" value=\"{tally}\"")));
    let numbers: serde_json::Value = serde_json::from_str(&scatter::json(&judgement, &[])).expect("JSON");
    assert_eq!(numbers["gates"]["all"], serde_json::to_value(judgement.tally().by_word()).expect("JSON"));
    assert_eq!(numbers["gates"]["against measurements"]["expected failure"], 1);
}
