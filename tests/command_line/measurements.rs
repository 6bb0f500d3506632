//! One file of measurements in every command that takes some.

use crate::command_line::program::{Place, document};

/// A block that collapses within a few seconds of computing.
const FLUME: &str = r#"
case = "scene"
name = "flume"
gravity = [0.0, -9.81]
spacing = 0.01
duration = 0.2
interval = 0.01
sides = { left = { mirror = 0.0 }, right = { open = 0.5 }, bottom = "none", top = "none" }
bodies = [{ shape = "box", lower = [0.0, 0.0], upper = [0.1, 0.1] }]
walls = [{ name = "bed", points = [[0.0, 0.0], [0.5, 0.0]] }]
gauges = [{ kind = "front", name = "front", from = [0.0, 0.0], to = [0.5, 0.0], thickness = 0.01 }]
"#;

const FRONT: &str = "\
# source: own flume
t [s],front [cm],front [cm],front [cm]
0.05,11,12,11.5
# the camera lost a frame here
0.1,13.5,14.5,14
0.195,19,20,18
";

const STUDY: &str = r#"
study = "flume-front"
summary = "A block collapses"
base = "flume.toml"
checks = [{ name = "front", table = "gauges", column = "front: front [m]", compare = "front.csv" }]
"#;

const SUBMISSION: &str = r#"
case = "scene"
base = "flume.toml"
code = { name = "the flume itself" }
run = [{ variant = "scene=flume", series = { file = "front.csv" } }]
"#;

const FIT: &str = r#"
title = "friction of the beads"
parameters = [{ path = "material.static_friction", lower = 0.3, upper = 0.5, levels = 2 }]
[[fit]]
base = "flume.toml"
data = [{ table = "gauges-scene-flume", x = "t [s]", y = "front: front [m]", file = "front.csv" }]
"#;

const SWEEP: &str = r#"
design = "grid"
cases = [{ base = "flume.toml", overlay = ["front.csv"] }]
vary = [{ path = "spacing", values = [0.01, 0.02] }]
"#;

/// Commands with the file that each is given.
const COMMANDS: [(&str, &str, &str); 5] = [
    ("run", "flume.toml", FLUME),
    ("run", "study.toml", STUDY),
    ("judge", "submission.toml", SUBMISSION),
    ("calibrate", "fit.toml", FIT),
    ("sweep", "sweep.toml", SWEEP),
];

fn place(front: &str) -> Place {
    let place = Place::new();
    place.file("front.csv", front);
    COMMANDS.iter().for_each(|(_, name, text)| drop(place.file(name, text)));
    place
}

/// Arguments of a command, with its results in `NAME.out`.
fn arguments<'a>(command: &'a str, file: &'a str, out: &'a str) -> Vec<&'a str> {
    let overlay: &[&str] = if file == "flume.toml" { &["--overlay", "front.csv"] } else { &[] };
    [&["-q", command, file, "--out", out], overlay].concat()
}

#[test]
fn one_file_of_repeats_is_drawn_checked_submitted_fitted_and_swept() {
    let place = place(FRONT);
    let value = |file: &str, name: &str| {
        let out = format!("{file}.out");
        let finished = place.bagnold(&[&arguments("run", file, &out)[..], &["--json"]].concat()).assert();
        let metrics = document(&finished).metrics;
        let own = metrics.iter().find(|metric| metric.name == name).unwrap_or_else(|| panic!("no {name}"));
        (own.value.expect("a number"), own.source.clone())
    };
    let (residual, source) = value("flume.toml", "overlay_residual");
    assert!(residual > 0.0 && residual.is_finite());
    assert_eq!(source.as_deref(), Some("own flume; mean of 3 repeats, which scatter by up to 1 cm"));
    assert_eq!(value("study.toml", "front"), (residual, source));
    for (command, file, _) in &COMMANDS[2..] {
        let out = format!("{file}.out");
        let done = place.bagnold(&arguments(command, file, &out)).assert();
        assert!(done.get_output().status.code().is_some_and(|code| code < 2), "{:?}", done.get_output());
    }
    let read = |name: &str| std::fs::read_to_string(place.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(read("submission.toml.out/index.html").contains("the flume itself"));
    let fitted = read("fit.toml.out/data.csv");
    assert!(fitted.contains("0.115"), "the mean in the unit of the simulation: {fitted}");
    let swept = read("sweep.toml.out/results.csv");
    assert!(
        swept.lines().any(|line| line.contains("overlay_residual") && line.contains(&residual.to_string())),
        "{swept}"
    );
    assert!(read("sweep.toml.out/runs/0001-scene/case.toml").contains("overlay = [\"overlay/front.csv\"]"));
}

/// With seeds every point is evaluated as often, intervals end where the emulator says, and the written case is one that was averaged.
#[test]
fn a_fit_over_seeds_counts_once_names_its_ends_and_writes_a_case_with_its_overlay() {
    let place = place(FRONT);
    place.file("base.toml", &FLUME.replace("duration", "seed = 7\noverlay = [\"front.csv\"]\nduration"));
    let plan = FIT.replace("flume.toml", "base.toml").replace(", levels = 2", "");
    let budget = "repeats = 2\nevaluations = 5\nstarts = 0\nregion_evaluations = 4\n";
    place.file("seeds.toml", &format!("{budget}{plan}"));
    let done = place.bagnold(&["-q", "calibrate", "seeds.toml", "--out", "fit"]).assert().code(0);
    let told = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    let read = |name: &str| std::fs::read_to_string(place.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let evaluations = read("fit/evaluations.csv").lines().count() - 1;
    assert!(told.contains(&format!("; simulations: {}\n", 2 * evaluations)), "{evaluations} evaluations: {told}");
    let (page, profiles) = (read("fit/index.html"), read("fit/figures/profiles.csv"));
    assert!(page.contains(&format!("; simulations: {}; ", 2 * evaluations)), "{page}");
    assert!(page.contains("Their ends are those of the emulator"), "{page}");
    assert!(profiles.contains("ends: those of the emulator"), "{profiles}");
    assert!(read("fit/calibrated.toml").contains("\nseed = 1 "));
    let again = place.bagnold(&["-q", "run", "fit/calibrated.toml", "--out", "again", "--json"]).assert().code(0);
    assert!(document(&again).metrics.iter().any(|metric| metric.name == "overlay_residual"));
}

#[test]
fn wrong_headings_and_units_are_refused_before_anything_is_simulated() {
    for (from, to, said) in [("front [cm]", "toe [cm]", "toe [cm]"), ("front [cm]", "front [kg]", "[kg]")] {
        let place = place(&FRONT.replace(from, to));
        for (command, file, _) in COMMANDS {
            let refused = place.bagnold(&arguments(command, file, "out")).assert().code(2);
            let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
            assert!(text.contains(said) && text.contains("front"), "{file}: {text}");
        }
        assert!(!place.path("store").exists() && !place.path("out").exists(), "{:?}", place.names());
    }
    // a case that is no scene
    let place = place("y/h [-],v [m/s],uncertainty [m/s]\n0.5,0.1,0.01\n");
    let refused = place.bagnold(&["-q", "run", "bagnold", "--overlay", "front.csv", "--out", "out"]).assert().code(2);
    let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(text.contains("v [m/s] over y/h [-]") && text.contains("velocity-profile: u [m/s] and y/h [-]"), "{text}");
    assert!(!place.path("store").exists() && !place.path("out").exists(), "{:?}", place.names());
}

#[test]
fn decimal_commas_are_told_with_their_cell() {
    let place = place("t [s];front [cm];uncertainty [cm]\n0,05;11;1\n");
    for (command, file, _) in COMMANDS {
        let refused = place.bagnold(&arguments(command, file, "out")).assert().code(2);
        let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(text.contains("front.csv: `line 2`: \"0,05\" in column t [s]"), "{file}: {text}");
    }
}
