//! Errors of a sweep that does not begin or resume.

use crate::case::ParameterError;
use crate::input::{FieldError, shown};
use crate::output::{FileError, FolderError};
use std::path::PathBuf;

/// A sweep that cannot be planned, found, run or gathered.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// Its plan cannot be followed.
    #[error(transparent)]
    Plan(#[from] ParameterError),
    /// It has no such run.
    #[error(transparent)]
    Entry(#[from] FieldError),
    /// A folder holds no sweep.
    #[error("{}: holds no sweep (no manifest.json); name the folder that `bagnold sweep` wrote", shown(.folder))]
    NoSweep {
        /// The folder.
        folder: PathBuf,
    },
    /// Its folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file of it cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A command of the scheduler is missing or refuses.
    #[error("slurm: `{command}` {reason}; {remedy}")]
    Slurm {
        /// The command.
        command: String,
        /// Defect, as a clause after the command.
        reason: String,
        /// Remedy.
        remedy: &'static str,
    },
}
