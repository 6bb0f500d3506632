//! Errors of work that does not begin, cannot be resumed or finds nothing.

use crate::case::ParameterError;
use crate::input::{FieldError, shown};
use crate::output::{FileError, FolderError};
use std::path::{Path, PathBuf};

/// A sweep, a calibration, a judgement or a comparison that cannot be planned or carried out.
#[derive(Debug, thiserror::Error)]
pub enum ToolError {
    /// Plan or its data cannot be followed, or a file cannot be read or written.
    #[error(transparent)]
    Input(#[from] ParameterError),
    /// Folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A plan, a folder or a program, given by its name, does not give what is needed of it as a whole: defect and remedy.
    #[error("{}: {}", shown(.0), .1)]
    Place(PathBuf, String),
}

impl ToolError {
    pub(crate) fn at(place: &Path, reason: String) -> Self {
        Self::Place(place.to_owned(), reason)
    }
}

impl From<FieldError> for ToolError {
    fn from(error: FieldError) -> Self {
        Self::Input(error.into())
    }
}

impl From<FileError> for ToolError {
    fn from(error: FileError) -> Self {
        Self::Input(error.into())
    }
}
