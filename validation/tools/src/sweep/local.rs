//! The embedded engine: runs of the manifest on this machine's threads.

use super::folder::SweepFolder;
use super::manifest::{Manifest, SweepRun};
use crate::ToolError;
use crate::case::{CaseFile, Changes, Limits, Registry, Silent, share_out};
use crate::evaluation::{self, EvaluationRecord};
use crate::measured::with_overlay;
use crate::output::{FileError, Owner, write_whole};
use crate::result::pretty;
use crate::store::Store;

/// Watches a sweep, for a progress bar. Called from several threads.
pub trait SweepMonitor: Sync {
    /// Notes that a run begins.
    fn begun(&self, entry: &SweepRun);
    /// A run has its record.
    fn ended(&self, entry: &SweepRun, record: &EvaluationRecord);
}

/// Runs one entry on the current rayon pool's threads and writes its folder, the record last.
///
/// # Errors
/// Files that cannot be written. A run that fails is no error: its record says why.
pub fn run_entry(
    sweep: &SweepFolder,
    entry: &SweepRun,
    registry: Registry,
    store: &Store,
) -> Result<EvaluationRecord, ToolError> {
    if let Some(record) = sweep.record(entry) {
        return Ok(record);
    }
    let folder = sweep.of(entry);
    let unwritable = |error: std::io::Error| FileError::unwritable(&folder, &error);
    std::fs::create_dir_all(&folder).map_err(unwritable)?;
    let listed = folder.join("case.toml");
    let overlay = sweep.manifest().overlay.get(&entry.label).map_or(&[][..], Vec::as_slice);
    overlay.iter().try_for_each(|own| own.keep(&folder)).map_err(unwritable)?;
    write_whole(&listed, with_overlay(&entry.parameters_toml, overlay).as_bytes()).map_err(unwritable)?;
    let file = CaseFile::read(&listed)?;
    // how much it may ask for was decided when it was planned
    let changes =
        Changes { file: Some((&listed, file.fields)), settings: &[], limits: Limits::NONE, only: &entry.only };
    let prepared = registry.find(&entry.case)?.prepare(entry.tier, &changes)?;
    let prepared = evaluation::chosen(prepared, &entry.only, &listed)?;
    let record = evaluation::evaluate(prepared, overlay, store, &Silent)?;
    // a folder that somebody has removed meanwhile is not made again for a part of the sweep
    let marker = sweep.path().join(Manifest::MARKER);
    marker.metadata().map_err(|error| FileError::unwritable(sweep.path(), &error))?;
    if let Some(reason) = &record.failure {
        write_whole(&folder.join("failure.txt"), format!("{reason}\n").as_bytes()).map_err(unwritable)?;
    }
    write_whole(&folder.join("metrics.json"), pretty(&record.metrics).as_bytes()).map_err(unwritable)?;
    record.write(&folder.join("record.postcard")).map_err(unwritable)?;
    Ok(record)
}

/// Runs the missing simulations.
///
/// # Errors
/// Files that cannot be written; runs that have not begun are then left.
pub fn run_locally(
    sweep: &SweepFolder,
    registry: Registry,
    store: &Store,
    watch: &dyn SweepMonitor,
) -> Result<(), ToolError> {
    share_out(sweep.missing(), |entry| {
        watch.begun(entry);
        let record = run_entry(sweep, entry, registry, store)?;
        watch.ended(entry, &record);
        Ok(())
    })
    .map(drop)
}
