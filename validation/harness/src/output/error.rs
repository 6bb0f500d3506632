//! Errors of files and folders.

use crate::input::{read_text, shown};
use std::path::{Path, PathBuf};

/// A file that cannot be read, understood or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// A file cannot be read.
    #[error("{}: cannot be read ({reason}); {remedy}", shown(.file))]
    Unreadable {
        /// File that cannot be used.
        file: PathBuf,
        /// The system's reason.
        reason: String,
        /// Instruction to the user.
        remedy: &'static str,
    },
    /// A file or folder cannot be written, with the system's reason.
    #[error("{}: cannot be written ({}); choose a folder that you may write to with --out", shown(.0), .1)]
    Unwritable(PathBuf, String),
    /// A file of ours cannot be understood.
    #[error("{}: damaged ({reason}); {remedy}", shown(.file))]
    Damaged {
        /// File that cannot be used.
        file: PathBuf,
        /// Defect of the file.
        reason: String,
        /// Instruction to the user.
        remedy: String,
    },
}

impl FileError {
    /// A file that cannot be read, with the system's reason.
    pub fn unreadable(file: &Path, error: &std::io::Error) -> Self {
        let remedy = match error.kind() {
            std::io::ErrorKind::InvalidData => "save it as plain text in UTF-8",
            std::io::ErrorKind::FileTooLarge => "shorten it, or move it elsewhere",
            _ => "check the path and its permissions",
        };
        Self::Unreadable { file: file.to_owned(), reason: reason(error), remedy }
    }

    /// A file or folder that cannot be written, with the system's reason.
    pub fn unwritable(path: &Path, error: &std::io::Error) -> Self {
        Self::Unwritable(path.to_owned(), reason(error))
    }

    /// A file of ours that cannot be understood.
    pub fn damaged(file: &Path, reason: impl std::fmt::Display, remedy: &str) -> Self {
        Self::Damaged { file: file.to_owned(), reason: reason.to_string(), remedy: remedy.to_owned() }
    }
}

/// Text of a file of at most a number of bytes; none where there is no file.
///
/// # Errors
/// A file that cannot be read.
pub fn read_if_there(file: &Path, most: u64) -> Result<Option<String>, FileError> {
    match read_text(file, most) {
        Ok(text) => Ok(Some(text)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(FileError::unreadable(file, &error)),
    }
}

/// A folder that work cannot be put into.
#[derive(Debug, thiserror::Error)]
pub enum FolderError {
    /// A folder holds work that may be continued.
    #[error("{}: contains a {what} already; add --resume to resume it, or name another folder with --out", shown(.folder))]
    InUse {
        /// A sweep or a calibration.
        what: &'static str,
        /// Output folder that cannot be used.
        folder: PathBuf,
    },
    /// A folder holds other work than what is asked for.
    #[error("{}: contains a {what} {}; name another folder with --out", shown(.folder), if *.by_program { "of another version of bagnold, whose numbers may differ" } else { "of another plan" })]
    OtherPlan {
        /// A sweep or a calibration.
        what: &'static str,
        /// Output folder that cannot be used.
        folder: PathBuf,
        /// Whether the program differs, not the plan.
        by_program: bool,
    },
    /// The output folder holds files that are not Bagnold's.
    #[error("output folder {}: not empty and not written by bagnold, so nothing was changed; name an empty or new folder with --out", shown(.0))]
    Foreign(PathBuf),
    /// Another command is writing the folder.
    #[error("output folder {}: in use by another bagnold command that is running{by}, so nothing was changed; wait until it has ended, or name another folder with --out", shown(.folder))]
    Locked {
        /// Output folder that cannot be used.
        folder: PathBuf,
        /// Process that holds the lock, if known: " (process 17)".
        by: String,
    },
    /// Files in it cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
}

/// The system's words without the error number, which means nothing to a reader: "permission denied".
pub fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let words = text.split(" (os error").next().unwrap_or(&text);
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}
