//! Every option that parameters leave is used by a run of some tier, or `validation/coverage.toml` names the tests that hold it or
//! the reason why none does.

use crate::source::workspace;
use bagnold_validation::case::{Changes, FeatureOption, Features, Tier};
use bagnold_validation::cases::REGISTRY;
use bagnold_validation::report::coverage::DECLARATIONS;
use std::collections::BTreeSet;

/// Options of all runs of all cases over their tiers.
fn used(features: &Features) -> BTreeSet<FeatureOption> {
    let tiers = [Tier::Quick, Tier::Paper, Tier::Fine];
    let plans = REGISTRY.iter().flat_map(|case| tiers.map(|tier| (case, tier)));
    let plans = plans.map(|(case, tier)| case.prepare(tier, &Changes::default()).expect("the tiers are valid"));
    let of_plan = |plan: Box<dyn bagnold_validation::case::PreparedCase>| {
        (0..plan.run_count()).flat_map(|run| features.chosen(&plan.run_parameters(run))).collect::<Vec<_>>()
    };
    plans.flat_map(of_plan).collect()
}

#[test]
fn every_option_is_used_by_a_run_or_declared() {
    let features = Features::of(REGISTRY);
    let used = used(&features);
    let is_open = |option: &FeatureOption| {
        !used.contains(option) && !DECLARATIONS.is_selection(&option.feature) && DECLARATIONS.of(option).is_none()
    };
    let open: Vec<String> =
        features.options().filter(is_open).map(|option| format!("{} = {}", option.feature, option.option)).collect();
    assert!(
        open.is_empty(),
        "no run of any tier uses these options; let a case use them, or declare them in validation/coverage.toml with \
         their tests:\n{}",
        open.join("\n")
    );
}

#[test]
fn every_declaration_is_needed_and_names_tests_that_there_are() {
    let features = Features::of(REGISTRY);
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
    assert!(wrong.is_empty(), "validation/coverage.toml:\n{}", wrong.join("\n"));
}
