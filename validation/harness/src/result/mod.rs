//! A finished case as files: `metrics.json`, tables and particle snapshots.

mod document;
mod snapshots;
mod states;

pub use document::{MetricEntry, MetricsDocument, Provenance};

use crate::case::CaseResult;
pub use document::{gates_digest, pretty};
pub use snapshots::write as write_snapshots;
pub use states::States;
use std::io;
use std::path::Path;

/// Writes into a case's folder what `bagnold run` adds to its page and numbers: provenance, tables and snapshots.
///
/// # Errors
/// Files that cannot be written.
pub fn write_case(folder: &Path, result: &CaseResult, document: &MetricsDocument) -> io::Result<()> {
    std::fs::write(folder.join("provenance.json"), pretty(&document.provenance))?;
    let tables = folder.join("tables");
    std::fs::create_dir_all(&tables)?;
    for table in &result.tables {
        table.write(&tables)?;
    }
    for (run, frames) in result.runs.iter().zip(&result.frames).filter(|(_, frames)| !frames.is_empty()) {
        snapshots::write(&folder.join("snapshots"), &snapshots::file_name(&run.variant), frames)?;
    }
    for (run, frame) in result.runs.iter().zip(&result.first_bad) {
        if let Some(frame) = frame {
            let name = format!("{}-first-bad", snapshots::file_name(&run.variant));
            snapshots::write(&folder.join("snapshots"), &name, std::slice::from_ref(frame))?;
        }
    }
    Ok(())
}
