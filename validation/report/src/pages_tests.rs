//! Pages beside each other: their links, a case alone, and what the first page leads with.

use super::tests::{case, drawing, gated, html, known, place, report, write};
use super::*;
use crate::metric::{Confidence, Metric, MetricKind, Origin, Variant};
use crate::store::Drawings;

/// Checks that every link and picture of every page in a folder has an existing target; returns their number.
pub(super) fn links(folder: &Path) -> usize {
    let mut number = 0;
    let mut folders = vec![folder.to_owned()];
    while let Some(here) = folders.pop() {
        for entry in std::fs::read_dir(&here).expect("readable").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let Some(page) = path.extension().filter(|e| *e == "html").and(std::fs::read_to_string(&path).ok()) else {
                continue;
            };
            let addresses = ["href=\"", "src=\""].into_iter().flat_map(|attribute| page.split(attribute).skip(1));
            for address in addresses.filter_map(|rest| rest.split('"').next()).filter(|own| !own.starts_with("data:")) {
                let (file, place) = address.split_once('#').unwrap_or((address, ""));
                let file = if file.is_empty() { path.clone() } else { here.join(file) };
                let target = std::fs::read(&file).unwrap_or_else(|_| panic!("{}: {address}", path.display()));
                let has_place = String::from_utf8_lossy(&target).contains(&format!("id=\"{place}\""));
                assert!(place.is_empty() || has_place, "{}: {address}", path.display());
                number += 1;
            }
        }
    }
    number
}

#[test]
fn a_case_alone_has_the_same_page_beside_its_figures() {
    let folder = tempfile::tempdir().expect("folder");
    let mut film = case("film", vec![gated("velocity_l2", 0.5), gated("wall_slip", 0.3)]);
    film.result.figures = vec![drawing("wall-slip"), drawing("velocity-profile")];
    film.result.command = "bagnold run bagnold --tier paper".to_owned();
    let report = report(vec![film]);
    write_alone(&judge(&report), folder.path(), &Drawings::default()).expect("written");
    let page = std::fs::read_to_string(folder.path().join("index.html")).expect("a page");
    assert!(page.contains("src=\"figures/velocity-profile.png\"") && !page.contains("../"));
    assert!(page.contains("cargo run -- run bagnold --tier paper"), "as it is typed in a checkout");
    assert!(page.contains("href=\"#figure-film-velocity-profile\">velocity-profile"), "the metric's own figure");
    assert!(!page.contains("since baseline"), "there is nothing to have moved from");
    assert!(links(folder.path()) > 5);
}

#[test]
fn the_first_page_leads_with_what_is_furthest_off_and_the_farthest_moves() {
    let metrics = vec![gated("roomy", 0.1), gated("thin", 0.69), gated("broken", 0.9), gated("far", 9.0)];
    let mut report =
        report(vec![case("film", metrics), case("bagnold", vec![gated("wrong_sign", -0.1), gated("near", 0.8)])]);
    report.baseline = Baseline::of("film", &[gated("roomy", 0.1), gated("thin", 0.7), gated("broken", 0.5)]);
    let judgement = judge(&report);
    let page = html(&report);
    let failing = super::failures::of(&judgement.cases);
    let names = |places: &[usize]| places.iter().map(|&place| failing[place]["metric"].clone()).collect::<Vec<_>>();
    assert_eq!(names(&[0, 1, 2]), ["far", "broken", "near"], "twelve times the limit before 1.3 and 1.1 times");
    assert!(place(&page, "id=\"moved\"") < place(&page, "Failed gates"));
    let moved: Vec<&str> = page.split("id=\"moved\"").nth(1).expect("a list").split("<b>").skip(1).take(2).collect();
    assert!(moved[0].starts_with("broken") && moved[1].starts_with("thin"), "{moved:?}");
    let thin = overview::gates(&judgement).into_iter().find(|gate| gate["row"]["metric"] == "thin").expect("a gate");
    let number = |key: &str| thin["row"][key].as_str().and_then(|text| text.parse::<f64>().ok()).expect("a number");
    assert!((number("margin_key") - 0.01 / 0.7).abs() < 1e-5, "{thin}");
    assert!((number("change_key") - 0.01 / (0.05 * 0.7)).abs() < 1e-4, "{thin}");
}

#[test]
fn a_failure_has_a_title_of_quantity_parameters_value_reference_and_limit() {
    const FRONT: Quantity = Quantity::validated("run_out", "-", "how far the front has come");
    let mut run_out = gated("run_out", 0.9).against(Some(0.6), "an experiment", Confidence::Medium);
    run_out.variant = Variant::of("material", "sand").and("aspect_ratio", 1.5);
    let mut grains = case("grains", vec![run_out]);
    grains.quantities = &[FRONT];
    let page = html(&report(vec![grains]));
    let title =
        "title=\"how far the front has come\"><b>Run out, sand, aspect ratio = 1.5</b></a>: <span class=\"statement\">";
    assert!(
        page.contains(&format!("{title}0.9\u{202f}%; reference 0.6\u{202f}% (+50 %), limit ≤ 0.7\u{202f}%</span>")),
        "{page}"
    );
}

#[test]
fn a_reason_stands_on_the_page_of_its_case_only() {
    let folder = tempfile::tempdir().expect("folder");
    let mut report = report(vec![case("film", vec![gated("front", 0.9)])]);
    report.expected_failures = known("film", "front", 0.9);
    write(&report, folder.path(), &Drawings::default()).expect("written");
    let read = |path: &str| std::fs::read_to_string(folder.path().join(path)).expect(path);
    let (overview, page) = (read("index.html"), read("cases/film/index.html"));
    for text in [&overview, &page] {
        assert!(
            text.contains("0.9\u{202f}%, limit ≤ 0.7\u{202f}%</span>")
                && text.contains("<span class=\"note\">Expected failure since 2025-01-31")
        );
    }
    assert!(!overview.contains("two attempts"));
    assert!(page.find("Failures") < page.find("two attempts"), "in short first");
    assert_eq!(page.matches("two attempts").count(), 1);
}

#[test]
fn figures_stand_above_tables_and_bookkeeping_is_folded() {
    let folder = tempfile::tempdir().expect("folder");
    let mut metrics = vec![gated("mass", 0.1).of_kind(MetricKind::Bookkeeping), gated("velocity_l2", 0.9)];
    metrics.extend((0..20).map(|n| Metric::observed(&format!("height_{n}"), &Variant::default(), 1.0, "m")));
    let mut film = case("film", metrics);
    film.result.figures = vec![drawing("velocity-profile")];
    let report = report(vec![film]);
    write(&report, folder.path(), &Drawings::default()).expect("written");
    let page = std::fs::read_to_string(folder.path().join("cases/film/index.html")).expect("a page");
    let at = |part: &str| page.find(part).unwrap_or_else(|| panic!("{part} is not on the page"));
    let order = ["Failures", "<img", "<table", "id=\"metrics-judged\"", "id=\"metrics-bookkeeping\""].map(at);
    assert!(order.is_sorted(), "{order:?}");
    let folds: Vec<&str> = page.split("<details").skip(1).filter_map(|rest| rest.split("</summary>").next()).collect();
    let expected = [
        " open><summary>Judged: 1 row",
        "><summary>Bookkeeping: 1 row",
        "><summary>Observed only: 20 rows",
        "><summary>parameters of these runs, as in <code>case.toml</code>",
    ];
    assert_eq!(folds, expected);
}

/// A report of some cases with a figure each, as it is written.
fn overview_of(names: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("folder");
    let of = |name: &&str| {
        let run_out =
            Metric::observed("run_out", &Variant::of("material", "sand"), 2.2, "-").of_kind(MetricKind::Validation);
        let measured = run_out.against(Some(2.0), "an experiment", Confidence::Medium);
        let known = measured.known_to(Origin::Repeat, Some(0.5), "seeds");
        let mut own = case(name, vec![gated("velocity_l2", 0.25), known]);
        own.result.figures =
            ["first", "velocity-profile", "start-stop", "scaling", "run-out", "transport"].map(drawing).to_vec();
        own
    };
    write(&report(names.iter().map(of).collect()), folder.path(), &Drawings::default()).expect("written");
    assert!(links(folder.path()) > 5);
    std::fs::read_to_string(folder.path().join("index.html")).expect("a page")
}

#[test]
fn the_first_page_opens_with_a_panel_for_each_flow_that_the_report_has() {
    let cases = ["footing", "bagnold", "flow-thickness", "column-round", "column-planar", "bed-load-1d", "bed-load"];
    let page = overview_of(&cases);
    assert_eq!(page.matches("<section class=\"flow\"").count(), 4);
    assert!(page.find("<section class=\"flow\"") < page.find("<table"));
    assert!(page.contains("Velocity profiles of two materials differ by 0.25 % (L2) from"));
    assert!(
        page.contains("Columns of sand on a plane run out 1.10 times as far as by the fit of an experiment")
            && page.contains("(columns: 1)")
    );
    assert!(
        page.contains(
            "2 of 2 comparisons with published results agree within their uncertainty, 25 % of the reference"
        )
    );
    assert!(page.contains("href=\"figures/column-planar/scaling.csv\""), "the figure that stands for the flow");
    assert_eq!(page.matches("class=\"small\"><a").count(), cases.len(), "a picture a case");
}

#[test]
fn flows_without_their_cases_are_left_out() {
    assert_eq!(overview_of(&["incline-collapse", "my-flume"]).matches("<section class=\"flow\"").count(), 1);
    let none = overview_of(&["footing"]);
    assert!(!none.contains("class=\"flow") && none.contains("class=\"small\"><a"));
}

/// User text in cases, laws and data ends up in pictures and messages as well as in the page's own text.
#[test]
fn labels_captions_and_messages_of_runs_are_text_and_not_markup() {
    let folder = tempfile::tempdir().expect("folder");
    let evil = "</text></svg><script>alert(1)</script><img src=x onerror=\"alert(2)\">]]>&amp;";
    let mut film = case("film", vec![gated("velocity_l2", 0.9)]);
    let mut figure = drawing("velocity-profile");
    figure.caption = evil.to_owned();
    for panel in &mut figure.panels {
        panel.title = evil.to_owned();
        panel.x.label = evil.to_owned();
        panel.line(evil, 0, [(0.0, 0.0), (1.0, 1.0)]);
    }
    film.result.figures = vec![figure];
    film.result.runs = vec![crate::case::RunSummary {
        variant: Variant::of("law", evil),
        outcome: crate::observation::Outcome::Diverged { message: evil.to_owned(), expected: false },
        particles: 1,
        steps: 1,
        simulated_time: 1.0,
        wall_seconds: 1.0,
        threads: 1,
        microseconds_per_particle_step: None,
        state_hash: evil.to_owned(),
        from_store: false,
    }];
    let mut report = report(vec![film]);
    report.expected_failures = known("film", "velocity_l2", 0.9);
    report.expected_failures.failures[0].reason = evil.to_owned();
    write(&report, folder.path(), &Drawings::default()).expect("written");
    let mut folders = vec![folder.path().to_owned()];
    let mut read = 0;
    while let Some(here) = folders.pop() {
        for path in std::fs::read_dir(here).expect("readable").flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|ending| ending == "html" || ending == "svg") {
                let text = std::fs::read_to_string(&path).expect("text");
                for markup in ["<script>alert", "<img src=x", "]]>"] {
                    assert!(!text.contains(markup), "{}: {markup}", path.display());
                }
                assert!(path.extension().is_some_and(|ending| ending == "html") || text.contains("&lt;script&gt;"));
                read += 1;
            }
        }
    }
    assert!(read >= 3, "{read} pages and pictures");
}
