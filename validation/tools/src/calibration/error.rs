//! Errors of a calibration that does not begin or finds nothing.

use crate::case::ParameterError;
use crate::input::{FieldError, shown};
use crate::output::{FileError, FolderError};
use std::path::PathBuf;

/// A calibration that cannot be planned or carried out.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationError {
    /// Its plan cannot be followed.
    #[error(transparent)]
    Plan(#[from] ParameterError),
    /// A field of its plan or of its data breaks a rule.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// Its folder cannot be used.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// A file of it cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A run is fitted and held out.
    #[error("{}: the run `{run}` is in both `{fit}` and `{hold_out}`; what is predicted must not be fitted, so take it out of one", shown(.file))]
    InBoth {
        /// The plan.
        file: PathBuf,
        /// The run.
        run: String,
        /// Block in which the run is fitted.
        fit: String,
        /// Block in which the run is held out.
        hold_out: String,
    },
    /// Held-out data have the conditions of fitted data.
    #[error("{}: `{hold_out}` has the conditions of `{fit}` ({same}: the same within {percent} %); what is predicted must differ in its physics, so hold out other conditions", shown(.file))]
    SameConditions {
        /// The plan.
        file: PathBuf,
        /// The block that is held out.
        hold_out: String,
        /// The fitted one.
        fit: String,
        /// The parameters with both values.
        same: String,
        /// Difference up to which two values are the same `[%]`.
        percent: f64,
    },
    /// Data have no counterpart in what a case computes.
    #[error("{}: `{field}`: the case gives {reason}", shown(.file))]
    Counterpart {
        /// The plan.
        file: PathBuf,
        /// The group of data.
        field: String,
        /// Missing counterpart, and the available ones.
        reason: String,
    },
    /// A search cannot begin or has found nothing.
    #[error("{}: {reason}", shown(.file))]
    Search {
        /// The plan.
        file: PathBuf,
        /// Reason for the failure.
        reason: String,
    },
}
