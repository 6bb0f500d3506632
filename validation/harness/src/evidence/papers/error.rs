//! Errors in the rows of a paper.

/// Rows that cannot be read; the message completes "failed to …".
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PaperError {
    /// The text is no TOML, or has a field that is missing, unknown or of another type.
    #[error("read {file}: {message}")]
    Text {
        /// The file.
        file: String,
        /// Defect of the text, with its line.
        message: String,
    },
    /// A row breaks a rule.
    #[error("read {file}, row {row} (`{id}`): `{field}` is {value:?}, but must be {rule}")]
    Row {
        /// The file.
        file: String,
        /// Row, counted from 1.
        row: usize,
        /// Name of its element.
        id: String,
        /// Field at fault.
        field: &'static str,
        /// Offending value of the field.
        value: String,
        /// Rule for the field, and the remedy.
        rule: String,
    },
}
