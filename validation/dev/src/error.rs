//! Errors that end the program with exit code 2.

use crate::case::ParameterError;
use crate::mutation::CopyError;
use crate::output::{FileError, FolderError};

/// Input that is refused, or output that cannot be written: each message names file, field, value, rule and remedy.
#[derive(Debug, thiserror::Error)]
pub(crate) enum DevError {
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error(transparent)]
    File(#[from] FileError),
    /// Mutations without the sources that they change.
    #[error("failed to find the sources that mutations change; work in a checkout of bagnold")]
    NoSources,
    /// The copy of the program with all mutations.
    #[error(transparent)]
    Copy(#[from] CopyError),
    /// No mutation has this name.
    #[error("`{name}` is not among the mutations; `cargo run -p bagnold-dev -- mutate list` names them")]
    UnknownError { name: String },
    /// A mutation that no test is named for.
    #[error(
        "mutation `{name}` names no test to run; give it `tests` in validation/dev/mutations.toml, or try it in a case: `cargo run -p bagnold-dev -- mutate trial {name} CASE`"
    )]
    ErrorWithoutTests { name: String },
    /// A test that fails without a mutation as well.
    #[error("test {test} fails without an error as well: {reason}; mend it first")]
    TestFails { test: String, reason: String },
    /// A case that does not even run without an error.
    #[error("failed to run {case} without an error: {reason}; see `bagnold run {case}`")]
    Trial { case: String, reason: String },
}
