//! Crates with a law or a case of one's own: written by the program, built outside of the tree, and never shown a number of an
//! earlier build.

use crate::command_line::program::{Place, document, path};
use assert_cmd::Command;
use bagnold_harness::store::{identity, source_hash};
use bagnold_validation::REGISTRY;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The root of the workspace.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The folder of the profile that these tests were built with, `target/PROFILE`.
fn built() -> PathBuf {
    path().parent().expect("the program stands in a folder").to_owned()
}

/// Cargo, without a network and with the target folder of these tests.
fn cargo(arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.env("CARGO_TARGET_DIR", built().parent().expect("in a target folder")).arg("--offline").args(arguments);
    command
}

/// The compiler with the libraries of the workspace as these tests were built with them: Cargo would build those of a crate
/// outside of the tree once more.
struct Compiler {
    libraries: BTreeMap<String, PathBuf>,
}

impl Compiler {
    fn new() -> Self {
        let profile = match built().file_name().and_then(|name| name.to_str()) {
            Some("debug") | None => "dev".to_owned(),
            Some(name) => name.to_owned(),
        };
        let arguments = ["build", "--lib", "--message-format=json", "--profile", &profile];
        // what `cargo test` builds at the root, so that nothing is left to be built
        let finished = cargo(&arguments).current_dir(ROOT).assert().success();
        let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
        let wanted = ["bagnold_harness", "bagnold_solver", "bagnold_validation", "schemars", "serde"];
        let mut libraries = BTreeMap::new();
        for message in text.lines().map(|line| serde_json::from_str::<Value>(line).expect("one message a line")) {
            let name = message["target"]["name"].as_str().unwrap_or_default();
            let files = message["filenames"].as_array().into_iter().flatten().filter_map(Value::as_str);
            if let Some(file) = files.into_iter().find(|file| file.ends_with(".rlib"))
                && wanted.contains(&name)
            {
                assert_eq!(libraries.insert(name.to_owned(), file.into()), None, "two libraries called {name}");
            }
        }
        assert_eq!(libraries.len(), wanted.len(), "{libraries:?}");
        Self { libraries }
    }

    /// Compiles a crate's `src/main.rs` to a program.
    fn compile(&self, folder: &Path, program: &Path, options: &[&str]) {
        let mut command = Command::new(std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()));
        command.args(["--edition", "2024", "--crate-name", "own", "-C", "opt-level=1"]).args(options);
        command.arg("-L").arg(format!("dependency={}", built().join("deps").display()));
        for (name, file) in &self.libraries {
            command.arg("--extern").arg(format!("{name}={}", file.display()));
        }
        let finished = command.arg("-o").arg(program).arg(folder.join("src/main.rs")).assert().success();
        let warnings = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(warnings.is_empty(), "{warnings}");
    }

    /// Compiles and runs a crate's tests, of which there are any.
    fn test(&self, place: &Place, folder: &str) {
        let program = place.path(&format!("{folder}-tests"));
        self.compile(&place.path(folder), &program, &["--test"]);
        let finished = Command::new(program).assert().success();
        let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
        assert!(text.contains("test result: ok. 1 passed"), "{text}");
    }
}

/// Velocity of the uppermost row of a film `[m/s]`, and how many runs came from the store.
fn surface_velocity(place: &Place, program: &Path) -> (f64, usize) {
    let mut command = Command::new(program);
    command.current_dir(place.path("own")).env("BAGNOLD_STORE", place.path("store"));
    let finished = command.args(["--quiet", "run", "film.toml", "--out", "film", "--json"]).assert().success();
    let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
    let document: Value = serde_json::from_str(&text).expect("metrics.json");
    let stored = document["provenance"]["runs_from_store"].as_u64().expect("a number");
    let tables = std::fs::read_dir(place.path("own/film/tables")).expect("written").flatten();
    let profile = tables.map(|entry| entry.path()).find(|path| path.display().to_string().contains("profile"));
    let profile = std::fs::read_to_string(profile.expect("a profile")).expect("readable");
    let velocity = profile.lines().last().and_then(|row| row.split(',').nth(1)).expect("a velocity");
    (velocity.parse().expect("a number"), usize::try_from(stored).expect("few"))
}

#[test]
fn an_edited_law_shows_its_own_numbers_and_never_those_of_an_earlier_build() {
    let place = Place::new();
    place.bagnold(&["new", "law", "linear-friction", "--out", "own"]).assert().code(0);
    let manifest = place.path("own/Cargo.toml").display().to_string();
    // the manifest is whole, and its lock file has all that it needs
    let tree = cargo(&["tree", "--depth", "1", "--manifest-path", &manifest]).assert().success();
    let tree = String::from_utf8_lossy(&tree.get_output().stdout).into_owned();
    assert!(tree.contains("linear-friction") && tree.contains("bagnold-validation"), "{tree}");

    let compiler = Compiler::new();
    compiler.test(&place, "own");
    let (first, second) = (place.path("first"), place.path("second"));
    compiler.compile(&place.path("own"), &first, &[]);
    let (velocity, stored) = surface_velocity(&place, &first);
    // Bagnold's profile: u(h) = 2/3 I √(ρ g cos θ/ρ_s) h^(3/2)/d with I = (tan θ − μ_s)/b; the row is half a spacing deep
    let slope = 24.0_f64.to_radians();
    let exact = 2.0 / 3.0 * (slope.tan() - 0.382) / 0.935 * (0.6 * 9.81 * slope.cos()).sqrt() * 1e-3 / 0.5e-3;
    assert!((velocity / exact - 1.0).abs() < 0.03, "{velocity} m/s for {exact} m/s");
    assert_eq!(stored, 0);
    assert_eq!(surface_velocity(&place, &first), (velocity, 1), "the same program need not simulate again");

    // twice the growth of the friction, half the velocity
    let main = place.path("own/src/main.rs");
    let text = std::fs::read_to_string(&main).expect("written");
    let edited = text.replace("self.friction_growth *", "2.0 * self.friction_growth *");
    assert_ne!(text, edited);
    std::fs::write(&main, edited).expect("writable");
    compiler.compile(&place.path("own"), &second, &[]);
    let (edited, stored) = surface_velocity(&place, &second);
    assert_eq!(stored, 0, "another law: nothing that was stored is its own");
    assert!((2.0 * edited / velocity - 1.0).abs() < 0.03, "{edited} m/s after {velocity} m/s");
    assert_eq!(surface_velocity(&place, &second), (edited, 1));
    assert_eq!(surface_velocity(&place, &first), (velocity, 1), "the first program keeps its own");

    place.bagnold(&["new", "case", "shear-wave", "--out", "wave"]).assert().code(0);
    compiler.test(&place, "wave");
}

#[test]
fn results_of_the_programs_own_cases_are_known_by_the_sources_alone() {
    // this test is another file than the program, and they share a store
    assert_eq!(identity(REGISTRY.origin()), Some(source_hash()));
}

#[test]
fn a_crate_is_written_into_a_new_folder_under_a_name_that_it_can_have() {
    let place = Place::new();
    let refusal = |arguments: &[&str]| {
        let finished = place.bagnold(arguments).assert().code(2);
        String::from_utf8_lossy(&finished.get_output().stderr).into_owned()
    };
    assert_eq!(
        refusal(&["new", "law", "My law"]),
        "error: `NAME` is \"My law\", but must be a crate's name of at most 64 lower-case letters, digits and hyphens that \
         begins with a letter; choose a name such as my-law\n"
    );
    assert!(place.names().is_empty(), "nothing was written");
    std::fs::create_dir(place.path("notes")).expect("writable");
    place.file("notes/thesis.tex", "years of work");
    let refused = refusal(&["new", "case", "my-case", "--out", "notes"]);
    assert_eq!(
        refused,
        "error: `--out` is notes, but must be a new folder; name another one with --out, or remove this one\n"
    );
    place.bagnold(&["new", "case", "my-case"]).assert().code(0);
    assert!(place.path("my-case/src/main.rs").is_file());
}

#[test]
fn a_program_tells_the_same_of_itself_in_every_folder() {
    let place = Place::new();
    let there = place.run(&[crate::command_line::program::CHEAP, &["--json"]].concat()).code(0);
    let there = document(&there).provenance;
    let out = place.path("here").display().to_string();
    let arguments = [&["run", "--out", &out, "--json"], crate::command_line::program::CHEAP].concat();
    let here = document(&place.bagnold(&arguments).current_dir(ROOT).assert().code(0)).provenance;
    assert_eq!(there.commit, here.commit, "the commit is that of the build");
    assert_eq!(there.commit, bagnold_harness::store::commit());
    assert!(there.profile.contains("solver at opt-level "), "{}", there.profile);
    assert!(["portable", "AVX2"].contains(&there.instruction_set.as_str()), "{}", there.instruction_set);
}
