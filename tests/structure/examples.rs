//! The examples of both packages do what they say.

#[path = "../../solver/examples/column.rs"]
mod column;

#[path = "../../validation/examples/own_case.rs"]
#[expect(dead_code, reason = "its main reads the arguments of a program of its own")]
mod own_case;

#[path = "../../validation/examples/own_field_law.rs"]
#[expect(dead_code, reason = "its main reads the arguments of a program of its own")]
mod own_field_law;

#[path = "../../validation/examples/own_law.rs"]
#[expect(dead_code, reason = "its main prints what the test asserts")]
mod own_law;

use bagnold_validation::REGISTRY;
use bagnold_validation::cli::program;
use std::path::Path;
use std::process::ExitCode;

/// The lines of an example.
fn length(name: &str) -> usize {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples").join(name);
    std::fs::read_to_string(path).expect("an example").lines().count()
}

#[test]
fn user_defined_case_is_run_judged_and_reported() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (store, page) = (path("store"), path("page"));
    let arguments = ["own_case", "--quiet", "report", "--store", &store, "--out", &page];
    assert_eq!(program(own_case::CASES, arguments), ExitCode::SUCCESS, "its gate holds");
    let page = std::fs::read_to_string(folder.path().join("page/index.html")).expect("a page");
    assert!(page.contains("shear-wave") && page.contains("gates: "));
    assert!(length("own_case.rs") < 80);
}

#[test]
fn user_defined_law_is_found_by_its_key_and_run() {
    own_law::register_power_law().expect("its name is free");
    let left =
        |flow_index| own_law::amplitude_left(own_law::law(flow_index).expect("readable")).expect("no divergence");
    let (newtonian, thinning) = (left(1.0), left(0.5));
    let exact = (-0.05 * std::f64::consts::TAU.powi(2) * 0.2).exp();
    assert!((newtonian / exact - 1.0).abs() < 0.03, "{newtonian} m/s for {exact} m/s");
    assert!(thinning > 1.1 * newtonian, "at a few 1/s it is thinner: {thinning} m/s");
    assert!(length("own_law.rs") < 80);
}

/// A block that leans against a plane of symmetry, of a law with a field of its own: the gates of the scene hold (its energy ledger closes
/// with what softening loses), and it runs out farther than with the peak friction and less far than with the residual one.
#[test]
fn user_defined_law_with_memory_runs_a_scene() {
    own_field_law::register_softening().expect("its name is free");
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let front = |peak: f64, residual: f64| {
        let scene = format!(
            "case = \"scene\"\nname = \"block\"\nspacing = 0.005\nduration = 0.5\ninterval = 0.05\npictures = 1\nmeasured = []\n\
             sides = {{ left = {{ mirror = 0.0 }}, right = {{ open = 0.6 }}, bottom = \"none\", top = \"none\" }}\n\
             bulk = {{ bulk_density = 1500.0 }}\nmaterial = {{ law = \"softening\", peak_friction = {peak}, \
             residual_friction = {residual}, softening_strain = 0.1 }}\n\
             bodies = [{{ shape = \"box\", lower = [0.0, 0.0], upper = [0.1, 0.12] }}]\n\
             walls = [{{ name = \"bed\", points = [[0.0, 0.0], [0.6, 0.0]] }}]\n\
             gauges = [{{ kind = \"front\", name = \"front\", from = [0.0, 0.0], to = [0.6, 0.0], thickness = 0.01 }}]\n"
        );
        std::fs::write(path("block.toml"), scene).expect("writable");
        let (file, store, out) = (path("block.toml"), path("store"), path("out"));
        let arguments = ["own_field_law", "--quiet", "run", &file, "--store", &store, "--out", &out];
        assert_eq!(program(*REGISTRY, arguments), ExitCode::SUCCESS, "its gates hold");
        let gauges = std::fs::read_dir(folder.path().join("out/tables")).expect("written").flatten();
        let gauges = gauges.map(|entry| entry.path()).find(|path| path.display().to_string().contains("gauges-"));
        let table = std::fs::read_to_string(gauges.expect("a table")).expect("readable");
        let headings = table.lines().next().expect("headings");
        let column = headings.split(',').position(|heading| heading.contains("front: front")).expect("a front");
        let last = table.lines().last().and_then(|row| row.split(',').nth(column)).expect("a row");
        last.parse::<f64>().expect("a number")
    };
    let (strong, softening, weak) = (front(0.7, 0.7), front(0.7, 0.4), front(0.4, 0.4));
    println!("fronts at {strong:.3}, {softening:.3} and {weak:.3} m");
    assert!(strong + 0.01 < softening && softening < weak, "{strong}, {softening}, {weak} m");
    assert!(length("own_field_law.rs") < 80);
}

#[test]
fn a_column_collapses_and_comes_to_rest() {
    // it ends in an error if the run diverges
    column::main().expect("a run to its end");
}
