//! The list of gates that are expected to fail: every entry must speak of something that is still measured.

use crate::physics::verdict::complaints;
use bagnold_harness::case::{CaseResult, Changes, RunSummary, Tier};
use bagnold_harness::metric::{Confidence, Limit, Metric, Variant};
use bagnold_harness::observation::Outcome;
use bagnold_report::{ExpectedFailure, ExpectedFailures, FailureKind};
use bagnold_validation::REGISTRY;
use std::path::Path;

/// The committed list.
pub(crate) fn read() -> ExpectedFailures {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots/expected_failures.toml");
    ExpectedFailures::read(&path).unwrap_or_else(|error| panic!("failed to {error}"))
}

/// The cheapest tier that has all runs an entry's variant speaks of; it has to measure the metric.
pub(crate) fn owing_tier(entry: &ExpectedFailure) -> Option<Tier> {
    let case = REGISTRY.find(&entry.case).ok()?;
    [Tier::Quick, Tier::Paper, Tier::Fine].into_iter().find(|&tier| {
        case.prepare(tier, &Changes::default()).is_ok_and(|prepared| {
            let runs: Vec<Variant> = (0..prepared.run_count()).map(|run| prepared.variant(run)).collect();
            let is_run: fn(&Variant, &Variant) -> bool =
                if case.is_study() || entry.variant.get(QUANTITY).is_some() { has_all } else { Variant::eq };
            runs_of(&entry.variant).iter().all(|wanted| runs.iter().any(|run| is_run(run, wanted)))
        })
    })
}

/// The key that says what of many runs a metric is about.
const QUANTITY: &str = "quantity";
/// The keys that are of the metric and not of its runs.
const OF_METRIC: [&str; 4] = [QUANTITY, "time", "station", "height"];

/// The runs behind a metric: a metric may join several, as in `resolution=10_20_40`, and may say which `quantity` of
/// them it is about.
fn runs_of(variant: &Variant) -> Vec<Variant> {
    let mut runs = vec![Variant::default()];
    for (key, value) in variant.parts().filter(|(key, _)| !OF_METRIC.contains(key)) {
        let with = |run: &Variant| -> Vec<Variant> {
            value.joined().iter().map(|one| run.clone().and(key, one.clone())).collect()
        };
        runs = runs.iter().flat_map(with).collect();
    }
    runs
}

/// Whether a run has all these values: a metric over many runs, which names a quantity, says only what they have in
/// common. A metric of a single run repeats its whole variant.
fn has_all(run: &Variant, wanted: &Variant) -> bool {
    wanted.parts().all(|(key, value)| run.get(key) == Some(value))
}

#[test]
fn every_expected_failure_names_runs_of_a_case() {
    let stale: Vec<String> = read()
        .failures
        .iter()
        .filter(|entry| owing_tier(entry).is_none())
        .map(|entry| format!("{} {} [{}]", entry.case, entry.metric, entry.variant))
        .collect();
    assert!(stale.is_empty(), "no tier has these runs, remove the entries:\n{}", stale.join("\n"));
}

#[test]
fn every_expected_failure_is_of_a_quantity_that_its_case_declares() {
    for entry in read().failures {
        let case = REGISTRY.find(&entry.case).expect("a case");
        let known = case.quantities();
        assert!(
            known.is_empty() || known.iter().any(|quantity| quantity.name == entry.metric),
            "{} declares no `{}`",
            entry.case,
            entry.metric
        );
    }
}

#[test]
fn reasons_of_expected_failures_are_short_and_attempts_stand_apart() {
    for entry in read().failures {
        let words = entry.reason.split_whitespace().count();
        assert!(words <= 20 && !entry.tried.trim().is_empty(), "{} {}: {words} words", entry.case, entry.metric);
    }
}

fn entry(metric: &str, variant: &str, best_value: f64) -> ExpectedFailure {
    ExpectedFailure {
        case: "film".to_owned(),
        metric: metric.to_owned(),
        variant: variant.parse().expect("a variant"),
        best_value,
        date: "2025-01-31".to_owned(),
        reason: "for the test".to_owned(),
        kind: FailureKind::Defect,
        tried: String::new(),
    }
}

#[test]
fn an_entry_is_owed_by_the_cheapest_tier_that_has_its_runs() {
    let tier = |variant: &str| owing_tier(&entry("observed_order", variant, 1.0));
    assert_eq!(tier("fluid=newtonian,particles=lattice,resolution=10_20"), Some(Tier::Quick));
    assert_eq!(tier("fluid=newtonian,particles=lattice,resolution=10_20_40"), Some(Tier::Paper));
    assert_eq!(tier("fluid=bingham,particles=jittered,resolution=80"), Some(Tier::Fine));
    assert_eq!(tier("fluid=honey,particles=jittered,resolution=20"), None);
    assert_eq!(tier("quantity=flux,fluid=newtonian,particles=lattice,resolution=10_20_40"), Some(Tier::Paper));
    assert_eq!(tier("quantity=flux,fluid=newtonian,particles=lattice,resolution=10_21"), None);
    // what a run does not say in full is stale, but for a quantity over several runs
    assert_eq!(tier("fluid=newtonian,resolution=20"), None);
    assert_eq!(tier("quantity=flux,fluid=newtonian,resolution=20"), Some(Tier::Quick));
}

/// A result of `film` with one gate at 1.
fn result(value: f64, outcome: Outcome) -> CaseResult {
    let variant: Variant = "fluid=bingham,particles=jittered,resolution=20".parse().expect("a variant");
    let metric = Metric::observed("velocity_l2", &variant, value, "%")
        .gated(Limit::AtMost(1.0), "for the test")
        .with_snapshot_tolerance(0.05, 0.0);
    CaseResult {
        name: "film".to_owned(),
        origin: REGISTRY.origin(),
        summary: String::new(),
        description: String::new(),
        tier: Tier::Quick,
        parameters_toml: String::new(),
        command: String::new(),
        metrics: vec![metric],
        figures: Vec::new(),
        animations: Vec::new(),
        tables: Vec::new(),
        run_parameters: vec![serde_json::Value::Null],
        regimes: Vec::new(),
        runs: vec![RunSummary {
            variant,
            outcome,
            particles: 1,
            steps: 1,
            simulated_time: 1.0,
            wall_seconds: 1.0,
            threads: 1,
            microseconds_per_particle_step: None,
            state_hash: String::new(),
            from_store: false,
        }],
        frames: Vec::new(),
        first_bad: Vec::new(),
        state_hash: String::new(),
    }
}

#[test]
fn the_verdict_can_fail_in_every_way() {
    let variant = "fluid=bingham,particles=jittered,resolution=20";
    let none = ExpectedFailures::default();
    let listed = ExpectedFailures { failures: vec![entry("velocity_l2", variant, 2.0)] };
    let stale = ExpectedFailures { failures: vec![entry("gone", variant, 2.0)] };
    let judged = |value, list: &ExpectedFailures| complaints(&result(value, Outcome::Finished), list, Tier::Quick);
    assert_eq!(judged(0.9, &none), [""; 0]);
    assert_eq!(judged(2.0, &listed), [""; 0]);
    assert_eq!(
        judged(2.5, &none),
        [format!("  velocity_l2 [{variant}] = 2.500000e0 %, limit ≤ 1 %, margin -1.5000e0 %: the gate fails")]
    );
    let one = |lines: Vec<String>, words: &str| assert!(lines.len() == 1 && lines[0].contains(words), "{lines:?}");
    let mut beside = result(0.9, Outcome::Finished);
    beside.metrics[0] = beside.metrics[0].clone().against(Some(1.5), "a law", Confidence::High);
    one(complaints(&beside, &none, Tier::Quick), "its reference, 1.5, lies outside of its own limit, ≤ 1");
    one(judged(f64::NAN, &none), "the gate fails");
    one(judged(0.9, &listed), "now passes");
    one(judged(2.5, &listed), "became worse");
    one(judged(0.9, &stale), "is not measured");
    assert_eq!(complaints(&result(0.9, Outcome::Finished), &stale, Tier::Paper), [""; 0]);
    let diverged = |expected| Outcome::Diverged { message: "diverged at t = 1 s".to_owned(), expected };
    one(complaints(&result(0.9, diverged(false)), &none, Tier::Quick), "diverged at t = 1 s");
    assert_eq!(complaints(&result(0.9, diverged(true)), &none, Tier::Quick), [""; 0]);
}
