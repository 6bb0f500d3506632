//! Quantities judged by measured points: neither by formulas nor by solvers of this project.

use crate::physics::verdict::results;
use bagnold_harness::case::Tier;
use bagnold_harness::evidence::{ReferenceKind, shipped_table, shipped_tables};
use bagnold_harness::metric::{MetricKind, Verdict};
use std::collections::BTreeSet;

/// Cases that measured points judge.
const CASES: [&str; 5] = ["column-planar", "column-round", "water-column", "settling", "bed-load-1d"];
/// Least numbers of quantities and data sets that the quick tier judges by measured points.
const QUANTITIES: usize = 12;
const DATA_SETS: usize = 6;

/// The first author and the year, or the first words, of every measured table's source: one experiment may have several tables.
fn data_set(source: &str) -> String {
    source.split([',', '(', ':', ';']).next().unwrap_or_default().trim().to_owned()
}

/// Quantities with a gate whose reference is a measured table and whose uncertainty is known in part at least, and the data sets.
pub(crate) fn judged() -> (BTreeSet<(String, String)>, BTreeSet<String>) {
    let measured: Vec<String> = shipped_tables()
        .filter_map(|(name, _)| shipped_table(name).ok())
        .filter(|table| table.metadata.origin == ReferenceKind::Measured)
        .map(|table| table.metadata.source)
        .collect();
    let (mut quantities, mut sets) = (BTreeSet::new(), BTreeSet::new());
    for case in CASES {
        for metric in results(case, Tier::Quick).into_iter().flat_map(|result| result.metrics) {
            let is_judged = metric.kind == MetricKind::Validation && metric.verdict() != Verdict::Observed;
            let known = metric.uncertainty.standard().is_some();
            let Some(reference) = metric.reference.filter(|_| is_judged && known) else { continue };
            if let Some(source) = measured.iter().find(|source| reference.source.contains(source.as_str())) {
                quantities.insert((data_set(source), metric.name));
                sets.insert(data_set(source));
            }
        }
    }
    (quantities, sets)
}

/// Fails where fewer quantities or data sets judge than have to.
pub(crate) fn assert_enough() {
    let (quantities, sets) = judged();
    println!("{} quantities, {} data sets judged by measured points", quantities.len(), sets.len());
    for (set, quantity) in &quantities {
        println!("  {quantity}: {set}");
    }
    assert!(quantities.len() >= QUANTITIES, "{quantities:?}");
    assert!(sets.len() >= DATA_SETS, "{sets:?}");
}
