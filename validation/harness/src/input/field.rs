//! A field whose value breaks a rule: the error that most input is refused with.

use super::escape::{escaped, origin};
use crate::sampling::BoundsError;
use bagnold_solver::parameter::shortened;
use std::path::{Path, PathBuf};

/// "`field` is `value`, but must be `rule`; `remedy`", or "`field`: `value`; `remedy`" where no rule has to be told.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}`{field}`{}; {remedy}", origin(.file), defect(value, rule))]
#[must_use]
pub struct FieldError {
    /// File it stands in, where known; whoever reads the file adds it.
    pub file: Option<PathBuf>,
    /// Dotted TOML path.
    pub field: String,
    /// The offending value as written.
    pub value: String,
    /// The rule it breaks, completing "must be …".
    pub rule: Box<str>,
    /// Remedy.
    pub remedy: Box<str>,
}

impl FieldError {
    /// The error of a field whose file is not known yet.
    pub fn new(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        let value = value.to_string();
        let value = escaped(&if rule.is_empty() { value } else { shortened(value) }).into_owned();
        Self { file: None, field: escaped(field).into_owned(), value, rule: rule.into(), remedy: remedy.into() }
    }

    /// The error of a field whose defect needs no rule, such as an unclosed quote.
    pub fn finding(field: &str, defect: impl std::fmt::Display, remedy: &str) -> Self {
        Self::new(field, defect, "", remedy)
    }

    /// The error of a range that stands in a table of a file.
    pub fn of_bounds(table: &str, error: &BoundsError) -> Self {
        Self::new(&format!("{table}.{}", error.end), error.value, &error.rule, error.remedy)
    }

    /// Says that the field is part of a group of fields.
    pub fn within(mut self, group: &str) -> Self {
        self.field = format!("{group}.{}", self.field);
        self
    }

    /// Says in which file the field stands, unless that is already known.
    pub fn in_file(mut self, path: &Path) -> Self {
        self.file.get_or_insert_with(|| path.to_owned());
        self
    }
}

/// Value and rule of a message, or the value alone.
fn defect(value: &str, rule: &str) -> String {
    if rule.is_empty() { format!(": {value}") } else { format!(" is {value}, but must be {rule}") }
}
