//! Errors of a reference: a data file, or the rows of a paper.

/// A reference that cannot be read; the message completes "failed to …".
#[derive(Debug, thiserror::Error)]
pub enum ReferenceError {
    /// The file cannot be read.
    #[error("read the reference data {file}: {source}")]
    Unreadable {
        /// File as the caller named it.
        file: String,
        /// The operating system's reason.
        source: std::io::Error,
    },
    /// Its text breaks a rule.
    #[error("read {place}: {defect}")]
    Text {
        /// File as the caller named it, with line, column or row where they are known, each counted from 1.
        place: String,
        /// Offending text with the rule that it breaks, and the remedy.
        defect: String,
    },
}

impl ReferenceError {
    /// The error of a text at a place of a reference file.
    pub(super) fn at(place: &str, defect: impl Into<String>) -> Self {
        Self::Text { place: format!("the reference data {place}"), defect: defect.into() }
    }
}
