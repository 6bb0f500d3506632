//! Tests of the baseline: what the file keeps, what counts as moved.

use super::*;
use crate::metric::{Limit, Variant};

fn metric(name: &str, value: f64) -> Metric {
    Metric::observed(name, &Variant::of("resolution", 40), value, "%").with_snapshot_tolerance(0.01, 0.001)
}

#[test]
fn values_survive_the_file_and_other_tiers_stay_apart() {
    let folder = tempfile::tempdir().expect("folder");
    let metrics = [metric("velocity_l2", 0.512_345_678_912), metric("wall_slip", f64::NAN), metric("a", 0.0)];
    let written = Baseline::of("bagnold", &metrics);
    let path = written.write(folder.path(), "bagnold", Tier::Quick, "0d1e2f+changes").expect("written");
    assert!(path.ends_with("quick/bagnold.snap"));
    let text = std::fs::read_to_string(&path).expect("a file");
    assert!(text.find("wall_slip") < text.find("a |"), "in the order of the case");
    let read = Baseline::read(folder.path(), "bagnold", Tier::Quick).expect("read");
    assert_eq!(read.value(&MetricKey::of("bagnold", &metrics[0])), Some(0.512_345_679));
    assert!(read.value(&MetricKey::of("bagnold", &metrics[1])).is_some_and(f64::is_nan));
    assert_eq!(read.differences("bagnold", &metrics), [""; 0]);
    assert_eq!((read.commit("bagnold").as_str(), read.commit("film").as_str()), ("0d1e2f+changes", ""));
    for (metrics, commit) in [(&metrics[..], "0d1e2f+changes"), (&metrics[..2], "later")] {
        Baseline::of("bagnold", metrics).write(folder.path(), "bagnold", Tier::Quick, "later").expect("written");
        let read = Baseline::read(folder.path(), "bagnold", Tier::Quick).expect("read");
        assert_eq!(read.commit("bagnold"), commit, "values that stay keep theirs");
    }
    assert!(Baseline::read(folder.path(), "bagnold", Tier::Paper).expect("missing is empty").is_empty());
    assert!(Baseline::read(folder.path(), "../bagnold", Tier::Paper).is_err());
}

#[test]
fn a_value_moves_beyond_its_relative_tolerance_and_floor() {
    let baseline = Baseline::of("bagnold", &[metric("velocity_l2", 0.5)]);
    // 0.01 · 0.5 + 0.001 = 0.006
    assert!(!baseline.change("bagnold", &metric("velocity_l2", 0.5059)).has_moved());
    assert!(!baseline.change("bagnold", &metric("velocity_l2", 0.4941)).has_moved());
    assert!(baseline.change("bagnold", &metric("velocity_l2", 0.5061)).has_moved());
    assert!(baseline.change("bagnold", &metric("velocity_l2", 0.4939)).has_moved());
    assert!(baseline.change("bagnold", &metric("velocity_l2", f64::NAN)).has_moved());
    assert!(baseline.change("bagnold", &metric("velocity_l2", f64::INFINITY)).has_moved());
    assert_eq!(baseline.change("bagnold", &metric("other", 1.0)), Change::New);
    assert_eq!(baseline.change("film", &metric("velocity_l2", 1.0)), Change::New);
    let mut other_unit = metric("velocity_l2", 0.5);
    other_unit.unit = "-".to_owned();
    assert!(baseline.change("bagnold", &other_unit).has_moved());
}

#[test]
fn a_metric_without_tolerance_is_compared_to_the_ninth_figure() {
    let exact = |value: f64| metric("mass", value).with_snapshot_tolerance(0.0, 0.0);
    let baseline = Baseline::of("film", &[exact(0.123_456_789_4)]);
    assert!(!baseline.change("film", &exact(0.123_456_789_4)).has_moved());
    assert!(baseline.change("film", &exact(0.123_456_790_1)).has_moved());
    let zero = Baseline::of("film", &[exact(0.0)]);
    assert!(!zero.change("film", &exact(-0.0)).has_moved());
    assert!(zero.change("film", &exact(1e-300)).has_moved());
}

#[test]
fn a_value_that_is_not_a_number_moves_only_by_becoming_one() {
    let baseline = Baseline::of("bagnold", &[metric("gci", f64::NAN), metric("order", f64::INFINITY)]);
    assert!(!baseline.change("bagnold", &metric("gci", f64::NAN)).has_moved());
    assert!(baseline.change("bagnold", &metric("gci", 1.0)).has_moved());
    assert!(!baseline.change("bagnold", &metric("order", f64::INFINITY)).has_moved());
    assert!(baseline.change("bagnold", &metric("order", f64::NAN)).has_moved());
}

#[test]
fn a_gate_that_changes_sides_within_the_tolerance_is_a_change() {
    let gated = |value: f64| metric("velocity_l2", value).gated(Limit::AtMost(1.0), "for the test");
    let baseline = Baseline::of("film", &[gated(1.0)]);
    assert_eq!(baseline.change("film", &gated(1.001)), Change::VerdictChanged(Verdict::Pass));
    assert!(baseline.change("film", &metric("velocity_l2", 1.0)).has_moved(), "the gate has gone");
}

#[test]
fn vanished_metrics_are_named() {
    let mut baseline = Baseline::of("bagnold", &[metric("velocity_l2", 0.5), metric("gci", 0.1)]);
    baseline.extend(Baseline::of("film", &[metric("velocity_l2", 0.5)]));
    let vanished = baseline.vanished("bagnold", &[metric("velocity_l2", 0.5)]);
    assert_eq!(vanished.len(), 1);
    assert_eq!(vanished[0].metric, "gci");
}

#[test]
fn differences_are_told_in_words() {
    let gated = |value: f64| metric("velocity_l2", value).gated(Limit::AtMost(0.55), "for the test");
    let baseline = Baseline::of("film", &[gated(0.548), metric("gci", 0.1)]);
    let other_unit = Metric { unit: "-".to_owned(), ..metric("gci", 0.1) };
    assert_eq!(
        baseline.differences("film", &[gated(0.56), other_unit, metric("new", 1.0)]),
        [
            "velocity_l2 [resolution=40] was 0.548\u{202f}%, is 0.56\u{202f}%: change 1.200e-2, tolerance 6.480e-3",
            "gci [resolution=40] was in %, is in -",
            "new [resolution=40] is not in the baseline",
        ]
    );
    assert_eq!(
        baseline.differences("film", &[gated(0.551)]),
        [
            "velocity_l2 [resolution=40] is within its tolerance, but the verdict was pass, is fail",
            "gci [resolution=40] is no longer measured",
        ]
    );
}

#[test]
fn a_damaged_or_foreign_file_is_refused_with_its_path() {
    let folder = tempfile::tempdir().expect("folder");
    let good = Baseline::of("film", &[metric("gci", 0.1)]);
    let path = good.write(folder.path(), "film", Tier::Quick, "").expect("written");
    let text = std::fs::read_to_string(&path).expect("a file");
    let line = text.lines().last().expect("a line");
    for damaged in [String::new(), format!("{text}{line}\n"), text.replace("film", "x"), text.replace("0.1", "")] {
        std::fs::write(&path, damaged).expect("file");
        let error = Baseline::read(folder.path(), "film", Tier::Quick).expect_err("refused");
        assert!(error.to_string().contains("film.snap"), "{error}");
    }
}

/// A gate that vanishes is a failure, with what took it away.
#[test]
fn gates_that_are_not_judged_are_named_with_the_reason() {
    let metric = |name: &str| Metric::observed(name, &Variant::of("a", 3), 1.0, "m");
    let gated = |name: &str| metric(name).gated(crate::metric::Limit::AtMost(2.0), "a reason");
    let before = Baseline::of("heap", &[gated("front"), gated("height"), gated("width"), metric("angle")]);
    assert!(before.not_judged("heap", &[gated("front"), gated("height"), gated("width")]).is_empty());
    let unsteady = gated("speed").unless(Some(&"it still rises".to_owned()));
    let gone = before.not_judged("heap", &[gated("front"), metric("height"), unsteady]);
    let lines: Vec<String> = gone.iter().map(|(key, reason)| format!("{}: {reason}", key.metric)).collect();
    assert_eq!(
        lines,
        [
            "height: no limit applies to these runs and parameters; it still rises",
            "width: the metric is no longer measured; it still rises",
        ]
    );
}
