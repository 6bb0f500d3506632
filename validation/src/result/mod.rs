//! A finished case as files: `metrics.json`, tables, figures and particle snapshots.

mod base64;
mod document;
mod snapshots;

pub use document::{MetricEntry, MetricsDocument, Provenance};

use crate::case::CaseResult;
use crate::figure::{self, FigureError};
pub(crate) use document::pretty;
use std::io;
use std::path::Path;

/// Writes everything about a case into a folder: parameters, metrics, provenance, tables, figures and snapshots.
///
/// # Errors
/// Files that cannot be written.
pub fn write_case(folder: &Path, result: &CaseResult, document: &MetricsDocument) -> io::Result<()> {
    std::fs::write(folder.join("case.toml"), &result.parameters_toml)?;
    std::fs::write(folder.join("metrics.json"), document.text())?;
    std::fs::write(folder.join("provenance.json"), pretty(&document.provenance))?;
    let tables = folder.join("tables");
    std::fs::create_dir_all(&tables)?;
    for table in &result.tables {
        table.write(&tables)?;
    }
    for (run, frames) in result.runs.iter().zip(&result.frames).filter(|(_, frames)| !frames.is_empty()) {
        snapshots::write(&folder.join("snapshots"), &snapshots::file_name(&run.variant), frames)?;
    }
    write_figures(&folder.join("figures"), result)
}

/// Writes a case's figures and animations. One that cannot be drawn is no reason to lose the numbers: it is logged.
///
/// # Errors
/// Files that cannot be written.
pub fn write_figures(folder: &Path, result: &CaseResult) -> io::Result<()> {
    let figures = result.figures.iter().map(|drawn| (&drawn.name, figure::write(drawn, folder).err()));
    let animations =
        result.animations.iter().map(|moving| (&moving.name, figure::write_animation(moving, folder).err()));
    for (name, error) in figures.chain(animations) {
        match error {
            None => {}
            Some(FigureError::Write { source, .. }) => return Err(source),
            Some(error) => tracing::error!("{}, figure {name}: failed to {error}", result.name),
        }
    }
    Ok(())
}
