//! Errors in a plan of many evaluations, whatever their purpose.

use crate::case::{ParameterError, SettingError};
use crate::input::{FieldError, WRITTEN_BY_HAND, did_you_mean, position, read_text, shown};
use crate::output::FileError;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};

/// A plan that cannot be followed.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// It cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// It is not TOML, or not one of its command.
    #[error("{}: line {line}, column {column}: {message}; `{command} --help` shows a plan", shown(.file))]
    Syntax {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// The parser's words.
        message: String,
        /// The command.
        command: &'static str,
    },
    /// A field of it breaks a rule.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// It names a path that a case's parameters do not have.
    #[error("{}: `path` is `{path}`, but `{case}` has no such field; {}`bagnold show {case}` prints all fields", shown(.file), did_you_mean(.nearest))]
    Path {
        /// The plan.
        file: PathBuf,
        /// The dotted path as given.
        path: String,
        /// The existing path that is nearest.
        nearest: Option<String>,
        /// Whose parameters they are.
        case: String,
    },
    /// A case refuses what it asks for.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

impl From<PlanError> for ParameterError {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Field(error) => Self::Field(error),
            PlanError::Parameter(error) => error,
            PlanError::File(error) => Self::File(error),
            other => Self::Study(other.to_string()),
        }
    }
}

impl PlanError {
    /// Says in which file a field stands, unless that is already known.
    #[must_use]
    pub fn in_file(self, file: &Path) -> Self {
        match self {
            Self::Field(error) => Self::Field(error.in_file(file)),
            other => other,
        }
    }

    /// Parameter error of a case, expressed in the fields of the plan that requests it.
    #[must_use]
    pub fn of(error: ParameterError, plan: &Path) -> Self {
        match error {
            ParameterError::Setting(SettingError::Path { path, nearest, case, .. }) => {
                Self::Path { file: plan.to_owned(), path, nearest, case }
            }
            ParameterError::Setting(SettingError::Value { path, value, rule, remedy }) => {
                Self::Field(FieldError::new(&path, value, &rule, &remedy).in_file(plan))
            }
            ParameterError::Setting(SettingError::Twice { path, field, earlier, .. }) => {
                let first = earlier.split('=').next().unwrap_or_default();
                let value = format!("\"{path}\", which gives `{field}` as \"{first}\" does");
                let (rule, remedy) = ("a path that no other one leads through", "vary a field once");
                Self::Field(FieldError::new("path", value, rule, remedy).in_file(plan))
            }
            ParameterError::Setting(SettingError::Form { argument, .. }) => {
                let given = argument.split('=').next().unwrap_or_default();
                let (rule, remedy) =
                    ("the dotted path of a parameter", "such as \"slope_angle\"; `bagnold show` prints all");
                Self::Field(FieldError::new("path", format!("{given:?}"), rule, remedy).in_file(plan))
            }
            other => Self::Parameter(other.in_file(plan)),
        }
    }
}

/// Reads and types a plan; `command` is the one whose help shows a valid plan.
///
/// # Errors
/// A file that cannot be read, or whose text is not TOML or does not have the type's fields, with the place.
pub fn read_plan<T: DeserializeOwned>(file: &Path, command: &'static str) -> Result<T, PlanError> {
    let text = read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error))?;
    parse_plan(file, &text, command)
}

/// Keys of earlier plans by the command that reads them, each with the one that takes its place.
const FORMER: [(&str, &str, &str); 2] = [("bagnold run", "parameters", "set"), ("bagnold sweep", "parameters", "vary")];

/// Plan of a file with this text.
///
/// # Errors
/// A text that is not TOML, or not a plan of its command.
pub fn parse_plan<T: DeserializeOwned>(file: &Path, text: &str, command: &'static str) -> Result<T, PlanError> {
    toml::from_str(text).map_err(|error| {
        let is_former = |(own, key, _): &&(&str, &str, &str)| {
            *own == command && error.message().starts_with(&format!("unknown field `{key}`"))
        };
        if let Some((_, key, now)) = FORMER.iter().find(is_former) {
            let remedy = format!("rename it to `{now}`");
            return FieldError::new(key, "given", "absent", &remedy).in_file(file).into();
        }
        let (line, column) = position(text, error.span().map_or(0, |span| span.start));
        PlanError::Syntax {
            file: file.to_owned(),
            line,
            column,
            message: in_plain_words(text, line, error.message()),
            command,
        }
    })
}

/// A message about a value in the words of who writes it, with the field that stands on its line.
fn in_plain_words(text: &str, line: usize, message: &str) -> String {
    const TYPES: [(&str, &str); 5] = [
        ("expected f64", "expected a number, without quotes"),
        ("expected usize", "expected a whole number, without quotes"),
        ("expected u64", "expected a whole number, without quotes"),
        ("expected a sequence", "expected a list, in [ ]"),
        ("expected a boolean", "expected true or false, without quotes"),
    ];
    let Some((programmers, words)) = TYPES.iter().find(|(programmers, _)| message.ends_with(programmers)) else {
        return message.to_owned();
    };
    let field = text.lines().nth(line.saturating_sub(1)).and_then(|line| line.split_once('='));
    let field = field.map_or_else(String::new, |(field, _)| format!("`{}`: ", field.trim()));
    format!("{field}{}", message.replace(programmers, words))
}
