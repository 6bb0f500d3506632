//! The folder of a sweep: who is done, who failed, who is missing.

use super::manifest::{Manifest, SweepRun};
use crate::ToolError;
use crate::evaluation::EvaluationRecord;
use crate::output::{FolderError, Owner, claim, owner_of};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Longest wait for another command that begins the same sweep at this moment.
const LONGEST_BEGINNING: Duration = Duration::from_secs(30);

/// Progress of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SweepProgress {
    /// Runs with numbers.
    pub done: usize,
    /// Runs that failed, with their reason.
    pub failed: usize,
    /// Runs without a record.
    pub missing: usize,
    /// Values that are not numbers, of all runs with numbers; counted by [`super::gather`] only.
    pub without_value: usize,
}

/// A sweep on disk.
#[derive(Debug, Clone)]
pub struct SweepFolder {
    folder: PathBuf,
    manifest: Manifest,
}

impl SweepFolder {
    /// Makes the folder of a sweep, or continues it. Any number of commands may work in it, of one plan all of them; only the
    /// manifest is written by one alone.
    ///
    /// # Errors
    /// A folder with another sweep or foreign files; files that cannot be written.
    pub fn begin(folder: &Path, manifest: &Manifest) -> Result<Self, ToolError> {
        let begun = Instant::now();
        loop {
            match claim(folder, manifest, true) {
                // the lock ends here
                Ok(_) => return Ok(Self { folder: folder.to_owned(), manifest: manifest.clone() }),
                Err(FolderError::Locked { .. }) if begun.elapsed() < LONGEST_BEGINNING => {
                    std::thread::sleep(Duration::from_millis(20));
                }
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Opens the folder of a sweep.
    ///
    /// # Errors
    /// A folder without a manifest, or a manifest of another version of the program.
    pub fn open(folder: &Path) -> Result<Self, ToolError> {
        let nothing = "no sweep in this folder (no manifest.json); name the folder that `bagnold sweep` wrote";
        let manifest: Manifest = owner_of(folder)?.ok_or_else(|| ToolError::at(folder, nothing.to_owned()))?;
        if manifest.is_foreign() {
            return Err(FolderError::OtherPlan { what: "sweep", folder: folder.to_owned(), by_program: true }.into());
        }
        Ok(Self { folder: folder.to_owned(), manifest })
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.folder
    }

    /// Manifest of the runs.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Folder of a run.
    pub fn of(&self, entry: &SweepRun) -> PathBuf {
        self.folder.join("runs").join(&entry.folder)
    }

    /// The record of a run that is done or has failed.
    pub fn record(&self, entry: &SweepRun) -> Option<EvaluationRecord> {
        match &entry.refusal {
            Some(reason) => Some(EvaluationRecord::failed("", &entry.case, reason)),
            None => EvaluationRecord::read(&self.of(entry).join("record.postcard"), &entry.key),
        }
    }

    /// Runs without a record, the longest first; of equal ones the first first.
    pub fn missing(&self) -> Vec<&SweepRun> {
        let mut missing: Vec<&SweepRun> =
            self.manifest.entries.iter().filter(|entry| self.record(entry).is_none()).collect();
        missing.sort_by(|a, b| b.particle_steps.total_cmp(&a.particle_steps).then(a.number.cmp(&b.number)));
        missing
    }

    /// Numbers of runs that are done, failed and missing.
    pub fn tally(&self) -> SweepProgress {
        let mut tally = SweepProgress::default();
        for entry in &self.manifest.entries {
            match self.record(entry) {
                None => tally.missing += 1,
                Some(record) if record.failure.is_some() => tally.failed += 1,
                Some(_) => tally.done += 1,
            }
        }
        tally
    }
}
