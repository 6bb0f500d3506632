//! Errors while a report is read, judged or written.

use crate::figure::FigureError;
use crate::input::read_text;
use crate::output::{FileError, FolderError};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Reason why a report was not written; the message completes "failed to …".
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A case name that would not stay inside the report's folder.
    #[error(
        "write the case {name:?}: a name consists of letters, digits, '-', '_' and '.', and starts with a letter or digit"
    )]
    Name {
        /// The name as given.
        name: String,
    },
    /// A file or folder could not be written.
    #[error("write {path}: {source}")]
    Write {
        /// The file or folder.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// A figure's file could not be written.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The page's template is damaged.
    #[error("fill the page's template: {0}")]
    Template(#[from] minijinja::Error),
}

/// Reason why a committed file of `tests/snapshots` was not read or written; the message completes "failed to …".
#[derive(Debug, thiserror::Error)]
pub enum BaselineError {
    /// The file could not be read.
    #[error("read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file could not be written.
    #[error("write {path}: {source}")]
    Write {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file is not what it should be.
    #[error("read {path}: {message}; correct the file, or delete it to start afresh")]
    Content {
        /// The file.
        path: PathBuf,
        /// Defect of the file.
        message: String,
    },
    /// A case name that is no file name.
    #[error("name a baseline after the case {name:?}: a case name is kebab-case")]
    Name {
        /// The name as given.
        name: String,
    },
}

/// Reason why a report or a run is not finished.
#[derive(Debug, thiserror::Error)]
pub enum ProcessError {
    /// A folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The committed baseline or list of expected failures cannot be used.
    #[error("failed to {0}; correct the file or restore it from version control")]
    Baseline(#[from] BaselineError),
    /// The report to compare with cannot be used.
    #[error("failed to {0}")]
    Earlier(#[from] EarlierError),
    /// The pages cannot be written.
    #[error("failed to {0}; check the folder and its permissions")]
    Report(#[from] ReportError),
}

/// The text of a committed file of at most so many bytes; none where there is no file.
pub(super) fn read_if_there(path: &Path, most: u64) -> Result<Option<String>, BaselineError> {
    match read_text(path, most) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(source) => Err(BaselineError::Read { path: path.to_owned(), source }),
    }
}

/// Reason why an earlier report's folder is no baseline; the message completes "failed to …".
#[derive(Debug, thiserror::Error)]
pub enum EarlierError {
    /// A file could not be read.
    #[error("read {path}: {source}; check its permissions")]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// It is not what it should be.
    #[error(
        "compare with {path}: {message}; give --against the folder of an earlier report of the same tier and cases"
    )]
    Content {
        /// The file or folder.
        path: PathBuf,
        /// Defect of the file or folder.
        message: String,
    },
}
