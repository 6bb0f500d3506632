//! Errors that end the program with exit code 2.

use crate::ToolError;
use crate::case::ParameterError;
use crate::output::{FileError, FolderError, reason};
use crate::report::ReportError;

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
    /// A sweep, a calibration, a judgement or a comparison is refused.
    #[error(transparent)]
    Tool(#[from] ToolError),
    /// Standard output cannot be written, with the system's reason.
    #[error(
        "standard output: cannot be written ({0}); free space, or redirect it; the folders of results were written"
    )]
    Output(String),
    /// Warnings that `--deny-warnings` does not let pass, by their number.
    #[error(
        "`--deny-warnings` rejects the input because of {0} of the warnings above; correct the input, or leave the option out"
    )]
    Cautions(usize),
    /// A report or a run that is not finished.
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl ProgramError {
    /// Standard output that cannot be written, with the system's reason.
    pub(super) fn unprintable(error: &std::io::Error) -> Self {
        Self::Output(reason(error))
    }
}
