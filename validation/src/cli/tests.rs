//! The commands from arguments to files, with the test case.

use super::{Arguments, Exit, execute};
use crate::metric::Verdict;
use crate::pendulum::REGISTRY;
use crate::result::MetricsDocument;
use clap::Parser;
use std::path::Path;

/// Exit code (or the error's text) and standard output.
fn bagnold(arguments: &[&str]) -> (Result<Exit, String>, String) {
    let arguments = Arguments::parse_from(std::iter::once(&"bagnold").chain(arguments));
    let mut output = Vec::new();
    let exit = execute(&arguments, REGISTRY, &mut output).map_err(|error| error.to_string());
    (exit, String::from_utf8(output).expect("text"))
}

/// Runs the test case below a temporary folder, with a store of its own.
fn run(root: &Path, arguments: &[&str]) -> (Result<Exit, String>, String) {
    let (out, store) = (root.join("out"), root.join("store"));
    let fixed = ["-q", "run", "--out", text(&out), "--store", text(&store)];
    bagnold(&[&fixed, arguments].concat())
}

fn text(path: &Path) -> &str {
    path.to_str().expect("temporary folders have plain names")
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("temporary folder")
}

const SHOWN: &str = "case = \"pendulum\"
tier = \"quick\"

slope_angle = 10.0  # start [°]
steps = 20
limit = 0.05

[grain]
diameter = 0.001  # [m]
damping = 1.0

[[vary]]  # parameters that take several values, each with each
path = \"steps\"  # dotted path of the parameter
values = [20, 40]  # values of the parameter in its unit, each once
";

#[test]
fn cases_are_listed_and_shown() {
    assert_eq!(bagnold(&["list"]), (Ok(Exit::Held), "pendulum  damped pendulum for tests\n".to_owned()));
    let shown = bagnold(&["show", "pendulum"]).1;
    assert!(shown.starts_with(SHOWN) && shown.contains("# [[variants]]"), "{shown}");
}

#[test]
fn a_run_writes_all_its_files_and_prints_a_table() {
    let root = folder();
    let (exit, printed) = run(root.path(), &["pendulum"]);
    assert_eq!(exit, Ok(Exit::Held));
    assert!(
        printed.contains("2 rows that pass: shown with -v\n2 gates: 2 pass, 0 new failures. Report: "),
        "{printed}"
    );
    let out = root.path().join("out");
    assert_eq!(std::fs::read_to_string(out.join("case.toml")).expect("written"), SHOWN);
    for name in ["metrics.json", "provenance.json", "tables/angle.csv", "snapshots/steps=40.pvd"] {
        assert!(out.join(name).is_file(), "{name}");
    }
}

#[test]
fn a_shown_file_runs_to_the_same_state_from_the_store_and_on_any_number_of_threads() {
    let root = folder();
    let file = root.path().join("my.toml");
    std::fs::write(&file, SHOWN).expect("writable");
    let document = |arguments: &[&str]| {
        let (exit, printed) = run(root.path(), arguments);
        assert_eq!(exit, Ok(Exit::Held));
        serde_json::from_str::<MetricsDocument>(&printed).expect("nothing but JSON is printed")
    };
    let first = document(&["pendulum", "--json", "--threads", "1"]);
    let second = document(&[text(&file), "--json", "--threads", "2"]);
    let fresh = document(&["pendulum", "--json", "--threads", "2", "--fresh"]);
    assert_eq!(first.metrics.len(), 2);
    assert!(first.metrics.iter().all(|metric| metric.verdict == Verdict::Pass));
    let from_store = [&first, &second, &fresh].map(|document| document.provenance.runs_from_store);
    assert_eq!(from_store, [0, 2, 0]);
    assert_eq!((&first.state_hash, &first.metrics), (&second.state_hash, &second.metrics));
    assert_eq!((&first.state_hash, &first.metrics), (&fresh.state_hash, &fresh.metrics));
    assert_eq!(second.provenance.command, "bagnold run pendulum --tier quick");
}

#[test]
fn the_exit_code_tells_a_failed_gate_from_a_divergence() {
    let root = folder();
    assert_eq!(run(root.path(), &["pendulum", "--set", "limit=0.001"]).0, Ok(Exit::GateFailed));
    assert_eq!(run(root.path(), &["pendulum", "--set", "grain.damping=1e3"]).0, Ok(Exit::Diverged));
    // The test case expects to diverge above 1e6; its gate then fails all the same.
    assert_eq!(run(root.path(), &["pendulum", "--set", "grain.damping=1e7"]).0, Ok(Exit::GateFailed));
}

#[test]
fn bad_parameters_are_refused_before_anything_is_written() {
    let root = folder();
    let file = root.path().join("my.toml");
    let path = file.display();
    let refused = |contents: &str, arguments: &[&str]| {
        std::fs::write(&file, contents).expect("writable");
        let message = run(root.path(), arguments).0.expect_err("refused");
        assert!(!root.path().join("out").exists());
        message
    };
    let mine = text(&file);
    assert_eq!(
        refused("case = \"pendulum\"\n[grain]\ndiameter = -0.001", &[mine]),
        format!("{path}: `grain.diameter` is -0.001, but must be positive; give it in metres")
    );
    assert_eq!(
        refused("case = \"pendulum\"\nslope_angle = 90", &[mine]),
        format!("{path}: `slope_angle` is 90, but must be above −90° and below 90°; give it in degrees")
    );
    assert_eq!(
        refused("case = \"pendulum\"\nslope_angel = 9", &[mine]),
        format!(
            "{path}: `slope_angel`: unknown field; did you mean `slope_angle`? `bagnold show pendulum` prints all fields"
        )
    );
    assert_eq!(
        refused("case = \"pendulm\"", &[mine]),
        format!("{path}: `pendulm`: unknown case; did you mean `pendulum`? `bagnold list` prints all cases")
    );
    // The file is not to blame for what --set gives.
    assert_eq!(
        refused(SHOWN, &[mine, "--set", "slope_angle=-90"]),
        "`slope_angle` is -90, but must be above −90° and below 90°; give it in degrees"
    );
    assert_eq!(
        refused(SHOWN, &["pendulum", "--set", "grain.diameter=small"]),
        "`--set grain.diameter=small`: `grain.diameter` is small, but must be a number; `bagnold show pendulum` prints a valid value"
    );
    assert_eq!(
        refused(SHOWN, &["pendlum"]),
        "`pendlum`: unknown case; did you mean `pendulum`? `bagnold list` prints all cases"
    );
    assert_eq!(
        refused(SHOWN, &["no-such.toml"]),
        "no-such.toml: cannot be read (no such file or directory); check the path and its permissions"
    );
}

#[test]
fn a_scene_that_turns_out_impossible_leaves_the_old_results() {
    let root = folder();
    assert_eq!(run(root.path(), &["pendulum"]).0, Ok(Exit::Held));
    let message = run(root.path(), &["pendulum", "--vary", "steps=20,0"]).0.expect_err("refused");
    assert!(message.starts_with("`steps` is 0, but must be positive; take more steps"), "{message}");
    assert_eq!(std::fs::read_to_string(root.path().join("out/case.toml")).expect("still there"), SHOWN);
}

#[test]
fn a_report_holds_every_case_and_keeps_what_is_not_its_own() {
    let root = folder();
    let (out, store) = (root.path().join("out"), root.path().join("store"));
    let arguments = ["-q", "report", "--out", text(&out), "--store", text(&store)];
    assert_eq!(bagnold(&arguments).0, Ok(Exit::Held));
    std::fs::write(out.join("README.md"), "mine").expect("writable");
    assert_eq!(bagnold(&arguments).0, Ok(Exit::Held));
    assert!(out.join("cases/pendulum/metrics.json").is_file());
    assert!(out.join("README.md").is_file());
    let unknown = bagnold(&[&arguments[..], &["--cases", "pendulum,film"]].concat()).0.expect_err("refused");
    assert_eq!(unknown, "`film`: unknown case; `bagnold list` prints all cases");
}
