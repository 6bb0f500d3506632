//! Negative controls of canonical studies: a wrong input that each check which holds must reject.

use bagnold_harness::case::{Request, Silent, execute};
use bagnold_harness::metric::Verdict;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_validation::REGISTRY;

/// A study, the wrong input, and the checks that reject it.
struct Control {
    study: &'static str,
    input: &'static [&'static str],
    rejected_by: &'static [&'static str],
}

const CONTROLS: [Control; 12] = [
    Control {
        study: "footing",
        input: &["material.peak_cohesion=11500.0", "material.residual_cohesion=11500.0"],
        rejected_by: &["bearing_capacity"],
    },
    Control {
        study: "vertical-cut",
        input: &["bulk.bulk_density=2400.0"],
        rejected_by: &["crest_below_the_critical_height"],
    },
    Control {
        study: "vertical-cut",
        input: &["bulk.bulk_density=1700.0"],
        rejected_by: &["crest_above_the_critical_height"],
    },
    Control {
        study: "rankine-walls",
        input: &["material.peak_friction=0.45", "material.residual_friction=0.45"],
        rejected_by: &["active_force", "passive_force"],
    },
    Control { study: "rankine-walls", input: &["bulk.bulk_density=1800.0"], rejected_by: &["force_at_rest"] },
    Control {
        study: "dam-break-wet-bed",
        input: &["gravity=[0.0, -12.0]"],
        rejected_by: &["mass_through_the_dam", "arrival_of_the_bore"],
    },
    Control {
        study: "dam-break-wet-bed",
        input: &["bodies=[{ shape = \"box\", lower = [-1.3, 0.0], upper = [0.0, 0.22] }, \
                  { shape = \"box\", lower = [0.0, 0.0], upper = [1.5, 0.1] }]"],
        rejected_by: &["depth_of_the_plateau"],
    },
    Control { study: "jet-on-plate", input: &["bulk.bulk_density=1050.0"], rejected_by: &["force_on_the_plate"] },
    Control {
        study: "standing-wave",
        input: &["bodies=[{ shape = \"box\", lower = [0.0, 0.0], upper = [1.0, 0.3] }]"],
        rejected_by: &["depth_at_the_start"],
    },
    Control { study: "plane-poiseuille", input: &["gravity=[1.1, 0.0]"], rejected_by: &["drag_on_the_lower_plate"] },
    Control {
        study: "plane-poiseuille",
        input: &["material.viscosity=5.25"],
        rejected_by: &["discharge_of_the_middle"],
    },
    Control {
        study: "plane-poiseuille",
        input: &["material.viscosity=3.0"],
        rejected_by: &["discharge_of_the_middle"],
    },
];

#[test]
fn checks_of_canonical_studies_reject_their_controls() {
    let mut accepted = Vec::new();
    for Control { study, input, rejected_by } in &CONTROLS {
        let settings: Vec<String> = input.iter().map(|&setting| setting.to_owned()).collect();
        let request = Request { target: study, settings: &settings, ..Request::default() };
        let prepared = request.prepare(*REGISTRY).unwrap_or_else(|error| panic!("{study}: {error}")).prepared;
        let results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent);
        let metrics = results.unwrap_or_else(|error| panic!("{study}: {error}")).remove(0).metrics;
        for check in *rejected_by {
            let judged: Vec<_> = metrics.iter().filter(|metric| metric.name == *check).collect();
            assert_eq!(judged.len(), 1, "{study}: {check}");
            if judged[0].verdict() != Verdict::Fail {
                accepted.push(format!("{study} {check} is {} with {}", judged[0].value, input.join(" ")));
            }
        }
    }
    assert!(accepted.is_empty(), "a wrong input passes:\n{}", accepted.join("\n"));
}

/// Two checks of one run in two windows: both are drawn.
#[test]
fn a_figure_shows_every_window_that_is_judged() {
    let request = Request { target: "rankine-walls", ..Request::default() };
    let prepared = request.prepare(*REGISTRY).expect("a study").prepared;
    let result = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent).expect("a result").remove(0);
    let figure = result.figures.iter().find(|figure| figure.name == "gauges-wall-force-along-x-n-m").expect("a figure");
    let active =
        figure.panels[0].series.iter().find(|series| series.label.starts_with("variant=active")).expect("a run");
    let all = figure.panels[0].series.iter().filter(|series| series.colour == active.colour);
    let times: Vec<f64> = all.flat_map(|series| &series.points).map(|point| point.0).collect();
    assert!(times.iter().any(|time| *time < 0.1) && times.iter().any(|time| *time > 0.5), "{times:?}");
}

/// Every check with a limit that holds has a control; one that fails today cannot show that it rejects anything.
#[test]
fn every_check_that_holds_has_a_control() {
    let failing = crate::known_failures::read();
    let mut without = Vec::new();
    for study in REGISTRY.studies() {
        let text: toml::Table = study.show(bagnold_harness::case::Tier::Quick).parse().expect("a study");
        for check in text["checks"].as_array().expect("checks") {
            let name = check["name"].as_str().expect("a name");
            let is_gate =
                ["within", "at_most", "at_least", "within_uncertainties"].iter().any(|key| check.get(key).is_some());
            let fails = failing.failures.iter().any(|entry| entry.case == study.name() && entry.metric == name);
            let is_rejecting = |control: &Control| control.study == study.name() && control.rejected_by.contains(&name);
            if is_gate && !fails && !CONTROLS.iter().any(is_rejecting) {
                without.push(format!("{} {name}", study.name()));
            }
        }
    }
    assert!(without.is_empty(), "no control: {}", without.join(", "));
}
