//! The quick tier's metrics of every case against the baseline, `tests/snapshots/quick/CASE.snap`.
//!
//! The files are insta snapshots, which the report reads as its baseline: one store, and one comparator for both. A value
//! may move by its own tolerance. To accept what has moved farther, read the report first, then
//! `cargo run -- report --accept --cases CASE`.

mod measured_points;

use crate::physics::verdict::results;
use bagnold_harness::case::{CaseResult, Changes, Tier};
use bagnold_harness::evidence::ValidationSet;
use bagnold_harness::metric::{Metric, Quantity, Variant};
use bagnold_report::{Baseline, GateList, MetricKey, RemovedGates, description};
use bagnold_validation::REGISTRY;
use insta::comparator::Comparator;
use insta::{Settings, Snapshot};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots")
}

/// The report's comparison, by each metric's tolerance instead of by text.
#[derive(Clone)]
struct WithinTolerance {
    case: &'static str,
    metrics: Vec<Metric>,
}

impl Comparator for WithinTolerance {
    fn matches(&self, _: &Snapshot, _: &Snapshot) -> bool {
        let differences = Baseline::read(&folder(), self.case, Tier::Quick)
            .map_or_else(|error| vec![format!("failed to {error}")], |own| own.differences(self.case, &self.metrics));
        if !differences.is_empty() {
            // insta's own difference below also shows what moved within its tolerance
            eprintln!("{}, not as in the baseline:\n{}\n", self.case, differences.join("\n"));
        }
        differences.is_empty()
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(self.clone())
    }
}

/// Metrics whose name or unit is not that of a declared quantity; none where a case declares nothing.
fn undeclared<'a>(quantities: &[Quantity], metrics: &'a [Metric]) -> impl Iterator<Item = &'a Metric> {
    metrics.iter().filter(|metric| {
        let declares = |quantity: &Quantity| quantity.name == metric.name && quantity.unit == metric.unit;
        !quantities.is_empty() && !quantities.iter().any(declares)
    })
}

#[test]
fn undeclared_metric_is_found() {
    const FRONT: Quantity = Quantity::verified("front", "m", "how far the front has come");
    let variant = Variant::default();
    let metrics = [FRONT.of(&variant, 1.0), Metric::observed("fornt", &variant, 1.0, "m")];
    let names = |quantities: &[Quantity]| undeclared(quantities, &metrics).map(|m| m.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&[FRONT]), ["fornt"]);
    assert_eq!(names(&[Quantity { unit: "cm", ..FRONT }]), ["front", "fornt"]);
    assert!(names(&[]).is_empty());
}

fn assert_as_in_baseline(name: &'static str) {
    let case = REGISTRY.find(name).unwrap_or_else(|error| panic!("{name}: {error}"));
    for result in results(name, Tier::Quick) {
        let strangers: Vec<String> = undeclared(case.quantities(), &result.metrics)
            .map(|metric| format!("{} [{}]", metric.name, metric.unit))
            .collect();
        assert!(strangers.is_empty(), "{name} does not declare {}", strangers.join(", "));
        let list = GateList::read(&folder(), Tier::Quick).unwrap_or_else(|error| panic!("failed to {error}"));
        let moved = list.moved_limits(name, &result.metrics);
        assert!(moved.is_empty(), "{}", moved.join("\n"));
        let mut settings = Settings::clone_current();
        settings.set_snapshot_path("quick");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_description(description(name, "quick"));
        settings.set_comparator(Box::new(WithinTolerance { case: name, metrics: result.metrics.clone() }));
        let content = Baseline::of(name, &result.metrics).content(name);
        settings.bind(|| insta::assert_snapshot!(name, content));
    }
}

#[test]
fn the_metrics_of_every_case_are_as_in_the_baseline() {
    // One case after the other: each uses all cores.
    let failed: Vec<&str> = REGISTRY
        .iter()
        .map(|case| case.name())
        .filter(|name| std::panic::catch_unwind(|| assert_as_in_baseline(name)).is_err())
        .collect();
    assert!(failed.is_empty(), "not as in the baseline, see above: {}", failed.join(", "));
    // of the same runs, which are stored by now
    measured_points::assert_enough();
}

/// `cargo test --test suite snapshots:: -- --ignored --nocapture` prints the list.
#[test]
#[ignore = "the test above asks the same; this one shows what judges, of stored runs"]
fn measured_points_are_judged() {
    measured_points::assert_enough();
}

/// The baseline values of all cases.
fn accepted(tier: Tier) -> Baseline {
    let mut baseline = Baseline::default();
    for case in REGISTRY.iter() {
        let own = Baseline::read(&folder(), case.name(), tier).unwrap_or_else(|error| panic!("failed to {error}"));
        baseline.extend(own);
    }
    baseline
}

fn gates(tier: Tier) -> GateList {
    GateList::read(&folder(), tier).unwrap_or_else(|error| panic!("failed to {error}"))
}

/// Cases whose accepted values of the paper tier are older than the gates that judge them: `bagnold report --tier paper --accept
/// --cases CASE` renews them, in minutes to hours each.
const OLDER: [&str; 0] = [];

#[test]
fn accepted_values_are_no_older_than_their_gates_but_for_the_cases_named() {
    let quick = accepted(Tier::Quick);
    assert!(gates(Tier::Quick).older(&quick).is_empty(), "the quick tier is renewed with every change");
    let paper = accepted(Tier::Paper);
    let mut older = gates(Tier::Paper).older(&paper);
    let judged: BTreeSet<&str> = paper.gates().map(|gate| &*gate.case).collect();
    older.extend(quick.gates().map(|gate| &*gate.case).filter(|case| !judged.contains(case)));
    let older: Vec<&str> = older.into_iter().collect();
    assert_eq!(older, OLDER, "a case that is older now has to be simulated again, one that is not goes from the list");
}

#[test]
fn axes_that_are_told_before_a_run_are_those_of_its_figures() {
    let axes = |result: &CaseResult| -> BTreeSet<String> {
        let curves = result.figures.iter().flat_map(|figure| &figure.panels).filter(|panel| panel.field.is_none());
        curves.map(|panel| format!("{} over {}", panel.y.label, panel.x.label)).collect()
    };
    for case in REGISTRY.iter() {
        let prepared = case.prepare(Tier::Quick, &Changes::default()).unwrap_or_else(|error| panic!("{error}"));
        let told = axes(&CaseResult { figures: prepared.axes(), ..CaseResult::default() });
        for result in results(case.name(), Tier::Quick) {
            let drawn = axes(&result);
            let untold: Vec<&String> = drawn.difference(&told).collect();
            assert!(told.is_empty() || untold.is_empty(), "{} does not tell {untold:?}", case.name());
        }
    }
}

#[test]
fn no_gate_is_lost_without_a_reason() {
    let removed = RemovedGates::read(&folder()).unwrap_or_else(|error| panic!("failed to {error}"));
    for tier in [Tier::Quick, Tier::Paper] {
        let (baseline, list) = (accepted(tier), gates(tier));
        let differences = list.differences(tier, &baseline, &removed);
        assert!(differences.is_empty(), "{tier} tier:\n{}", differences.join("\n"));
    }
}

#[test]
fn the_comparisons_are_of_the_baseline() {
    let path = folder().join("comparisons").join("quick.csv");
    let text = std::fs::read_to_string(&path).expect("the comparisons");
    let set = ValidationSet::parse(&text).unwrap_or_else(|error| panic!("failed to read {}: {error}", path.display()));
    let mut wrong = Vec::new();
    for row in &set.comparisons {
        let baseline = Baseline::read(&folder(), &row.case, Tier::Quick);
        let baseline = baseline.unwrap_or_else(|error| panic!("failed to {error}"));
        let key = MetricKey { case: row.case.clone(), metric: row.quantity.clone(), variant: row.variant.clone() };
        // baseline values have nine digits
        if !baseline.value(&key).is_some_and(|value| (value - row.value).abs() <= 1e-8 * value.abs()) {
            wrong.push(format!("{} {} [{}]: {}", row.case, row.quantity, row.variant, row.value));
        }
    }
    assert!(wrong.is_empty(), "run `report --accept --cases CASE` again:\n{}", wrong.join("\n"));
}

#[test]
fn every_case_of_the_baseline_is_registered() {
    for entry in std::fs::read_dir(folder().join("quick")).expect("the baseline") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
        assert!(REGISTRY.find(&name).is_ok(), "{} belongs to no case", path.display());
    }
}
