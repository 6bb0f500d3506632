//! Errors of `bagnold new`.

use crate::input::FieldError;
use crate::output::FileError;
use std::path::PathBuf;

/// Reason that no crate was made.
#[derive(Debug, thiserror::Error)]
pub enum NewError {
    /// A name that no crate, law or case can have.
    #[error(transparent)]
    Name(#[from] FieldError),
    /// A folder that is there already.
    #[error(
        "{}: exists already, so nothing was changed; name a new folder with --out, or remove this one", .folder.display()
    )]
    Exists {
        /// The folder.
        folder: PathBuf,
    },
    /// Files that cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}
