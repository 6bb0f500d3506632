//! Errors while a report is read, judged or written.

use crate::case::ParameterError;
use crate::figure::FigureError;
use crate::input::FieldError;
pub(super) use crate::output::read_if_there;
use crate::output::{FileError, FolderError};
use std::path::Path;

/// Reason why a report or a run is not finished.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The committed values, the list of expected failures, or the report to compare with cannot be used.
    #[error(transparent)]
    Values(#[from] ParameterError),
    /// A name that would not stay inside the report's folder.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A figure's file could not be written.
    #[error("failed to {0}; check the folder and its permissions")]
    Figure(#[from] FigureError),
    /// The page's template is damaged.
    #[error("failed to fill the page's template: {0}; rebuild the program")]
    Template(#[from] minijinja::Error),
}

/// A committed file with wrong content.
pub(super) fn damaged(path: &Path, reason: String) -> ParameterError {
    FileError::damaged(path, reason, "correct the file, or restore it from version control").into()
}

/// Refuses a case whose name would not stay inside a folder.
pub(super) fn check_case_name(name: &str) -> Result<(), FieldError> {
    if crate::figure::is_file_name(name) {
        return Ok(());
    }
    let rule = "letters, digits, `-`, `_` and `.`, the first of them a letter or digit";
    Err(FieldError::new("case", format!("\"{name}\""), rule, "rename the case or study"))
}
