//! The rows of the papers speak of what is there: files, tests, cases, metrics, runs.

use crate::structure::source::workspace;
use bagnold_dev::mutation::Mutations;
use bagnold_harness::case::{Changes, Tier};
use bagnold_harness::evidence::{Element, PAPERS};
use bagnold_harness::metric::Variant;
use bagnold_validation::REGISTRY;
use std::collections::BTreeMap;

fn elements() -> impl Iterator<Item = (String, &'static Element)> {
    PAPERS.iter().flat_map(|paper| paper.elements.iter().map(|row| (format!("{} {}", paper.name, row.id), row)))
}

fn assert_none(wrong: &[String]) {
    assert!(wrong.is_empty(), "reference-data/papers:\n{}", wrong.join("\n"));
}

#[test]
fn every_implementation_is_a_file() {
    let is_gone = |row: &Element| row.implemented.as_ref().is_some_and(|path| !workspace().join(path).is_file());
    let wrong: Vec<String> = elements()
        .filter(|(_, row)| is_gone(row))
        .map(|(name, row)| format!("{name}: no file {}", row.implemented.as_deref().unwrap_or_default()))
        .collect();
    assert_none(&wrong);
}

#[test]
fn every_test_is_in_its_file() {
    let mut wrong = Vec::new();
    for (name, row) in elements() {
        for test in &row.tests {
            let (file, function) = test.split_once("::").unwrap_or_default();
            let text = std::fs::read_to_string(workspace().join(file)).unwrap_or_default();
            if !text.contains(&format!("fn {function}(")) {
                wrong.push(format!("{name}: no test {test}"));
            }
        }
    }
    assert_none(&wrong);
}

/// `bagnold-dev mutate --tests` shows that the test fails.
#[test]
fn every_element_that_rests_on_tests_alone_names_an_error_that_one_of_them_notices() {
    let mutations = Mutations::read(&workspace()).expect("a file of mutations");
    let mut wrong = Vec::new();
    for (name, row) in elements() {
        let rests_on_tests = row.not_covered.is_none() && row.metrics.is_empty() && row.runs.is_empty();
        let error = row.control.as_ref().and_then(|control| mutations.find(control));
        let is_noticed = error.is_some_and(|error| row.tests.iter().any(|test| error.tests.contains(test)));
        if rests_on_tests && !is_noticed {
            wrong.push(format!("{name}: {:?} is no error that its tests notice", row.control));
        }
    }
    assert_none(&wrong);
}

/// Variants of all runs of a case over its tiers.
fn runs() -> BTreeMap<&'static str, Vec<Variant>> {
    let of_case = |name: &str| -> Vec<Variant> {
        let case = REGISTRY.find(name).expect("registered");
        let tiers = [Tier::Quick, Tier::Paper, Tier::Fine].into_iter();
        let prepared = tiers.map(|tier| case.prepare(tier, &Changes::default()).expect("the tiers are valid"));
        prepared.flat_map(|plan| (0..plan.run_count()).map(|run| plan.variant(run)).collect::<Vec<_>>()).collect()
    };
    REGISTRY.iter().map(|case| (case.name(), of_case(case.name()))).collect()
}

#[test]
fn every_metric_is_declared_by_its_case_and_of_runs_that_a_tier_has() {
    let runs = runs();
    let mut wrong = Vec::new();
    for (name, row) in elements() {
        for shown in &row.metrics {
            let Ok(case) = REGISTRY.find(&shown.case) else {
                wrong.push(format!("{name}: no case {}", shown.case));
                continue;
            };
            if !case.quantities().iter().any(|quantity| quantity.name == shown.metric) {
                wrong.push(format!("{name}: {} declares no {}", shown.case, shown.metric));
            }
            // a key that no run has is of the metric, as `height` of a part of a profile
            let own = &runs[case.name()];
            let of_runs = |key: &str| own.iter().any(|run| run.get(key).is_some());
            let has = |run: &Variant| {
                let known = shown.variant.parts().filter(|(key, _)| of_runs(key));
                known.into_iter().all(|(key, value)| run.get(key) == Some(value))
            };
            if !own.iter().any(has) {
                wrong.push(format!("{name}: no tier of {} has a run [{}]", shown.case, shown.variant));
            }
        }
        for run in &row.runs {
            if !runs.get(run.case.as_str()).is_some_and(|own| own.iter().any(|variant| run.names(variant))) {
                wrong.push(format!("{name}: no tier of {} has a run [{}]", run.case, run.variant));
            }
        }
    }
    assert_none(&wrong);
}

#[test]
fn every_figure_is_of_a_case() {
    let is_of_case = |figure: &str| figure.split_once('/').is_some_and(|(case, _)| REGISTRY.find(case).is_ok());
    let figures = elements().flat_map(|(name, row)| row.figures.iter().map(move |figure| (name.clone(), figure)));
    let wrong: Vec<String> = figures
        .filter(|(_, figure)| !is_of_case(figure))
        .map(|(name, figure)| format!("{name}: {figure} is of no case"))
        .collect();
    assert_none(&wrong);
}
