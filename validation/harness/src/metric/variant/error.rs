//! Errors in the text of a variant.

/// Defect of a text that should name a run.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum VariantError {
    /// A part without a key or a value.
    #[error("`{text}` must be `key=value,key=value`, but has the part `{part}`")]
    Part {
        /// The text as given.
        text: String,
        /// The part at fault.
        part: String,
    },
    /// A key that stands twice.
    #[error("`{text}` must be `key=value,key=value`, but has `{key}` twice")]
    Twice {
        /// The text as given.
        text: String,
        /// The key.
        key: String,
    },
}
