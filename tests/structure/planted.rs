//! Errors that can be planted (`solver/src/planted.rs`): each stands in the solver, and nothing but their two modules and the
//! command knows of the feature that they need.

use crate::source::{Source, sources, workspace};
use std::collections::BTreeSet;

/// The table's lines: `Name … "name" "what is wrong"`.
fn declared() -> Vec<String> {
    let path = workspace().join("solver/src/planted.rs");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let (_, table) = text.split_once("\nerrors! {").expect("the table of errors");
    let (table, _) = table.split_once("\n}").expect("the end of the table");
    let rows = table.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
    rows.filter_map(|row| row.split_whitespace().next()).map(str::to_owned).collect()
}

/// The errors that a source plants.
fn planted_in(source: &Source) -> impl Iterator<Item = String> + '_ {
    let names = source.code.split("Planted::").skip(1);
    names.map(|rest| rest.chars().take_while(|letter| letter.is_alphanumeric()).collect())
}

#[test]
fn every_error_is_planted_somewhere() {
    let declared: BTreeSet<String> = declared().into_iter().collect();
    assert!(declared.len() >= 40, "{} errors", declared.len());
    let all = sources("solver/src");
    let beside = all.iter().filter(|source| !source.path.ends_with("/planted.rs"));
    let planted: BTreeSet<String> = beside.flat_map(planted_in).collect();
    let gravity = ["GravityValue", "GravityAlongBed"].map(str::to_owned);
    let missing: Vec<&String> =
        declared.iter().filter(|name| !planted.contains(*name) && !gravity.contains(name)).collect();
    assert!(missing.is_empty(), "declared but planted nowhere: {missing:?}");
}

#[test]
fn only_their_modules_know_the_feature() {
    const KNOWN: [&str; 5] = [
        "solver/src/lib.rs",
        "solver/src/planted.rs",
        "validation/src/lib.rs",
        "validation/src/cli/mod.rs",
        "validation/src/mutation/",
    ];
    for source in sources("solver/src").into_iter().chain(sources("validation/src")) {
        let text = std::fs::read_to_string(workspace().join(&source.path)).unwrap_or_default();
        let known = KNOWN.iter().any(|known| source.path.starts_with(known));
        let asks = text.contains("feature = \"planted-errors\"");
        assert!(known || !asks, "{} asks for the feature: an error is planted by `planted` or `factor`", source.path);
    }
}
