//! Errors of `bagnold judge`.

use crate::case::ParameterError;
use crate::input::{FieldError, shown};
use crate::output::FolderError;
use crate::report::ReportError;
use std::path::PathBuf;

/// Errors that prevent a comparison of an external code.
#[derive(Debug, thiserror::Error)]
pub enum JudgeError {
    /// No submission.
    #[error("nothing to judge; name a file, or print one to fill with `bagnold judge --template CASE`")]
    Nothing,
    /// Two submissions mean different runs of ours.
    #[error("{}: has another case, tier or `with` than {}; judge them apart", shown(.other), shown(.first))]
    Different {
        /// The first.
        first: PathBuf,
        /// The one that differs.
        other: PathBuf,
    },
    /// A submission or a file of it.
    #[error(transparent)]
    Plan(#[from] ParameterError),
    /// The folder.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The page.
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl From<FieldError> for JudgeError {
    fn from(error: FieldError) -> Self {
        Self::Plan(error.into())
    }
}
