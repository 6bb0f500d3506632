//! Errors that end the program with exit code 2.

use crate::case::ParameterError;
use crate::output::{FileError, FolderError};

/// Input that is refused, or output that cannot be written: each message names file, field, value, rule and remedy.
#[derive(Debug, thiserror::Error)]
pub enum DevError {
    /// Input of a case, or the records of mutations.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Another obstacle to the work, with its remedy.
    #[error("{0}")]
    Stopped(String),
}

impl DevError {
    /// A case that does not even run without an error.
    pub(crate) fn trial(case: &str, reason: &str) -> Self {
        Self::Stopped(format!("failed to run {case} without an error: {reason}; see `bagnold run {case}`"))
    }
}
