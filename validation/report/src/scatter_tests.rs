//! Tests of what a report says of a quantity over all its cases.

use super::*;
use crate::metric::{Confidence, MetricKind, Origin, Variant};
use crate::store::Drawings;
use crate::tests::{self, write};

fn compared(name: &str, value: f64, reference: f64) -> Metric {
    Metric::observed(name, &Variant::of("value", value), value, "-").of_kind(MetricKind::Validation).against(
        Some(reference),
        "an experiment",
        Confidence::High,
    )
}

fn report(cases: Vec<(&str, Vec<Metric>)>) -> Report {
    tests::report(cases.into_iter().map(|(name, metrics)| tests::case(name, metrics)).collect())
}

/// ln(M/E) = −0.1, 0 and 0.1 in two cases, and comparisons that do not count.
fn example() -> Report {
    let ratio = libm::exp(0.1);
    let unverified = compared("run_out", 9.0, 1.0).against(Some(1.0), "hearsay", Confidence::Unverified);
    let verified = compared("run_out", 9.0, 1.0).of_kind(MetricKind::Verification);
    let exact = compared("run_out", 9.0, 1.0).against(Some(1.0), "the steepest slope that can rest", Confidence::Exact);
    let without_number = compared("run_out", 9.0, 1.0).against(None, "a statement", Confidence::High);
    report(vec![
        ("planar", vec![compared("run_out", ratio, 1.0), compared("run_out", 2.0, 2.0), compared("run_out", 1.0, 0.0)]),
        ("round", vec![compared("run_out", 4.0, 4.0 * ratio), unverified, verified, exact, without_number]),
        ("lonely", vec![compared("height", 1.0, 1.0), compared("height", 1.0, 1.1)]),
    ])
}

#[test]
fn comparisons_of_one_name_are_one_quantity_over_all_cases() {
    let found = quantities(&example());
    assert_eq!(found.len(), 1, "two heights are too few");
    let run_out = &found[0];
    assert_eq!((run_out.quantity.as_str(), run_out.found.comparisons, run_out.left_out), ("run_out", 3, 1));
    assert_eq!(
        run_out.cases.iter().map(|(case, own)| (case.as_str(), own.len())).collect::<Vec<_>>(),
        [("planar", 2), ("round", 1)]
    );
    assert!((run_out.found.bias - 1.0).abs() < 1e-12 && (run_out.found.scatter - 0.1).abs() < 1e-12);
    assert_eq!(run_out.found.experimental_deviation, None, "nobody gave an uncertainty");
}

#[test]
fn a_known_uncertainty_of_the_reference_gives_a_deviation_and_bands() {
    let mut report = example();
    for metric in report.cases.iter_mut().flat_map(|case| &mut case.result.metrics) {
        let reference = metric.reference.as_ref().and_then(|reference| reference.value);
        let experiment = reference.map(|value| 0.06 * value);
        *metric = metric.clone().known_to(Origin::Experiment, experiment, "its authors").known_to(
            Origin::Repeat,
            Some(1.0),
            "not of the reference",
        );
    }
    let found = quantities(&report);
    assert!(found[0].found.model_deviation().is_some_and(|model| (model - 0.08).abs() < 1e-12));
    let panel = &figures(&found)[0].panels[0];
    assert!((panel.bands[0].points[0].2 / panel.bands[0].points[0].0 / found[0].found.bias - 1.16).abs() < 1e-12);
    assert!(figures(&quantities(&example()))[0].panels[0].bands.is_empty(), "none without σ_M");
}

#[test]
fn the_page_and_the_numbers_have_it() {
    let folder = tempfile::tempdir().expect("folder");
    write(&example(), folder.path(), &Drawings::default()).expect("written");
    let read = |path: &str| std::fs::read_to_string(folder.path().join(path)).expect(path);
    let numbers: serde_json::Value = serde_json::from_str(&read("metrics.json")).expect("JSON");
    let run_out = &numbers["quantities"][0];
    assert_eq!((run_out["quantity"].as_str(), run_out["comparisons"].as_u64()), (Some("run_out"), Some(3)));
    assert!(run_out["bias"].as_f64().is_some_and(|bias| (bias - 1.0).abs() < 1e-12));
    assert!(run_out["model_deviation"].is_null());
    let page = read("comparisons.html");
    assert!(page.contains("id=\"scatter-run-out\"") && page.contains("figures/scatter/run-out.png"));
    assert!(folder.path().join("figures/scatter/run-out.svg").exists());
}
