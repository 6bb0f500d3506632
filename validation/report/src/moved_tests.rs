//! A planted change is found, tops the table and is distinguished from noise.

use super::*;
use crate::case::Tier;
use crate::metric::{Limit, Metric, Variant};
use crate::{Baseline, Exit, Report, judge, tests};

fn metric(name: &str, value: f64) -> Metric {
    Metric::observed(name, &Variant::of("resolution", 40), value, "%")
        .gated(Limit::AtMost(100.0), "for the test")
        .with_snapshot_tolerance(0.01, 0.0)
}

fn report(metrics: Vec<Metric>, baseline: Baseline) -> Report {
    Report { baseline, ..tests::report(vec![tests::case("film", metrics)]) }
}

/// Baseline values of three metrics, and the same with the middle one moved by some of its tolerances.
fn planted(tolerances: f64) -> Report {
    let before = [metric("wall_slip", 3.0), metric("velocity_l2", 10.0), metric("gci", 5.0)];
    // each moves by rounding as well
    let now = vec![metric("wall_slip", 3.003), metric("velocity_l2", 10.0 + 0.1 * tolerances), metric("gci", 5.0)];
    report(now, Baseline::of("film", &before))
}

#[test]
fn a_change_of_two_tolerances_tops_the_table() {
    let report = planted(2.0);
    let judgement = judge(&report);
    assert!(judgement.moved() == 1 && judgement.exit() == Exit::Held);
    let all = moved(&judgement);
    let names: Vec<&str> = all.iter().map(|moved| moved.key.metric.as_str()).collect();
    assert_eq!(names, ["velocity_l2", "wall_slip"]);
    assert!(all[0].is_beyond && (all[0].tolerances - 2.0).abs() < 1e-6, "{:?}", all[0]);
    let shown = table(&judgement);
    assert_eq!(shown["rows"][0]["metric"], "velocity_l2");
    assert_eq!(
        (&shown["rows"][0]["mark"], &shown["rows"][0]["limit"]),
        (&json!(VerdictMark::PASS), &json!("≤ 100\u{202f}%"))
    );
    assert_eq!(
        (&shown["beyond"], &shown["omitted"], &shown["against"]),
        (&json!(1), &json!(0), &json!("the baseline"))
    );
}

#[test]
fn a_gate_that_breaks_comes_before_what_moved_farther() {
    let before = [metric("velocity_l2", 99.0), metric("gci", 5.0)];
    let report = report(vec![metric("velocity_l2", 101.0), metric("gci", 50.0)], Baseline::of("film", &before));
    let rows = &table(&judge(&report))["rows"];
    assert_eq!((&rows[0]["metric"], &rows[0]["mark"]), (&json!("velocity_l2"), &json!(VerdictMark::FAIL)));
    assert!(rows[1]["metric"] == "gci", "{rows}");
}

#[test]
fn a_change_of_a_fifth_of_a_tolerance_is_shown() {
    let report = planted(0.2);
    let judgement = judge(&report);
    assert!(judgement.moved() == 0);
    let all = moved(&judgement);
    assert!(all.iter().all(|moved| !moved.is_beyond));
    assert!((all[0].tolerances - 0.2).abs() < 1e-6, "{:?}", all[0]);
}

#[test]
fn a_value_that_moved_within_its_fourth_digit_is_shown_with_the_digits_that_moved() {
    let before = [Metric::observed("front_error", &Variant::default(), 12.345_671, "%")];
    let now = Metric { value: 12.345_698, ..before[0].clone() };
    let report = report(vec![now], Baseline::of("film", &before));
    let judgement = judge(&report);
    let all = moved(&judgement);
    assert_eq!(
        all[0].to_string(),
        "film front_error [] 12.345698\u{202f}% (+2.7×10⁻⁵), was 12.345671\u{202f}% ± 1.2×10⁻⁵: 2.2 tolerances"
    );
    let row = &table(&judgement)["rows"][0];
    assert_eq!(row["value"], "12.345698\u{202f}% (+2.7×10⁻⁵)");
    assert!(row["baseline"].as_str().is_some_and(|text| text.starts_with("12.345671")), "{row}");
}

#[test]
fn incomparable_values_come_first() {
    let before = [metric("velocity_l2", 10.0), metric("gone", 1.0), metric("gci", 5.0)];
    let other_unit = Metric { unit: "m".to_owned(), ..metric("gci", 5.0) };
    let report =
        report(vec![metric("velocity_l2", 12.0), other_unit, metric("new", 1.0)], Baseline::of("film", &before));
    let all = moved(&judge(&report));
    let names: Vec<&str> = all.iter().map(|moved| moved.key.metric.as_str()).collect();
    assert_eq!(names, ["gci", "gone", "velocity_l2"], "what is new has not moved");
    assert!(all[1].tolerances.is_infinite() && all[1].is_beyond);
}

#[test]
fn an_earlier_report_is_a_baseline() {
    let folder = tempfile::tempdir().expect("folder");
    let place = folder.path().join("cases").join("film");
    std::fs::create_dir_all(&place).expect("folder");
    let cases = ["film".to_owned(), "bagnold".to_owned()];
    let read = |tier| Baseline::of_report(folder.path(), &cases, tier);
    assert!(read(Tier::Quick).is_err_and(|error| error.to_string().contains("no results of the selected cases")));
    let entry = |metric: &Metric| serde_json::to_value(crate::result::MetricEntry::from(metric)).expect("serialises");
    let document = serde_json::json!({
        "case": "film", "tier": "quick", "state_hash": "", "runs": [],
        "provenance": {"version": "", "commit": "0d1e2f", "source_hash": "", "profile": "", "target_features": "",
            "command": "", "threads": 1, "wall_seconds": 1.0, "microseconds_per_particle_step": null,
            "runs_from_store": 0},
        "metrics": [entry(&metric("velocity_l2", 10.0)), entry(&metric("gci", f64::NAN))],
    });
    std::fs::write(place.join("metrics.json"), document.to_string()).expect("written");
    let baseline = read(Tier::Quick).expect("readable");
    let value = |name| baseline.value(&MetricKey::of("film", &metric(name, 0.0)));
    assert_eq!((value("velocity_l2"), baseline.commit("film").as_str()), (Some(10.0), "0d1e2f"));
    assert!(value("gci").is_some_and(f64::is_nan) && value("wall_slip").is_none());
    assert!(!baseline.change("film", &metric("velocity_l2", 10.05)).has_moved());
    assert!(read(Tier::Paper).is_err_and(|error| error.to_string().contains("quick tier")));
    std::fs::write(place.join("metrics.json"), "{}").expect("written");
    assert!(read(Tier::Quick).is_err_and(|error| error.to_string().contains("metrics.json")));
}
