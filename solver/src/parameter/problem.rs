//! A parameter outside its range.

/// A parameter that breaks a rule, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{field}` is {value}, but must be {rule}; {remedy}")]
pub struct ParameterProblem {
    /// Dotted path of the field, with the index in a list: `slopes[1]`.
    pub field: String,
    /// The value as written.
    pub value: String,
    /// The rule that it breaks, completing "must be …".
    pub rule: String,
    /// What to do about it.
    pub remedy: String,
}

impl ParameterProblem {
    /// A problem of a field.
    #[must_use]
    pub fn new(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        Self { field: field.to_owned(), value: value.to_string(), rule: rule.to_owned(), remedy: remedy.to_owned() }
    }

    /// Says that the field is part of a group of parameters.
    #[must_use]
    pub fn within(mut self, group: &str) -> Self {
        self.field = format!("{group}.{}", self.field);
        self
    }
}
