//! How many wrong inputs the gates of a case reject.

/// A line about the controls of a case; none where none were run.
pub(super) fn rejected_inputs(_case: &str) -> Option<String> {
    None
}
