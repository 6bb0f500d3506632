//! Every option that parameters leave is used by a run of some tier, or `validation/report/coverage.toml` names the tests that hold it or
//! the reason why none does.

use crate::structure::source::workspace;
use bagnold_harness::case::{CaseResult, Changes, FeatureOption, Features, RunSummary, Tier};
use bagnold_harness::metric::{Limit, Metric, MetricKind, Value, Variant};
use bagnold_harness::observation::Outcome;
use bagnold_report::CaseReport;
use bagnold_report::coverage::{CaseCoverage, DECLARATIONS, Grade, OptionCoverage, coverage};
use bagnold_validation::REGISTRY;
use std::collections::BTreeSet;

/// Options of all runs of all cases over their tiers.
fn used(features: &Features) -> BTreeSet<FeatureOption> {
    let tiers = [Tier::Quick, Tier::Paper, Tier::Fine];
    let plans = REGISTRY.cases().flat_map(|case| tiers.map(|tier| (case, tier)));
    let plans = plans.map(|(case, tier)| case.prepare(tier, &Changes::default()).expect("the tiers are valid"));
    let of_plan = |plan: Box<dyn bagnold_harness::case::PreparedCase>| {
        (0..plan.run_count()).flat_map(|run| features.chosen(&plan.run_parameters(run))).collect::<Vec<_>>()
    };
    plans.flat_map(of_plan).collect()
}

#[test]
fn every_option_is_used_by_a_run_or_declared() {
    let features = Features::of(*REGISTRY);
    let used = used(&features);
    let is_open = |option: &FeatureOption| {
        !used.contains(option) && !DECLARATIONS.is_selection(&option.feature) && DECLARATIONS.of(option).is_none()
    };
    let open: Vec<String> =
        features.options().filter(is_open).map(|option| format!("{} = {}", option.feature, option.option)).collect();
    assert!(
        open.is_empty(),
        "no run of any tier uses these options; let a case use them, or declare them in validation/report/coverage.toml with \
         their tests:\n{}",
        open.join("\n")
    );
}

#[test]
fn every_declaration_is_needed_and_names_tests_that_there_are() {
    let features = Features::of(*REGISTRY);
    let (used, known) = (used(&features), features.options().collect::<BTreeSet<_>>());
    let mut wrong = Vec::new();
    for own in &DECLARATIONS.options {
        let option = FeatureOption { feature: own.feature.clone(), option: own.option.clone() };
        let name = format!("{} = {}", own.feature, own.option);
        if !known.contains(&option) {
            wrong.push(format!("{name}: no parameter has this option"));
        }
        if used.contains(&option) {
            wrong.push(format!("{name}: a case uses it; its row can go"));
        }
        if own.tests.is_empty() && own.open.trim().is_empty() {
            wrong.push(format!("{name}: neither tests nor a reason why there are none"));
        }
        for test in &own.tests {
            let (file, function) = test.split_once("::").unwrap_or((test.as_str(), ""));
            let text = std::fs::read_to_string(workspace().join(file)).unwrap_or_default();
            if function.is_empty() || !text.contains(&format!("fn {function}(")) {
                wrong.push(format!("{name}: no test {test}"));
            }
        }
    }
    for selection in &DECLARATIONS.selections {
        if !known.iter().any(|option| option.feature == selection.feature) || selection.because.trim().is_empty() {
            wrong.push(format!("{}: no such parameter, or no reason", selection.feature));
        }
    }
    assert!(wrong.is_empty(), "validation/report/coverage.toml:\n{}", wrong.join("\n"));
}

fn case(name: &str, metrics: Vec<Metric>) -> CaseReport {
    let result = CaseResult {
        name: name.to_owned(),
        origin: REGISTRY.origin(),
        summary: String::new(),
        description: String::new(),
        tier: Tier::Quick,
        parameters_toml: String::new(),
        command: String::new(),
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
    CaseReport::of(result, *REGISTRY)
}

fn run(kernel: &str) -> RunSummary {
    RunSummary {
        variant: Variant::of("kernel", kernel).and("rows", 10),
        outcome: Outcome::Finished,
        particles: 1,
        steps: 1,
        simulated_time: 1.0,
        wall_seconds: 1.0,
        threads: 1,
        microseconds_per_particle_step: None,
        state_hash: String::new(),
        from_store: false,
    }
}

#[test]
fn a_gate_counts_for_the_options_of_the_runs_that_it_speaks_of() {
    let gate = |name: &str, kernel: &str, kind, value| {
        let variant = Variant::of("kernel", kernel).and("rows", Value::list([10, 20]));
        Metric::observed(name, &variant, value, "-").of_kind(kind).gated(Limit::AtMost(1.0), "a reason")
    };
    let metrics = vec![
        gate("error", "wendland-c2", MetricKind::Verification, 0.5),
        gate("observed_order", "wendland-c2", MetricKind::Verification, 2.0),
        gate("front", "cubic-spline", MetricKind::Validation, 0.5),
        Metric::observed("seen", &Variant::of("kernel", "cubic-spline"), 0.1, "-"),
    ];
    let mut film = case("film", metrics);
    for kernel in ["wendland-c2", "cubic-spline"] {
        film.result.runs.push(run(kernel));
        film.result.run_parameters.push(serde_json::json!({ "numerics": { "kernel": kernel } }));
    }
    let rows = coverage(&Features::of(*REGISTRY), &[film, case("other", Vec::new())]);
    let of = |option: &str| {
        let row = rows.iter().find(|row| row.option.feature == "kernel" && row.option.option == option);
        row.expect("a kernel").cases.clone()
    };
    let exact = CaseCoverage { gates: [(Grade::Exact, 1), (Grade::Converging, 1)].into(), failing: 1 };
    assert_eq!(of("wendland-c2"), [Some(exact), None]);
    let measured = CaseCoverage { gates: [(Grade::Measured, 1)].into(), failing: 0 };
    assert_eq!(of("cubic-spline"), [Some(measured), None]);
    assert!(rows.iter().any(OptionCoverage::is_unused));
}
