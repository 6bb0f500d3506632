//! What serde and TOML say about a bad field, put into a user's words.

use super::error::ParameterError;
use super::parameters::{find, paths};
use crate::input::{FieldError, nearest};
use serde::de::DeserializeOwned;
use std::ops::Range;
use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

/// One bad field, by its dotted path.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// The type has no such field; `known` are its neighbours where the parser told them.
    Unknown { path: String, known: Vec<String> },
    /// The type needs this field.
    Missing { path: String },
    /// The value has the wrong type or is outside it.
    Value { path: String, rule: String, remedy: Option<String> },
}

impl Fault {
    /// Types a table. The parser tells the place of an error by its span only, so the table goes through
    /// a text in which every value is inside its key's span.
    pub(super) fn catch<P: DeserializeOwned>(table: &Table) -> Result<P, Self> {
        let text: String =
            table.iter().map(|(key, value)| format!("{} = {value}\n", Value::String(key.clone()))).collect();
        toml::from_str(&text).map_err(|error| Self::from_toml(&error, &text))
    }

    fn from_toml(error: &toml::de::Error, text: &str) -> Self {
        let path = error.span().map_or_else(String::new, |span| path_at(text, &span));
        let below = |parent: &str, name: &str| match parent {
            "" => name.to_owned(),
            _ => format!("{parent}.{name}"),
        };
        let message = error.message();
        let names = quoted(message);
        match names.split_first() {
            Some((_, known)) if message.starts_with("unknown field") => {
                let parent = path.rsplit_once('.').map_or("", |(parent, _)| parent);
                Self::Unknown { known: known.iter().map(|name| below(parent, name)).collect(), path }
            }
            Some((name, _)) if message.starts_with("missing field") => Self::Missing { path: below(&path, name) },
            Some((name, known)) if message.starts_with("unknown variant") => Self::Value {
                path,
                rule: choices(known),
                remedy: nearest(name, known.iter().copied()).map(|name| format!("did you mean `{name}`?")),
            },
            _ => Self::Value { path, rule: rule(message), remedy: None },
        }
    }

    /// The error for parameters of `case` that were read into `table`.
    pub(super) fn in_parameters(self, case: &str, table: &Table) -> ParameterError {
        match self {
            Self::Unknown { path, known } => {
                let known = if known.is_empty() { paths(table) } else { known };
                let others = known.iter().map(String::as_str).filter(|other| *other != path);
                ParameterError::UnknownField {
                    file: None,
                    nearest: nearest(&path, others),
                    field: path,
                    case: case.to_owned(),
                }
            }
            Self::Missing { path } => ParameterError::MissingField { file: None, field: path, case: case.to_owned() },
            Self::Value { path, rule, remedy } => ParameterError::Field(FieldError {
                file: None,
                value: find(table, &path)
                    .map(ToString::to_string)
                    .filter(|text| !text.contains('\n'))
                    .unwrap_or_else(|| "not valid".to_owned()),
                rule,
                remedy: remedy.unwrap_or_else(|| format!("`bagnold show {case}` prints a valid value")),
                field: path,
            }),
        }
    }
}

/// The dotted path of the innermost field whose key or value covers a span.
fn path_at(text: &str, span: &Range<usize>) -> String {
    let mut path = Vec::new();
    if let Ok(document) = DeTable::parse(text) {
        let mut table = document.get_ref();
        while let Some((key, value)) =
            table.iter().find(|(key, value)| key.span().start <= span.start && span.end <= value.span().end)
        {
            path.push(key.get_ref().to_string());
            match value.get_ref() {
                DeValue::Table(inner) => table = inner,
                _ => break,
            }
        }
    }
    path.join(".")
}

/// The names between backquotes.
fn quoted(message: &str) -> Vec<&str> {
    message.split('`').skip(1).step_by(2).collect()
}

fn choices(known: &[&str]) -> String {
    let quoted: Vec<String> = known.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [only] => only.clone(),
        _ => format!("one of {}", quoted.join(", ")),
    }
}

/// The rule that the value breaks, completing "must be …", without the words of Rust's type system.
fn rule(message: &str) -> String {
    let Some((_, expected)) = message.split_once(", expected ") else {
        return message.to_owned();
    };
    match expected {
        "f32" | "f64" => "a number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number that is not negative",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "a boolean" => "true or false",
        "a string" | "string only" => "a string",
        "a sequence" => "an array in brackets, such as [1.0, 2.0] or [\"newtonian\"]",
        structure if structure.starts_with("struct ") => "a table of fields",
        other => other,
    }
    .to_owned()
}
