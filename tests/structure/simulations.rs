//! What judges and draws is no part of a stored run: `validation/build/rooms.rs` leaves it out of the run's key.

#[path = "../../validation/build/code.rs"]
mod built;

use crate::structure::source::{Source, sources};
use built::{code, is_of_tests};

/// Parts of a case that see runs which have ended.
const JUDGING: [&str; 2] = ["metrics", "figures"];

fn is_judging(source: &Source) -> bool {
    source.module.iter().any(|part| JUDGING.contains(&part.as_str()))
}

/// Files that simulate and use what judges, and files that judge and hold what is stored.
fn wrong(sources: &[Source]) -> Vec<&str> {
    let names = |source: &Source| JUDGING.iter().any(|part| source.code.contains(&format!("{part}::")));
    let simulates = |source: &Source| ["fn simulate", "Simulation::new"].iter().any(|mark| source.code.contains(mark));
    let is_wrong = |source: &&Source| {
        if is_judging(source) { source.code.contains("Serialize") } else { names(source) && simulates(source) }
    };
    sources.iter().filter(is_wrong).map(|source| source.path.as_str()).collect()
}

#[test]
fn simulations_use_nothing_that_judges() {
    for package in ["validation/cases/src", "validation/scenes/src"] {
        let sources = sources(package);
        assert!(sources.iter().any(is_judging), "{package}");
        assert_eq!(wrong(&sources), Vec::<&str>::new(), "move what both need to a file of its own");
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
