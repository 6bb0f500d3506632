//! What judges and draws is no part of a stored run: `validation/build/rooms.rs` leaves it out of the run's key.

use crate::structure::source::{Source, sources};

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
