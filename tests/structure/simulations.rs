//! Stored runs without what judges and draws, and without other cases, laws and models: `validation/build/rooms.rs` finds in the text
//! of the sources what each run depends on, and relies on what is checked here.

#[path = "../../validation/build/code.rs"]
mod built;
#[path = "../../validation/build/rooms.rs"]
mod rooms;

use crate::structure::imports::imports;
use crate::structure::source::{Source, is_word, sources, workspace};
use bagnold_solver::material::rheology::Rheology;
use built::{CODE, code, is_of_tests, left_open};
use rooms::{DRAWING, JUDGING_PARTS, LAWS, Rooms, type_name};
use std::collections::{BTreeMap, BTreeSet};

fn is_judging(source: &Source) -> bool {
    source.module.iter().any(|part| JUDGING_PARTS.contains(&part.as_str()))
}

/// Files that simulate and use what judges, and files that judge and hold what is stored.
fn wrong(sources: &[Source]) -> Vec<&str> {
    let names = |source: &Source| JUDGING_PARTS.iter().any(|part| source.code.contains(&format!("{part}::")));
    let simulates = |source: &Source| ["fn simulate", "Simulation::new"].iter().any(|mark| source.code.contains(mark));
    let is_wrong = |source: &&Source| {
        if is_judging(source) { source.code.contains("Serialize") } else { names(source) && simulates(source) }
    };
    sources.iter().filter(is_wrong).map(|source| source.path.as_str()).collect()
}

fn text(path: &str) -> String {
    std::fs::read_to_string(workspace().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The sources as the build sorts them.
fn all_rooms() -> Rooms {
    let mut rooms = Rooms::new(&LAWS.map(|folder| code(&text(&format!("{folder}mod.rs")))).concat());
    for source in CODE.iter().flat_map(|package| sources(package)) {
        rooms.sort_in(&source.path, &code(&text(&source.path)));
    }
    rooms
}

/// Files that each case, law, or what draws depends on.
fn dependences(rooms: &Rooms) -> BTreeMap<String, BTreeSet<String>> {
    let paths = |sources: Vec<&(String, String)>| sources.into_iter().map(|(path, _)| path.clone()).collect();
    rooms.dependences().into_iter().map(|(name, sources)| (name, paths(sources))).collect()
}

/// Whether a text has a name as a word of its own.
fn has_word(text: &str, name: &str) -> bool {
    text.split(|character: char| !character.is_ascii() || !is_word(character as u8)).any(|word| word == name)
}

#[test]
fn simulations_use_nothing_that_judges() {
    for package in ["validation/cases/src", "validation/scenes/src"] {
        let sources = sources(package);
        assert!(sources.iter().any(is_judging), "{package}");
        assert_eq!(wrong(&sources), Vec::<&str>::new(), "move what both need to a file of its own");
    }
    for package in
        ["validation/harness/src", "validation/reference/src", "validation/cases/src", "validation/scenes/src"]
    {
        let inferring = sources(package).into_iter().filter(|source| has_word(&source.code, "inference"));
        assert_eq!(
            inferring.map(|source| source.path).collect::<Vec<_>>(),
            Vec::<String>::new(),
            "it sees runs that have ended"
        );
    }
}

#[test]
fn a_simulation_by_a_metrics_constant_is_found() {
    let source = |module: &str, code: &str| Source {
        path: module.to_owned(),
        module: vec!["case".to_owned(), module.to_owned()],
        code: code.to_owned(),
    };
    let flow = source("flow", "use super::metrics::END;\nfn simulate() {}");
    let stored = source("metrics", "#[derive(Serialize)]\nstruct Kept;");
    assert_eq!(wrong(&[flow, stored]), ["flow", "metrics"]);
    assert!(wrong(&[source("flow", "fn simulate() {}"), source("mod", "metrics::all(records)")]).is_empty());
}

/// Imports of a package's files from rooms that they are not seen to use.
fn unseen(rooms: &Rooms, packages: &[(&str, Vec<Source>)]) -> Vec<String> {
    let used = rooms.used();
    let by_module: BTreeMap<Vec<&str>, &Source> = packages
        .iter()
        .flat_map(|(name, sources)| sources.iter().map(move |source| (name, source)))
        .map(|(name, source)| {
            (std::iter::once(*name).chain(source.module.iter().map(String::as_str)).collect(), source)
        })
        .collect();
    let mut found = Vec::new();
    for (package, sources) in packages {
        for source in sources {
            let Some(room) = rooms.room(&source.path) else { continue };
            for import in imports(source) {
                let path: Vec<&str> = import.path.iter().map(String::as_str).collect();
                let is_of_another = path.first().is_some_and(|first| packages.iter().any(|(name, _)| name == first));
                let path = if is_of_another { path } else { [&[*package], &path[..]].concat() };
                let file = (1..=path.len()).rev().find_map(|length| by_module.get(&path[..length]));
                let other = file.and_then(|file| rooms.room(&file.path));
                if other.is_some_and(|other| other != DRAWING && !used[room.as_str()].contains(other.as_str())) {
                    found.push(format!("{}:{}: {}", source.path, import.line, path.join("::")));
                }
            }
        }
    }
    found
}

#[test]
fn every_import_from_another_room_is_seen() {
    let packages = CODE.map(|folder| {
        let name = folder.trim_end_matches("/src").rsplit('/').next().unwrap_or_default();
        (name, sources(folder))
    });
    // a model or a law passes on what its own files name
    assert_eq!(
        unseen(&all_rooms(), &packages),
        Vec::<String>::new(),
        "name the room on the path: `crate::reference::film`"
    );
}

#[test]
fn an_import_in_a_list_of_rooms_is_found() {
    let source = |path: &str, module: &[&str], code: &str| Source {
        path: path.to_owned(),
        module: module.iter().map(|part| (*part).to_owned()).collect(),
        code: code.to_owned(),
    };
    for (code, expected) in
        [("use crate::reference::{film::Film, water};", 1), ("use crate::reference::film::Film;", 0)]
    {
        let film = source("validation/reference/src/film/mod.rs", &["film"], "pub struct Film;");
        let case = source("validation/cases/src/layer/mod.rs", &["layer"], code);
        let mut rooms = Rooms::new("");
        [&film, &case].iter().for_each(|source| rooms.sort_in(&source.path, &source.code));
        let packages = [("reference", vec![film]), ("cases", vec![case])];
        assert_eq!(unseen(&rooms, &packages).len(), expected, "{code}");
    }
}

#[test]
fn a_run_depends_on_the_laws_that_its_case_names() {
    let of = dependences(&all_rooms());
    let law = |name: &str| format!("solver/src/material/rheology/{name}.rs");
    let depends = |case: &str, path: String| of[case].contains(&path);
    for (case, name) in
        [("film", "herschel_bulkley"), ("bed-load", "coulomb_bingham"), ("bed-load", "root_mu_i"), ("bagnold", "mu_i")]
    {
        assert!(depends(case, law(name)), "{case} without {name}");
    }
    for (case, name) in
        [("column-planar", "herschel_bulkley"), ("bagnold", "viscous_number"), ("scene", "softening_drucker_prager")]
    {
        assert!(!depends(case, law(name)), "{case} with {name}");
    }
    // what the file of a law names goes with it
    for name in ["mu_i", "softening_drucker_prager", "softening_drucker_prager/dilating_return"] {
        assert!(depends("\"softening-drucker-prager\"", law(name)), "{name}");
    }
    assert!(depends("\"wen-yu\"", "solver/src/material/drag/schiller_naumann.rs".to_owned()));
    for (case, other) in [
        ("film", "validation/cases/src/layer/bagnold/flow.rs"),
        ("bagnold", "validation/cases/src/settling/scene.rs"),
        ("bed-load-1d", "validation/cases/src/settling/scene.rs"),
        ("column-planar", "validation/reference/src/film/eddy_film.rs"),
        ("still-water", "validation/reference/src/one_dimension/layer_transient.rs"),
    ] {
        assert!(!depends(case, other.to_owned()), "{case} with {other}");
    }
    for common in ["validation/cases/src/layer/periodic.rs", "validation/inference/src/statistics/fit.rs"] {
        assert!(depends("film", common.to_owned()), "{common}");
    }
}

#[test]
fn a_law_counts_wherever_its_type_or_its_module_is_named() {
    let of = |common: &str, of_law: &str| {
        let mut rooms = Rooms::new("a = \"one-law\", b = \"other\"");
        for (path, code) in [
            (
                "solver/src/material/rheology/mod.rs",
                "mod one_law; mod other; pub use one_law::OneLaw; pub use other::Other;",
            ),
            ("solver/src/material/rheology/one_law.rs", of_law),
            ("solver/src/material/rheology/other.rs", "struct Other;"),
            ("solver/src/domain.rs", common),
            ("validation/cases/src/film/mod.rs", "const NAME: &'static str = \"film\";"),
        ] {
            rooms.sort_in(path, code);
        }
        dependences(&rooms)["film"].iter().filter(|path| path.contains("one_law") || path.contains("other")).count()
    };
    assert_eq!(of("", "struct OneLaw;"), 0);
    assert_eq!(of("use crate::material::rheology::{OneLaw as Mine};", "struct OneLaw;"), 1);
    assert_eq!(of("fn a() { one_law::REST }", "struct OneLaw(Other);"), 2);
    assert_eq!(of("fn one_law() {} fn another() { one_law() }", ""), 0);
}

/// Files of laws by their stems, with the sources of the folder.
fn laws(folder: &str) -> (Vec<String>, Vec<Source>) {
    let rooms = all_rooms();
    let mut all = sources("solver/src");
    all.retain(|source| source.path.starts_with(folder));
    let stems = all.iter().filter_map(|source| rooms.room(&source.path)?.strip_prefix("law ").map(str::to_owned));
    (stems.collect::<BTreeSet<_>>().into_iter().collect(), all)
}

#[test]
fn the_list_of_laws_passes_each_value_to_its_own_file() {
    let of = dependences(&all_rooms());
    for (folder, count) in LAWS.into_iter().zip([10, 6]) {
        let (stems, sources) = laws(folder);
        assert_eq!(stems.len(), count, "{folder}: a law's file has the name that `mod.rs` quotes");
        let list = sources.iter().find(|source| source.path.ends_with("/mod.rs")).expect("a list of laws");
        for (stem, (at, _)) in stems.iter().flat_map(|stem| {
            list.code.match_indices(&format!("{stem}::")).map(move |hit| (stem, hit)).collect::<Vec<_>>()
        }) {
            if is_word(list.code.as_bytes()[at - 1]) {
                continue;
            }
            let line = list.code[at..].lines().next().unwrap_or_default();
            if list.code[..at].ends_with("\npub use ") {
                assert_eq!(
                    line,
                    format!("{stem}::{};", type_name(stem)),
                    "what else a law's file has is taken from there"
                );
                continue;
            }
            let pattern = list.code[..at].rsplit_once("=>").map_or("", |(before, _)| before);
            let pattern = pattern.rsplit(['{', '}', ',']).next().unwrap_or_default();
            let values: Vec<&String> = stems.iter().filter(|other| has_word(pattern, &type_name(other))).collect();
            assert!(!values.is_empty(), "{}: {line} is for no law", list.path);
            for other in values {
                let seen = &of[&format!("{:?}", other.replace('_', "-"))];
                assert!(seen.contains(&format!("{folder}{stem}.rs")), "{}: {other} uses {line}", list.path);
            }
        }
    }
}

#[test]
fn the_list_of_rheologies_makes_no_law() {
    let (stems, sources) = laws(LAWS[0]);
    let list = sources.iter().find(|source| source.path.ends_with("/mod.rs")).expect("a list of laws");
    for line in list.code.lines() {
        let names = stems.iter().any(|stem| has_word(line, &type_name(stem)));
        // texts are blank here
        let is_of_list = line.contains(" = ") && !line.contains(['{', '(']);
        let only_tells_apart = is_of_list || ["=>", "pub use "].iter().any(|mark| line.contains(mark));
        assert!(!names || only_tells_apart, "{line}");
    }
}

#[test]
fn the_file_of_a_law_adds_to_no_type_of_others() {
    for folder in LAWS {
        let (stems, sources) = laws(folder);
        for source in &sources {
            let Some(stem) = stems.iter().find(|stem| source.path[folder.len()..].starts_with(&format!("{stem}.")))
            else {
                continue;
            };
            for head in source.code.lines().filter(|line| line.starts_with("impl")) {
                let target = head.rsplit_once(" for ").map_or(head, |(_, target)| target);
                let is_own = |word: &str| {
                    word == type_name(stem)
                        || ["struct", "enum"].iter().any(|kind| source.code.contains(&format!("{kind} {word}")))
                };
                let own = target.split(|character: char| !character.is_alphanumeric()).filter(|word| word.len() > 1);
                assert!(own.into_iter().any(is_own), "{}: {head}", source.path);
            }
        }
    }
}

#[test]
fn a_description_quotes_its_law() {
    for (name, given) in [
        ("\"newtonian\"", r#"{"law":"newtonian","viscosity":1.0}"#),
        (
            "\"mu-i\"",
            r#"{"law":"mu-i","static_friction":0.4,"limiting_friction":0.6,"reference_inertia":0.3,"grain_diameter":1e-3,"grain_density":2500.0}"#,
        ),
    ] {
        let law: Rheology = serde_json::from_str(given).expect("a law");
        assert!(serde_json::to_string(&law).expect("it serialises").contains(name));
    }
}

#[test]
fn comments_and_unit_tests_change_no_hash_and_all_else_does() {
    let of = |tests: &str, after: &str| {
        code(&format!("/// text\nfn a() {{}}\n\n#[cfg(test)]\nmod tests {{\n{tests}\n}}\n{after}"))
    };
    assert_eq!(of("    fn b() {}", ""), of("    // other\n    fn c() {}", "// more\n"));
    assert_ne!(of("    fn b() {}", ""), of("    fn b() {}", "fn behind_the_tests() {}\n"));
    assert_ne!(code("fn a() {}"), code("fn b() {}"));
    assert!(
        is_of_tests("solver/src/linear/tests.rs")
            && is_of_tests("solver/src/a/tests/b.rs")
            && is_of_tests("a/b_tests.rs")
    );
    assert!(!is_of_tests("solver/src/latest.rs"));
}

#[test]
fn two_slashes_within_a_literal_begin_no_comment() {
    for (before, after) in [("\"", "\""), ("r\"", "\""), ("r#\"a \" ", "\"#"), ("b\"\\\" ", "\""), ("('\"', \"", "\")")]
    {
        let of = |line: &str| code(&format!("const TEXT: &str = {before}\n// {line}\n{after};\nfn a() {{}}\n// end"));
        assert_ne!(of("one"), of("two"), "{before}");
        assert!(!of("one").contains("end"), "{before}");
    }
    for closed in ["\"\"", "\"\\\\\"", "'\"'", "'\\\"'", "'\\\\'", "r#\"\"\"#", "1 // \"", "letter"] {
        assert_eq!(left_open(closed, None), None, "{closed}");
    }
}

#[test]
fn every_literal_of_the_sources_is_read_to_its_end() {
    for source in CODE.iter().flat_map(|package| sources(package)) {
        let end = text(&source.path).lines().fold(None, |open, line| left_open(line, open));
        assert_eq!(end, None, "{}", source.path);
    }
}
