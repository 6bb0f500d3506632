//! Drift: the quick tier's metrics of every case against the accepted values, `tests/snapshots/quick/CASE.snap`.
//!
//! A value may move by its own tolerance. To accept what has moved farther, read the report first, then
//! `cargo run -- report --accept --cases CASE`.

use bagnold_validation::case::{Changes, Silent, Tier, execute};
use bagnold_validation::cases::REGISTRY;
use bagnold_validation::metric::undeclared;
use bagnold_validation::report::Baseline;
use bagnold_validation::store::{Store, StorePolicy};
use std::path::Path;

/// Every metric of a case that is not as accepted.
fn differences(name: &str) -> Result<Vec<String>, Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots");
    let accepted = Baseline::read(&folder, name, Tier::Quick)?;
    let case = REGISTRY.find(name)?;
    let prepared = case.prepare(Tier::Quick, &Changes::default())?;
    let results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent)?;
    let mut found = Vec::new();
    for result in &results {
        found.extend(accepted.differences(name, &result.metrics));
        let strangers = undeclared(case.quantities(), &result.metrics);
        found.extend(strangers.map(|metric| format!("{} [{}] is not declared by the case", metric.name, metric.unit)));
    }
    Ok(found)
}

#[test]
fn the_metrics_of_every_case_are_as_accepted() {
    // One case after the other: each uses all cores.
    let mut complaints = Vec::new();
    for name in REGISTRY.iter().map(|case| case.name()) {
        let found = differences(name).unwrap_or_else(|error| vec![format!("failed to {error}")]);
        complaints.extend(found.into_iter().map(|difference| format!("{name}: {difference}")));
    }
    assert!(complaints.is_empty(), "not as accepted:\n{}", complaints.join("\n"));
}

#[test]
fn every_accepted_case_is_registered() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots").join("quick");
    for entry in std::fs::read_dir(&folder).expect("accepted values") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().and_then(|name| name.to_str()).expect("a name").to_owned();
        assert!(REGISTRY.find(&name).is_ok(), "{} belongs to no case", path.display());
    }
}
