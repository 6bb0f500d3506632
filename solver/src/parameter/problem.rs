//! A parameter outside its range, or one that does not fit the others.

/// A parameter that breaks a rule, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{field}`{}; {remedy}", defect(value, rule))]
pub struct ParameterProblem {
    /// Dotted path of the field, with the index in a list: `slopes[1]`.
    pub field: String,
    /// The value as written.
    pub value: String,
    /// The rule that it breaks, completing "must be …"; empty where the value is the whole defect, "`field`: `value`; `remedy`".
    pub rule: String,
    /// Instruction to the user, such as "give it in metres".
    pub remedy: String,
}

impl ParameterProblem {
    /// A problem of a field.
    #[must_use]
    pub fn new(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        Self {
            field: field.to_owned(),
            value: shortened(value.to_string()),
            rule: rule.to_owned(),
            remedy: remedy.to_owned(),
        }
    }

    /// Marks the field as part of a group of parameters.
    #[must_use]
    pub fn within(mut self, group: &str) -> Self {
        self.field = format!("{group}.{}", self.field);
        self
    }
}

/// Value and rule of a message after the name of the field, or the value alone where there is no rule.
#[must_use]
pub fn defect(value: &str, rule: &str) -> String {
    if rule.is_empty() { format!(": {value}") } else { format!(" is {value}, but must be {rule}") }
}

/// Most characters of a value that a message shows.
const SHOWN: usize = 200;

/// A value as a message shows it: a number of many digits with an exponent, a long text by its beginning.
#[must_use]
pub fn shortened(text: String) -> String {
    if text.len() <= 24 {
        return text;
    }
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => format!("{number:e}"),
        _ if text.chars().count() > SHOWN => text.chars().take(SHOWN).chain("…".chars()).collect(),
        _ => text,
    }
}
