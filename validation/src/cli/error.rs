//! Why the program ends with exit code 2.

use crate::calibration::CalibrationError;
use crate::case::ParameterError;
use crate::output::{FileError, FolderError};
use crate::report::{BaselineError, EarlierError, ReportError};
use crate::sweep::SweepError;

/// Input that is refused, or output that cannot be written: each message names file, field, value, rule and remedy.
#[derive(Debug, thiserror::Error)]
pub enum ProgramError {
    /// A case does not take its parameters, or its threads cannot be started.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A sweep is refused.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A calibration is refused.
    #[error(transparent)]
    Calibration(#[from] CalibrationError),
    /// The committed baseline or list of known failures cannot be used.
    #[error("failed to {0}; correct the file or restore it from version control")]
    Baseline(#[from] BaselineError),
    /// The report to compare with cannot be used.
    #[error("failed to {0}")]
    Earlier(#[from] EarlierError),
    /// A report cannot be written.
    #[error("failed to {0}; check the folder and its permissions")]
    Report(#[from] ReportError),
}
