//! A field whose value breaks a rule: the error that most input is refused with.

use super::escape::{escaped, shown};
use crate::sampling::BoundsError;
use bagnold_solver::parameter::{defect, shortened};
use std::path::{Path, PathBuf};

/// Origin of a value: a file, or an argument of the command line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// In a file.
    File(PathBuf),
    /// By a `--set path=value`.
    Setting(String),
}

/// "`field` is `value`, but must be `rule`; `remedy`", or "`field`: `value`; `remedy`" where no rule has to be told.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}`{field}`{}; {remedy}", before(origin), defect(value, rule))]
#[must_use]
pub struct FieldError {
    /// Origin of the value, if it is known; whoever reads a file adds it.
    pub origin: Option<Origin>,
    /// Dotted TOML path.
    pub field: String,
    /// The offending value as written.
    pub value: String,
    /// The rule it breaks, completing "must be …".
    pub rule: Box<str>,
    /// Instruction to the user, such as "give it in metres".
    pub remedy: Box<str>,
}

impl FieldError {
    /// The error of a field whose file is not known yet.
    pub fn new(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        let value = value.to_string();
        let value = escaped(&if rule.is_empty() { value } else { shortened(value) }).into_owned();
        Self { origin: None, field: escaped(field).into_owned(), value, rule: rule.into(), remedy: remedy.into() }
    }

    /// The error of a field whose defect needs no rule, such as an unclosed quote.
    pub fn finding(field: &str, defect: impl std::fmt::Display, remedy: &str) -> Self {
        Self::new(field, defect, "", remedy)
    }

    /// The error of a range that stands in a table of a file.
    pub fn of_bounds(table: &str, error: &BoundsError) -> Self {
        Self::new(&format!("{table}.{}", error.end), error.value, &error.rule, error.remedy)
    }

    /// Marks the field as part of a group of fields.
    pub fn within(mut self, group: &str) -> Self {
        self.field = format!("{group}.{}", self.field);
        self
    }

    /// Adds the file of the field, unless its origin is already known.
    pub fn in_file(mut self, path: &Path) -> Self {
        self.origin.get_or_insert_with(|| Origin::File(path.to_owned()));
        self
    }

    /// Notes that a `--set` gives the field.
    pub fn set_by(mut self, argument: String) -> Self {
        self.origin = Some(Origin::Setting(shortened(argument)));
        self
    }

    /// A text that is not TOML, or has other fields than its type; `message` and `remedy` are those of its reader.
    pub fn of_toml(text: &str, error: &toml::de::Error, message: impl std::fmt::Display, remedy: &str) -> Self {
        let (line, column) = position(text, error.span().map_or(0, |span| span.start));
        let deep = "cannot recurse further; max recursion depth met";
        let message = message.to_string().replace(deep, "brackets are nested too deeply");
        Self::finding(&format!("line {line}, column {column}"), message, remedy)
    }
}

/// The origin before a message.
pub(crate) fn before(origin: &Option<Origin>) -> String {
    match origin {
        Some(Origin::File(path)) => format!("{}: ", shown(path)),
        Some(Origin::Setting(argument)) => format!("`--set {}`: ", escaped(argument)),
        None => String::new(),
    }
}

/// Line and column of a byte offset, both from 1.
fn position(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    (line, column)
}
