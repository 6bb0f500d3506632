//! Errors in the text of a variant.

/// Defect of a text that should name a run.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` must be `key=value,key=value`, but has {defect}")]
pub struct VariantError {
    /// Text as given.
    pub text: String,
    /// A part without a key or a value, or a key that stands twice.
    pub defect: String,
}
