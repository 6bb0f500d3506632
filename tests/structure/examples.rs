//! The examples of the validation package do what they say.

#[path = "../../validation/examples/own_case.rs"]
#[expect(dead_code, reason = "its main reads the arguments of a program of its own")]
mod own_case;

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
