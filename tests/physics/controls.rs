//! Controls: every gate names wrong physics or a wrong input that it must reject, and does what its control says of it.

use bagnold_harness::case::{AnyCase, CaseResult, Request, Silent, Tier, execute};
use bagnold_harness::control::{Answer, Control, ControlTrial, TriedControls};
use bagnold_harness::evidence::{MetricName, PAPERS};
use bagnold_harness::metric::{MetricKind, Verdict};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_report::papers::Status;
use bagnold_validation::REGISTRY;
use std::collections::BTreeSet;

/// Results at the quick tier, with changes of parameters where a control has them.
fn results(requests: &[Request<'_>]) -> Vec<CaseResult> {
    let prepare = |request: &Request<'_>| {
        request.prepare(*REGISTRY).unwrap_or_else(|error| panic!("{}: {error}", request.target)).prepared
    };
    let results = execute(requests.iter().map(prepare).collect(), &Store::open(StorePolicy::Use), &Silent);
    results.unwrap_or_else(|error| panic!("{error}"))
}

/// Results of the controls of a case: those that a report runs, and those of its table.
fn trials(case: &dyn AnyCase, right: &CaseResult) -> Vec<ControlTrial> {
    let (controls, tried) = (case.controls(), TriedControls::shipped(case.name()));
    let own: Vec<&Control> = controls.iter().filter(|control| control.is_of_report()).collect();
    let mut requests = Vec::new();
    for control in &own {
        let (settings, only) = (&control.set, &control.only);
        requests.push(Request { target: case.name(), settings, only, ..Request::default() });
    }
    let wrong = results(&requests);
    let mut trials: Vec<ControlTrial> =
        own.into_iter().zip(&wrong).map(|(control, wrong)| wrong.trial(control.clone(), right)).collect();
    for control in controls.iter().filter(|control| !control.is_of_report()) {
        let trial = tried.trial(control);
        trials.push(
            trial.unwrap_or_else(|| {
                panic!("{} {}: run `cargo run -p bagnold-dev -- controls`", case.name(), control.name)
            }),
        );
    }
    trials
}

/// A metric that a control says rejects it does so in one variant at least, and one that it says accepts it in none: the list of what cannot
/// tell right from wrong is as short as it can be.
#[test]
fn gates_do_what_their_controls_say_of_them() {
    let mut contradictions = Vec::new();
    for case in REGISTRY.iter().filter(|case| !case.controls().is_empty()) {
        let right = results(&[Request { target: case.name(), ..Request::default() }]).remove(0);
        for trial in trials(case, &right) {
            let answers = |name: &str| -> Vec<Answer> {
                right
                    .metrics
                    .iter()
                    .filter(|metric| metric.name == name)
                    .filter_map(|metric| trial.answer(metric))
                    .collect()
            };
            let rejects =
                |name: &str| answers(name).iter().any(|answer| matches!(answer, Answer::Rejects | Answer::NotJudged));
            let is_red = |name: &str| {
                let mut own = right.metrics.iter().filter(|metric| metric.name == name);
                own.all(|metric| metric.verdict() != Verdict::Pass)
            };
            let is_judged = |name: &str| !answers(name).is_empty();
            let (case, control) = (case.name(), &trial.control.name);
            for name in &trial.control.rejected_by {
                if is_judged(name) && !rejects(name) && !is_red(name) {
                    contradictions.push(format!("{case} {control}: `{name}` does not reject it: {:?}", answers(name)));
                }
            }
            for entry in &trial.control.accepted_by {
                if rejects(&entry.metric) {
                    contradictions.push(format!("{case} {control}: `{}` rejects it: move it", entry.metric));
                }
            }
        }
    }
    assert!(contradictions.is_empty(), "{}", contradictions.join("\n"));
}

/// Every gate against a reference or a statement, and every canonical study, names a control.
#[test]
fn every_gate_names_a_control() {
    let mut without = BTreeSet::new();
    for case in REGISTRY.iter() {
        let controls = case.controls();
        let right = results(&[Request { target: case.name(), ..Request::default() }]).remove(0);
        for metric in &right.metrics {
            let is_asked = metric.kind != MetricKind::Bookkeeping && metric.verdict() != Verdict::Observed;
            if is_asked && !controls.iter().any(|control| control.is_named_by(&metric.name)) {
                without.insert(format!("{} {}", case.name(), metric.name));
            }
        }
        if case.is_study() && controls.is_empty() {
            without.insert(case.name().to_owned());
        }
    }
    assert!(without.is_empty(), "no control: {without:#?}");
}

/// Every element of a paper that rests on metrics of the quick tier names a control by one of them.
#[test]
fn every_element_that_rests_on_metrics_names_a_control() {
    let mut without = Vec::new();
    let all: Vec<CaseResult> = REGISTRY
        .iter()
        .map(|case| results(&[Request { target: case.name(), ..Request::default() }]).remove(0))
        .collect();
    let is_measured = |name: &MetricName| {
        let own = all.iter().filter(|case| case.name == name.case).flat_map(|case| &case.metrics);
        own.filter(|metric| name.names(&metric.name, &metric.variant)).any(|metric| Status::of(name, metric).is_some())
    };
    for (paper, element) in PAPERS.iter().flat_map(|paper| paper.elements.iter().map(move |row| (paper, row))) {
        let is_named = |case: &str, metric: &str| {
            let case = REGISTRY.find(case).unwrap_or_else(|error| panic!("{error}"));
            case.controls().iter().any(|control| control.is_named_by(metric))
        };
        let names = &element.metrics;
        let is_asked = element.not_covered.is_none() && !names.is_empty() && names.iter().all(is_measured);
        if is_asked && !names.iter().any(|name| is_named(&name.case, &name.metric)) {
            without.push(format!("{} {}", paper.name, element.id));
        }
    }
    assert!(without.is_empty(), "no control: {without:#?}");
}

/// Two checks of one run in two windows: both are drawn.
#[test]
fn a_figure_shows_every_window_that_is_judged() {
    let result =
        results(&[Request { target: "rankine-walls", tier: Some(Tier::Quick), ..Request::default() }]).remove(0);
    let figure = result.figures.iter().find(|figure| figure.name == "gauges-wall-force-along-x-n-m").expect("a figure");
    let active =
        figure.panels[0].series.iter().find(|series| series.label.starts_with("variant=active")).expect("a run");
    let all = figure.panels[0].series.iter().filter(|series| series.colour == active.colour);
    let times: Vec<f64> = all.flat_map(|series| &series.points).map(|point| point.0).collect();
    assert!(times.iter().any(|time| *time < 0.1) && times.iter().any(|time| *time > 0.5), "{times:?}");
}
