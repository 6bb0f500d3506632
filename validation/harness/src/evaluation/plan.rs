//! Plans of many evaluations, whatever their purpose: files of TOML with a type of their own.

use crate::case::ParameterError;
use crate::input::{FieldError, WRITTEN_BY_HAND, read_text};
use crate::output::FileError;
use serde::de::DeserializeOwned;
use std::path::Path;

/// Reads and types a plan; `command` is the one whose help shows a valid plan.
///
/// # Errors
/// A file that cannot be read, or whose text is not TOML or does not have the type's fields, with the place.
pub fn read_plan<T: DeserializeOwned>(file: &Path, command: &str) -> Result<T, ParameterError> {
    let text = read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error))?;
    parse_plan(file, &text, command)
}

/// Keys of earlier plans by the command that reads them, each with the one that takes its place.
const FORMER: [(&str, &str, &str); 2] = [("bagnold run", "parameters", "set"), ("bagnold sweep", "parameters", "vary")];

/// Plan of a file with this text.
///
/// # Errors
/// A text that is not TOML, or not a plan of its command.
pub fn parse_plan<T: DeserializeOwned>(file: &Path, text: &str, command: &str) -> Result<T, ParameterError> {
    let refused = |error: toml::de::Error| {
        let is_former = |(own, key, _): &&(&str, &str, &str)| {
            *own == command && error.message().starts_with(&format!("unknown field `{key}`"))
        };
        if let Some((_, key, now)) = FORMER.iter().find(is_former) {
            return FieldError::finding(key, "outdated name", &format!("rename it to `{now}`"));
        }
        let remedy = match command {
            "bagnold grains" => "`bagnold examples` writes a plan, examples/grains/slopes.toml".to_owned(),
            "bagnold judge" => "`bagnold judge --template CASE` prints a submission to fill in".to_owned(),
            _ => format!("`{command} --help` shows a plan"),
        };
        FieldError::of_toml(text, &error, in_plain_words(text, &error), &remedy)
    };
    toml::from_str(text).map_err(|error| refused(error).in_file(file).into())
}

/// A message about a value in the words of who writes it, with the field that stands on its line.
fn in_plain_words(text: &str, error: &toml::de::Error) -> String {
    const TYPES: [(&str, &str); 5] = [
        ("expected f64", "expected a number, without quotes"),
        ("expected usize", "expected a whole number, without quotes"),
        ("expected u64", "expected a whole number, without quotes"),
        ("expected a sequence", "expected a list in brackets, [ ]"),
        ("expected a boolean", "expected true or false, without quotes"),
    ];
    let message = error.message();
    let Some((programmers, words)) = TYPES.iter().find(|(programmers, _)| message.ends_with(programmers)) else {
        return message.to_owned();
    };
    let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
    let field = before.lines().next_back().and_then(|line| line.split_once('='));
    let field = field.map_or_else(String::new, |(field, _)| format!("`{}`: ", field.trim()));
    format!("{field}{}", message.replace(programmers, words).replace("invalid type: ", "found "))
}
