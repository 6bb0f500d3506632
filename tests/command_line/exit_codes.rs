//! 0 no new failure, 1 a new failure, 2 bad input (see `bad_input`), 3 diverged.

use crate::command_line::program::{CHEAP, Place, document};
use bagnold_harness::metric::Verdict;
use bagnold_harness::observation::Outcome;

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
fn a_profile_goes_to_standard_error_and_leaves_the_document_alone() {
    let place = Place::new();
    let finished = place.run(&[CHEAP, &["--json", "--profile"]].concat()).code(0);
    assert_eq!(document(&finished).case, "film");
    let text = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
    assert!(text.starts_with("profile: ") && text.contains("cores busy"), "{text}");
    assert_eq!(text.matches(" µs per particle and step  film ").count(), 1, "one run: {text}");
}

#[test]
fn one_and_no_number_where_a_flow_is_not_steady() {
    let place = Place::new();
    // fine grains that have run a tenth of the time that they need
    let settings = "variants=[] slope_angle=21.731 material.static_friction=0.359 material.limiting_friction=0.547 \
                    material.reference_inertia=0.637 material.grain_diameter=0.000296 layer_height=0.0123 solid_fraction=0.587 \
                    averaging_time=0.2 duration_factor=0.1";
    let settings = settings.split_whitespace().flat_map(|setting| ["--set", setting]);
    let arguments: Vec<&str> = ["bagnold", "--quiet", "--json"].into_iter().chain(settings).collect();
    let document = document(&place.run(&arguments).code(1));
    let of_profile: Vec<_> = document.metrics.iter().filter(|metric| metric.remark.is_some()).collect();
    assert!(of_profile.len() >= 4, "{} metrics are not steady", of_profile.len());
    for metric in of_profile {
        assert_eq!(metric.value, None, "{}", metric.name);
        assert_ne!(metric.verdict, Verdict::Pass, "{}", metric.name);
    }
}

/// A file of verdicts that stayed as it was would be green.
#[test]
fn a_refused_command_leaves_no_green_verdicts() {
    let place = Place::new();
    let junit = |arguments: &[&str], code: i32| {
        place.bagnold(&[arguments, &["--quiet", "--junit", "ci.xml"]].concat()).assert().code(code);
        std::fs::read_to_string(place.path("ci.xml")).expect("written")
    };
    let green = junit(&[&["run"], CHEAP, &["--out", "out"]].concat(), 0);
    assert!(green.contains("errors=\"0\"") && green.contains("particles_lost"), "{green}");
    for arguments in [
        &["judge", "none.toml", "--out", "judged"][..],
        &["run", "film", "--set", "density=-1"],
        &["run", "none.toml"],
        &["run", "film", "--tier", "qick"],
        &["report", "--cases", "none"],
    ] {
        let red = junit(arguments, 2);
        assert!(red.contains("tests=\"1\"") && red.contains("errors=\"1\""), "{arguments:?}: {red}");
        assert!(red.contains("type=\"refusal\"") && !red.contains("particles_lost"), "{arguments:?}: {red}");
        place.file("ci.xml", &green);
    }
    place.file("ci.xml", "mine");
    assert_eq!(junit(&["run", "none.toml"], 2), "mine", "another file is kept");
}

#[test]
fn one_when_a_gate_fails() {
    let place = Place::new();
    // a twentieth of the time that the film needs to reach its steady profile
    let settings = ["resolution=20", "--set", "relaxation_times=0.05", "--json"];
    let (_, but_resolution) = CHEAP.split_last().expect("settings");
    let document = document(&place.run(&[but_resolution, &settings].concat()).code(1).stderr(""));
    assert!(document.metrics.iter().any(|metric| metric.verdict == Verdict::Fail));
    assert!(document.runs.iter().all(|run| run.outcome == Outcome::Finished), "nothing diverged");
    assert!(place.path("out/metrics.json").is_file(), "the numbers are kept all the same");
}

#[test]
fn one_when_a_search_is_left_undecided() {
    let place = Place::new();
    // half a second: at 24° the layer neither stops nor becomes steady in it
    let angles = ["--set", "slope_angle=20.0", "--set", "flowing_angle=24.0"];
    let search = [&["--vary", "material.law=mu-i", "--set", "duration=0.5"], &angles[..]].concat();
    let document = document(&place.run(&[&["flow-thickness", "--json"], &search[..]].concat()).code(1).stderr(""));
    let angle = document.metrics.iter().find(|metric| metric.name == "stopping_angle").expect("judged");
    assert_eq!((angle.value, angle.verdict), (None, Verdict::Fail));
}

/// Laws that were measured on one material do not judge another: no gate, and no expected failure that is missed.
#[test]
fn zero_for_a_material_that_published_laws_do_not_judge() {
    let place = Place::new();
    let file = "case = \"column-planar\"\naspect_ratio = 1.5\nmaterial = { law = \"mu-i\", friction_angle = 33.0, limiting_friction = 0.9, \
                reference_inertia = 0.279, grain_diameter = 0.0008, grain_density = 2600.0 }\n";
    let file = place.file("my-sand.toml", file);
    // the run of the table's sand has gates, and an expected failure
    let said = place.run(&[&file]).code(0);
    let said = String::from_utf8_lossy(&said.get_output().stdout).into_owned();
    assert!(said.contains("without a reference for these parameters, so not judged: "), "{said}");
    assert!(said.contains("run_out") && !said.contains("NOT JUDGED"), "{said}");
}

#[test]
fn three_when_a_run_diverges() {
    let place = Place::new();
    // five times the stable step of the explicit viscous term
    let settings = ["--set", "material.viscosity=20", "--set", "numerics.viscous_courant=1"];
    let document = document(&place.run(&[CHEAP, &settings, &["--json"]].concat()).code(3));
    let [run] = document.runs.as_slice() else { panic!("one run was asked for") };
    let Outcome::Diverged { message, expected: false } = &run.outcome else { panic!("{:?}", run.outcome) };
    for part in ["diverged at t = ", "(step ", " of particle ", " that the model allows"] {
        assert!(message.contains(part), "{message}");
    }
    assert!(run.steps > 1);
    let printed = place.run(&[CHEAP, &settings].concat()).code(3);
    let printed = String::from_utf8_lossy(&printed.get_output().stdout).into_owned();
    assert!(printed.contains("DIVERGED: ") && printed.contains("NAME-first-bad.pvd"), "{printed}");
}

/// Last good and first bad state of a run that diverges can be opened beside each other.
#[test]
fn a_divergence_leaves_the_states_before_and_after() {
    let place = Place::new();
    place.run(&[CHEAP, &["--set", "material.viscosity=20", "--set", "numerics.viscous_courant=1"]].concat()).code(3);
    let snapshots = place.path("out/snapshots");
    let collections: Vec<String> = std::fs::read_dir(&snapshots)
        .expect("snapshots")
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".pvd"))
        .collect();
    let (bad, good): (Vec<&String>, Vec<&String>) =
        collections.iter().partition(|name| name.ends_with("-first-bad.pvd"));
    assert_eq!((good.len(), bad.len()), (1, 1), "{collections:?}");
    let last = |name: &str, attribute: &str| -> String {
        let text = std::fs::read_to_string(snapshots.join(name)).expect("a collection");
        let opening = format!("{attribute}=\"");
        let found = text.split(&opening).skip(1).filter_map(|rest| rest.split('"').next());
        found.last().expect("an attribute").to_owned()
    };
    let time = |name: &str| -> f64 { last(name, "timestep").parse().expect("a number") };
    // a step that fails has not moved the clock
    assert!(time(bad[0]) >= time(good[0]), "the bad state comes after the good one");
    let bytes = |name: &str| std::fs::read(snapshots.join(last(name, "file"))).expect("a snapshot");
    assert_ne!(bytes(bad[0]), bytes(good[0]), "it is another state");
}

#[test]
fn zero_for_help_version_list_and_show() {
    let place = Place::new();
    for arguments in [&["--help"][..], &["run", "--help"], &["report", "--help"], &["--version"], &["list"]] {
        let finished = place.bagnold(arguments).assert().code(0).stderr("");
        assert!(!finished.get_output().stdout.is_empty());
    }
    for case in bagnold_validation::REGISTRY.cases() {
        let finished = place.bagnold(&["show", case.name()]).assert().code(0).stderr("");
        let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
        assert!(text.starts_with(&format!("case = \"{}\"\ntier = \"quick\"\n", case.name())), "{text}");
    }
}
