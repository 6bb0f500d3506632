//! 0 all gates hold, 1 a gate fails, 2 bad input (see `bad_input`), 3 diverged.

use crate::program::{CHEAP, Place, document};
use bagnold_validation::metric::Verdict;
use bagnold_validation::observation::Outcome;

#[test]
fn zero_and_one_json_document_when_all_gates_hold() {
    let place = Place::new();
    let finished = place.run(&[CHEAP, &["--json"]].concat()).code(0).stderr("");
    let document = document(&finished);
    assert_eq!(document.case, "film");
    assert!(document.metrics.iter().any(|metric| metric.verdict == Verdict::Pass), "a gate was judged");
    assert!(document.metrics.iter().all(|metric| metric.verdict != Verdict::Fail));
    let written = std::fs::read(place.path("out/metrics.json")).expect("written");
    assert_eq!(written, finished.get_output().stdout, "the file holds what was printed");
}

#[test]
fn one_when_a_gate_fails() {
    let place = Place::new();
    // a twentieth of the time that the film needs to reach its steady profile
    let settings = ["--set", "resolution=20", "--set", "relaxation_times=0.05", "--json"];
    let document = document(&place.run(&[CHEAP, &settings].concat()).code(1).stderr(""));
    assert!(document.metrics.iter().any(|metric| metric.verdict == Verdict::Fail));
    assert!(document.runs.iter().all(|run| run.outcome == Outcome::Finished), "nothing diverged");
    assert!(place.path("out/metrics.json").is_file(), "the numbers are kept all the same");
}

#[test]
fn one_when_a_search_is_left_undecided() {
    let place = Place::new();
    // half a second: at 24° the layer neither stops nor becomes steady in it
    let search = ["--set", "collapse.slope_angles=[]", "--set", "steady_flows=[]", "--set", "stopping_duration=0.5"];
    let document = document(&place.run(&[&["flow-thickness", "--json"], &search[..]].concat()).code(1).stderr(""));
    let angle = document.metrics.iter().find(|metric| metric.name == "stopping_angle").expect("judged");
    assert_eq!((angle.value, angle.verdict), (None, Verdict::Fail));
}

#[test]
fn three_when_a_run_diverges() {
    let place = Place::new();
    // five times the stable step of the explicit viscous term
    let settings = ["--set", "newtonian.viscosity=20", "--set", "numerics.viscous_courant=1"];
    let document = document(&place.run(&[CHEAP, &settings, &["--json"]].concat()).code(3));
    let [run] = document.runs.as_slice() else { panic!("one run was asked for") };
    let Outcome::Diverged { message, expected: false } = &run.outcome else { panic!("{:?}", run.outcome) };
    for part in ["diverged at t = ", "(step ", " of particle ", " that the model allows"] {
        assert!(message.contains(part), "{message}");
    }
    assert!(run.steps > 1);
    let frames = std::fs::read_dir(place.path("out/snapshots")).expect("the last good state is kept").count();
    assert!(frames > 0);
    let printed = place.run(&[CHEAP, &settings].concat()).code(3);
    assert!(String::from_utf8_lossy(&printed.get_output().stdout).contains("DIVERGED: "));
}

#[test]
fn zero_for_help_version_list_and_show() {
    let place = Place::new();
    for arguments in [&["--help"][..], &["run", "--help"], &["report", "--help"], &["--version"], &["list"]] {
        let finished = place.bagnold(arguments).assert().code(0).stderr("");
        assert!(!finished.get_output().stdout.is_empty());
    }
    for case in bagnold_validation::cases::REGISTRY.iter() {
        let finished = place.bagnold(&["show", case.name()]).assert().code(0).stderr("");
        let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
        assert!(text.starts_with(&format!("case = \"{}\"\ntier = \"quick\"\n", case.name())), "{text}");
    }
}
