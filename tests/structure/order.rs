//! Dependencies run one way: what a folder may import, by its floor.

use crate::structure::imports::imports;
use crate::structure::source::{Source, blanked, sources, workspace};
use crate::structure::words::files;
use bagnold_validation::REGISTRY;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Rooms from the ground up; those of one floor do not know each other, so that no circle arises.
type Floors = &'static [&'static [&'static str]];

/// `solver/src`.
const SOLVER: Floors = &[
    &["vector", "parallel", "parameter"],
    &["lanes", "domain"],
    &["kernel", "cell_order"],
    &["material", "linear"],
    &["run"],
    &["weakly_compressible", "incompressible"],
    &["internals"],
];

/// `validation/inference/src`.
const INFERENCE: Floors = &[&["statistics", "sampling"], &["inference"]];

/// `validation/harness/src`.
const HARNESS: Floors = &[
    &["input", "interruption"],
    &["output", "page"],
    &["metric"],
    &["observation", "evidence"],
    &["checkpoint"],
    &["store"],
    &["control"],
    &["case"],
    &["setup"],
    &["measured"],
    &["evaluation", "result"],
];

/// Packages of `validation/`, each with the packages of this project that it may depend on.
const PACKAGES: [(&str, &[&str]); 10] = [
    ("number", &[]),
    ("figure", &["number"]),
    ("inference", &["number"]),
    ("harness", &["number", "figure", "inference", "solver"]),
    ("report", &["number", "figure", "inference", "harness"]),
    ("reference", &["inference", "solver", "harness"]),
    ("cases", &["number", "figure", "inference", "solver", "harness", "reference"]),
    ("scenes", &["number", "figure", "inference", "solver", "harness", "reference"]),
    ("tools", &["number", "figure", "inference", "solver", "harness", "report"]),
    ("dev", &["number", "inference", "harness", "report", "validation"]),
];

/// Rooms of the models by which a term could see more than its arguments.
const BEYOND_A_TERM: &[&str] =
    &["material", "particles", "phase", "neighbours", "scene", "state", "passes", "simulation"];

/// A file that imports what it must not.
fn offence(source: &Source, line: usize, rule: &str) -> String {
    format!("{}:{line} {rule}", source.path)
}

/// Everything in a crate that goes up a floor or over to another room of it.
fn offences(crate_src: &str, floors: Floors) -> Vec<String> {
    let height = |room: &str| floors.iter().position(|rooms| rooms.contains(&room));
    let mut found = Vec::new();
    for source in sources(crate_src) {
        // the crate's root and the program see everything
        let Some(room) = source.module.first() else { continue };
        let Some(own) = height(room) else {
            found.push(offence(&source, 1, &format!("belongs to `{room}`, which stands on no floor")));
            continue;
        };
        for import in imports(&source) {
            let Some(other) = import.path.first().filter(|other| *other != room) else { continue };
            // what is no room is an item of the crate's root
            if height(other).is_some_and(|theirs| theirs >= own) {
                let rule = format!("imports `{}`: `{other}` does not stand below `{room}`", import.path.join("::"));
                found.push(offence(&source, import.line, &rule));
            }
        }
    }
    found
}

fn assert_none(offences: &[String]) {
    assert!(offences.is_empty(), "against the order of ARCHITECTURE.md:\n{}", offences.join("\n"));
}

#[test]
fn the_solver_depends_downwards_only() {
    assert_none(&offences("solver/src", SOLVER));
}

#[test]
fn the_harness_depends_downwards_only() {
    assert_none(&offences("validation/harness/src", HARNESS));
}

#[test]
fn the_inference_depends_downwards_only() {
    assert_none(&offences("validation/inference/src", INFERENCE));
}

/// They are reachable for the package's tests, and no part of its interface.
fn check_internals(library: &str, tests: &str) {
    let name = |path: &PathBuf| {
        let code = blanked(&std::fs::read_to_string(path).expect("readable"));
        [library, "internals"].iter().all(|word| code.contains(word))
    };
    let all = ["solver", "validation", "tests", "python"].into_iter().flat_map(|folder| files(folder, "rs"));
    let (own, others): (Vec<PathBuf>, Vec<PathBuf>) =
        all.filter(name).partition(|path| path.starts_with(workspace().join(tests)));
    assert!(!own.is_empty() && others.is_empty(), "{others:?} name internals of `{library}`");
}

#[test]
fn internals_of_a_package_are_named_by_its_tests_alone() {
    check_internals("bagnold_inference", "validation/inference/tests");
    check_internals("bagnold_solver", "solver/tests");
}

#[test]
fn packages_know_only_what_they_need() {
    for (package, known) in PACKAGES {
        let path = workspace().join("validation").join(package).join("Cargo.toml");
        let manifest: toml::Table = toml::from_str(&std::fs::read_to_string(&path).expect("a manifest")).expect("TOML");
        let needs =
            manifest.get("dependencies").and_then(toml::Value::as_table).into_iter().flat_map(toml::Table::keys);
        let own: Vec<&str> = needs.filter_map(|name| name.strip_prefix("bagnold-")).collect();
        assert!(own.iter().all(|name| known.contains(name)), "{package} depends on {own:?}");
    }
}

#[test]
fn references_know_laws_of_the_solver_only() {
    let mut found = Vec::new();
    for source in sources("validation/reference/src") {
        for (line, text) in source.code.lines().enumerate() {
            let foreign = text.contains("bagnold_solver::")
                && !text.contains("bagnold_solver::material::")
                && !text.contains("bagnold_solver::parameter::");
            if foreign {
                found.push(offence(&source, line + 1, "uses more of the solver than laws and the rules of parameters"));
            }
        }
    }
    assert_none(&found);
}

#[test]
fn a_term_knows_neither_laws_nor_particles_nor_lists() {
    let mut found = Vec::new();
    for source in sources("solver/src") {
        let [_, room, ..] = source.module.as_slice() else { continue };
        if room != "terms" {
            continue;
        }
        for import in imports(&source) {
            let seen = import.path.iter().find(|part| BEYOND_A_TERM.contains(&part.as_str()));
            if let Some(seen) = seen {
                let rule = format!("imports `{}`: a term does not know `{seen}`", import.path.join("::"));
                found.push(offence(&source, import.line, &rule));
            }
        }
    }
    assert_none(&found);
}

#[test]
fn no_case_imports_another() {
    // what cases share stands in the folder of their family, or in `shared`
    let folders: BTreeSet<Vec<String>> =
        sources("validation/cases/src").iter().filter_map(|source| case_folder(&source.module)).collect();
    assert_eq!(folders.len() + IN_THE_FOLDER_OF_ANOTHER + SCENES, REGISTRY.cases().count(), "{folders:?}");
    let mut found = Vec::new();
    for source in sources("validation/cases/src") {
        let own = case_folder(&source.module);
        for import in imports(&source) {
            if let Some(other) = case_folder(&import.path).filter(|other| Some(other) != own.as_ref()) {
                let rule = format!("imports `{}`: `{}` is another case", import.path.join("::"), other.join("::"));
                found.push(offence(&source, import.line, &rule));
            }
        }
    }
    assert_none(&found);
}

/// Cases in the folder of another case: the round columns in `collapse/columns`.
const IN_THE_FOLDER_OF_ANOTHER: usize = 1;

/// Cases of the registry that are scenes.
const SCENES: usize = 2;

/// The folder of the case in which a module stands, or none: a file `metrics` or `parameters` makes no case of a family's folder.
fn case_folder(module: &[String]) -> Option<Vec<String>> {
    const FAMILIES: [(&str, &[&str]); 3] = [
        ("layer", &["hydrostatic", "film", "bagnold", "flow_thickness"]),
        ("collapse", &["columns", "incline"]),
        ("channel", &["still_water", "water_film", "clear_water", "bed_load"]),
    ];
    const ALONE: [&str; 4] = ["nonlocal_shear", "settling", "bed_load_1d", "water_column"];
    let [first, rest @ ..] = module else { return None };
    let family = FAMILIES.iter().find(|(name, _)| name == first);
    match (family, rest) {
        (Some((_, cases)), [case, ..]) if cases.contains(&case.as_str()) => Some(module[..2].to_vec()),
        (None, _) if ALONE.contains(&first.as_str()) => Some(module[..1].to_vec()),
        _ => None,
    }
}
