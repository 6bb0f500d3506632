//! Dependencies run one way: what a folder may import, by its floor.

use crate::imports::imports;
use crate::source::{Source, sources};
use bagnold_validation::REGISTRY;
use std::collections::{BTreeMap, BTreeSet};

/// Rooms of one floor, which may use each other as long as no circle arises; and whether they must not, as peers.
struct Floor {
    rooms: &'static [&'static str],
    peers: bool,
}

const fn floor(rooms: &'static [&'static str]) -> Floor {
    Floor { rooms, peers: false }
}

const fn peers(rooms: &'static [&'static str]) -> Floor {
    Floor { rooms, peers: true }
}

/// `solver/src`, from the ground up.
const SOLVER: &[Floor] = &[
    floor(&["vector", "lanes", "kernel", "domain", "parameter", "parallel", "cell_order"]),
    floor(&["material", "linear"]),
    floor(&["run"]),
    peers(&["weakly_compressible", "incompressible"]),
];

/// `validation/inference/src`, from the ground up.
const INFERENCE: &[Floor] = &[floor(&["statistics", "sampling"]), floor(&["inference"])];

/// `validation/harness/src`, from the ground up.
const HARNESS: &[Floor] = &[
    floor(&["input", "interruption"]),
    floor(&["output", "page"]),
    floor(&["metric"]),
    floor(&["observation", "evidence"]),
    floor(&["store", "checkpoint"]),
    floor(&["control"]),
    floor(&["case"]),
    floor(&["setup"]),
    floor(&["evaluation", "result"]),
    floor(&["measured"]),
];

/// Packages of `validation/`, each with the packages of this project that it may depend on.
const PACKAGES: [(&str, &[&str]); 9] = [
    ("number", &[]),
    ("figure", &["number"]),
    ("inference", &["number"]),
    ("harness", &["number", "figure", "inference", "solver"]),
    ("report", &["number", "figure", "inference", "harness"]),
    ("reference", &["inference", "solver", "harness"]),
    ("cases", &["number", "figure", "inference", "solver", "harness", "reference"]),
    ("scenes", &["number", "figure", "inference", "solver", "harness", "reference"]),
    ("tools", &["number", "figure", "inference", "solver", "harness", "report"]),
];

/// Rooms of the models by which a term could see more than its arguments.
const BEYOND_A_TERM: &[&str] =
    &["material", "particles", "phase", "neighbours", "scene", "state", "passes", "simulation"];

/// A file that imports what it must not.
fn offence(source: &Source, line: usize, rule: &str) -> String {
    format!("{}:{line} {rule}", source.path)
}

/// Everything in a crate that goes up a floor or over to a peer, and the circles that are left.
fn offences(crate_src: &str, floors: &[Floor]) -> Vec<String> {
    let height = |room: &str| floors.iter().position(|floor| floor.rooms.contains(&room));
    let mut found = Vec::new();
    let mut uses: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
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
            let Some(theirs) = height(other) else { continue };
            let place = offence(&source, import.line, &format!("imports `{}`", import.path.join("::")));
            if theirs > own {
                found.push(format!("{place}: `{other}` stands above `{room}`"));
            } else if theirs == own && floors[own].peers {
                found.push(format!("{place}: `{room}` and `{other}` are peers that do not know each other"));
            }
            uses.entry(room.clone()).or_default().entry(other.clone()).or_insert(place);
        }
    }
    found.extend(circles(&uses));
    found
}

/// Pairs of rooms that reach each other, with the line by which the first does.
fn circles(uses: &BTreeMap<String, BTreeMap<String, String>>) -> Vec<String> {
    let reached = |from: &str| {
        let mut seen = BTreeSet::new();
        let mut open = vec![from.to_owned()];
        while let Some(room) = open.pop() {
            for next in uses.get(&room).into_iter().flat_map(BTreeMap::keys) {
                if seen.insert(next.clone()) {
                    open.push(next.clone());
                }
            }
        }
        seen
    };
    let mut found = Vec::new();
    for (room, others) in uses {
        for (other, place) in others.iter().filter(|(other, _)| reached(other).contains(room)) {
            found.push(format!("{place}: a circle, for `{other}` leads back to `{room}`"));
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

#[test]
fn packages_know_only_what_they_need() {
    for (package, known) in PACKAGES {
        let path = crate::source::workspace().join("validation").join(package).join("Cargo.toml");
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
    assert_eq!(folders.len() + SCENES, REGISTRY.cases().count(), "{folders:?}");
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

/// Cases of the registry that are scenes.
const SCENES: usize = 2;

/// The folder of the case in which a module stands, or none: a file `metrics` or `parameters` makes no case of a family's folder.
fn case_folder(module: &[String]) -> Option<Vec<String>> {
    const FAMILIES: [(&str, &[&str]); 3] = [
        ("layer", &["hydrostatic", "film", "bagnold", "flow_thickness"]),
        ("collapse", &["planar", "round", "incline"]),
        ("channel", &["still_water", "water_film", "clear_water", "bed_load"]),
    ];
    const ALONE: [&str; 5] = ["nonlocal_shear", "settling", "submerged_layer", "bed_load_1d", "water_column"];
    let [first, rest @ ..] = module else { return None };
    let family = FAMILIES.iter().find(|(name, _)| name == first);
    match (family, rest) {
        (Some((_, cases)), [case, ..]) if cases.contains(&case.as_str()) => Some(module[..2].to_vec()),
        (None, _) if ALONE.contains(&first.as_str()) => Some(module[..1].to_vec()),
        _ => None,
    }
}

#[test]
fn a_circle_is_found_with_its_line() {
    let edge = |to: &str| BTreeMap::from([(to.to_owned(), format!("a file that imports {to}"))]);
    let mut uses = BTreeMap::from([("a".to_owned(), edge("b")), ("b".to_owned(), edge("c"))]);
    assert!(circles(&uses).is_empty());
    uses.insert("c".to_owned(), edge("a"));
    let found = circles(&uses);
    assert_eq!(found.len(), 3);
    assert_eq!(found[0], "a file that imports b: a circle, for `b` leads back to `a`");
}
