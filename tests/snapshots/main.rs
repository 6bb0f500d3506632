//! Drift: the quick tier's metrics of every case against `tests/snapshots/quick/CASE.snap`.
//!
//! A value may move by its own tolerance. To accept what has drifted beyond it:
//! `INSTA_UPDATE=always cargo test --test snapshots`; to write all values afresh: `INSTA_UPDATE=force`.

mod drift;

use bagnold_validation::case::{Changes, Silent, Tier, execute};
use bagnold_validation::cases::REGISTRY;
use bagnold_validation::metric::Metric;
use bagnold_validation::store::{Store, StorePolicy};
use insta::Settings;
use insta::Snapshot;
use insta::comparator::Comparator;
use insta::internals::SnapshotContents;

/// Compares by each metric's tolerance instead of by text.
#[derive(Clone)]
struct WithinTolerance {
    metrics: Vec<Metric>,
}

impl Comparator for WithinTolerance {
    fn matches(&self, reference: &Snapshot, _test: &Snapshot) -> bool {
        let SnapshotContents::Text(text) = reference.contents() else { return false };
        let drifts = drift::drifts(&text.to_string(), &self.metrics);
        if !drifts.is_empty() {
            // insta's own difference below also shows what moved within its tolerance
            eprintln!("beyond their tolerance:\n{}\n", drifts.join("\n"));
        }
        drifts.is_empty()
    }

    fn dyn_clone(&self) -> Box<dyn Comparator> {
        Box::new(self.clone())
    }
}

fn assert_unchanged(name: &str) {
    let prepared = REGISTRY
        .find(name)
        .and_then(|case| case.prepare(Tier::Quick, &Changes::default()))
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent);
    for result in results.unwrap_or_else(|error| panic!("{name}: {error}")) {
        let mut settings = Settings::clone_current();
        settings.set_snapshot_path("quick");
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.set_comparator(Box::new(WithinTolerance { metrics: result.metrics.clone() }));
        settings.bind(|| insta::assert_snapshot!(result.name.as_str(), drift::text(&result.metrics)));
    }
}

#[test]
fn the_metrics_of_every_case_are_as_in_their_snapshots() {
    // One test after the other: a case uses all cores.
    let failed: Vec<&str> = REGISTRY
        .iter()
        .map(|case| case.name())
        .filter(|name| std::panic::catch_unwind(|| assert_unchanged(name)).is_err())
        .collect();
    assert!(failed.is_empty(), "these cases have drifted, see above: {}", failed.join(", "));
}
