//! The examples of both packages do what they say.

#[path = "../../solver/examples/column.rs"]
mod column;

#[path = "../../validation/examples/own_case.rs"]
#[expect(dead_code, reason = "its main reads the arguments of a program of its own")]
mod own_case;

#[path = "../../validation/examples/own_law.rs"]
#[expect(dead_code, reason = "its main prints what the test asserts")]
mod own_law;

use bagnold_validation::cli::program;
use std::path::Path;
use std::process::ExitCode;

/// The lines of an example.
fn length(name: &str) -> usize {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples").join(name);
    std::fs::read_to_string(path).expect("an example").lines().count()
}

#[test]
fn a_case_of_ones_own_is_run_judged_and_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (store, page) = (path("store"), path("page"));
    let arguments = ["own_case", "--quiet", "report", "--store", &store, "--out", &page];
    assert_eq!(program(own_case::CASES, arguments), ExitCode::SUCCESS, "its gate holds");
    let page = std::fs::read_to_string(folder.path().join("page/index.html")).expect("a page");
    assert!(page.contains("shear-wave") && page.contains("amplitude_error"));
    assert!(length("own_case.rs") < 80);
}

#[test]
fn a_law_of_ones_own_is_found_by_its_key_and_run() {
    own_law::register_power_law().expect("its name is free");
    let left =
        |flow_index| own_law::amplitude_left(own_law::law(flow_index).expect("readable")).expect("no divergence");
    let (newtonian, thinning) = (left(1.0), left(0.5));
    let exact = (-0.05 * std::f64::consts::TAU.powi(2) * 0.2).exp();
    assert!((newtonian / exact - 1.0).abs() < 0.03, "{newtonian} m/s for {exact} m/s");
    assert!(thinning > 1.1 * newtonian, "at a few 1/s it is thinner: {thinning} m/s");
    assert!(length("own_law.rs") < 80);
}

#[test]
fn a_column_collapses_and_comes_to_rest() {
    // it ends in an error if the run diverges
    column::main().expect("a run to its end");
}
