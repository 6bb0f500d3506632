//! Provenance of a report, in the words of a page.

use super::ReportProvenance;
use crate::store::provenance::short_commit;

pub(super) fn provenance(provenance: &ReportProvenance) -> Vec<(&'static str, String)> {
    let commit = &provenance.commit;
    let commit = if commit.is_empty() { "unknown".to_owned() } else { short_commit(commit) };
    vec![
        ("version", provenance.version.clone()),
        ("commit", commit),
        ("threads", provenance.threads.to_string()),
        ("wall time", format!("{}\u{202f}s", seconds(provenance.wall_seconds))),
    ]
}

/// Wall times are known to a tenth of a second at best.
pub(super) fn seconds(seconds: f64) -> String {
    if seconds.is_finite() { format!("{seconds:.1}") } else { "unknown".to_owned() }
}
