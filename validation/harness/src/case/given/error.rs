//! Errors in the parameters of a case.

use crate::input::{FieldError, did_you_mean, origin, shown};
use crate::output::FileError;
use std::path::{Path, PathBuf};

/// Parameters that a case does not take; cases build the commonest with [`ParameterError::field`].
#[derive(Debug, thiserror::Error)]
pub enum ParameterError {
    /// A field holds a value that breaks a rule.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// A field of the user's leads to an error about another one.
    #[error("{}`{field}` is {value}, and so {error}", origin(.file))]
    Follows {
        /// File it stands in, where known.
        file: Option<PathBuf>,
        /// Dotted TOML path.
        field: String,
        /// Its value.
        value: String,
        /// Error that follows from this value.
        error: Box<ParameterError>,
    },
    /// An error that names no field of the user's.
    #[error("{}{error}; what differs from the tier: {changed}", origin(.file))]
    Changed {
        /// File of the user's, where there is one.
        file: Option<PathBuf>,
        /// The error.
        error: Box<ParameterError>,
        /// The fields that the user has changed, with their values.
        changed: String,
    },
    /// The parameters are each in range, but together give no valid scene.
    #[error("the parameters give no valid scene: {0}")]
    Scene(#[from] bagnold_solver::run::SceneError),
    /// A file names a field that the case does not have.
    #[error("{}unknown field `{field}`; {}`bagnold show {case}` prints all fields", origin(.file), did_you_mean(.nearest))]
    UnknownField {
        /// File it stands in, where known.
        file: Option<PathBuf>,
        /// Dotted TOML path.
        field: String,
        /// The known field whose name is nearest, as a dotted path.
        nearest: Option<String>,
        /// Whose parameters they are.
        case: String,
    },
    /// A field without a default is absent.
    #[error("{}`{field}` is missing; {remedy}", origin(.file))]
    MissingField {
        /// File that lacks it, where known.
        file: Option<PathBuf>,
        /// Dotted TOML path.
        field: String,
        /// Remedy: the command that prints or explains the values of the field.
        remedy: String,
    },
    /// A file is not TOML.
    #[error("{}: line {line}, column {column}: {message}; correct the TOML syntax there", shown(.file))]
    Syntax {
        /// The file.
        file: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// The parser's words.
        message: String,
    },
    /// A file does not say whose parameters it holds.
    #[error("{}: `case` is missing, but must name the case that the file describes; add `case = \"…\"` (`bagnold list` prints the names)", shown(.file))]
    NoCase {
        /// The file.
        file: PathBuf,
    },
    /// No case has this name.
    #[error("{}unknown case `{name}`; {}`bagnold list` prints all cases", origin(.file), instead(.name, .nearest))]
    UnknownCase {
        /// File that names it, if it was not the command line.
        file: Option<PathBuf>,
        /// The name asked for.
        name: String,
        /// The case whose name is nearest.
        nearest: Option<String>,
    },
    /// A `--set` is refused.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The case's file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A canonical study is refused: a check names what its runs do not give.
    #[error("{0}")]
    Study(String),
    /// A signal has asked the program to end; what the run has come to is kept where it can be.
    #[error("interrupted before it was done")]
    Interrupted,
    /// The thread pool cannot be built.
    #[error("`--threads {threads}` cannot be started ({reason}); ask for fewer threads")]
    Threads {
        /// Number of threads asked for.
        threads: usize,
        /// The system's reason.
        reason: String,
    },
}

/// A `--set path=value` that does not fit a case's parameters.
#[derive(Debug, thiserror::Error)]
pub enum SettingError {
    /// It has no `=`.
    #[error("`--set {argument}` must have the form path=value; for example `--set {example}`")]
    Form {
        /// The argument as given.
        argument: String,
        /// A valid one for this case.
        example: String,
    },
    /// It names a path that the case's parameters do not have.
    #[error("`--set {path}={value}`: unknown field `{path}`; {}`bagnold show {case}` prints all fields", did_you_mean(.nearest))]
    Path {
        /// The dotted path as given.
        path: String,
        /// The value as given.
        value: String,
        /// The existing path that is nearest.
        nearest: Option<String>,
        /// Whose parameters they are.
        case: String,
    },
    /// It gives a field that an earlier one gives.
    #[error("`--set {path}={value}`: `{field}` is given twice, first by `--set {earlier}`; give each field once")]
    Twice {
        /// The dotted path as given.
        path: String,
        /// The value as given.
        value: String,
        /// The field that both give.
        field: String,
        /// The earlier argument.
        earlier: String,
    },
    /// It gives a value of the wrong type.
    #[error("`--set {path}={value}`: `{path}` is {value}, but must be {rule}; {remedy}")]
    Value {
        /// The dotted path as given.
        path: String,
        /// The value as given.
        value: String,
        /// The rule it breaks, completing "must be …".
        rule: String,
        /// Remedy.
        remedy: String,
    },
}

/// What was meant by the name of a case that does not exist.
fn instead(name: &str, nearest: &Option<String>) -> String {
    let is_file = Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    if is_file { "that is a file, which `bagnold run` reads; ".to_owned() } else { did_you_mean(nearest) }
}

impl ParameterError {
    /// A parameter that breaks a rule: "`field` is `value`, but must be `rule`; `remedy`".
    #[must_use]
    pub fn field(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        Self::Field(FieldError::new(field, value, rule, remedy))
    }

    /// Says that the parameter at fault is part of a group of parameters.
    #[must_use]
    pub fn within(self, group: &str) -> Self {
        match self {
            Self::Field(error) => Self::Field(error.within(group)),
            other => other,
        }
    }

    /// The place in a plan of what only a plan's block says: which runs are meant.
    #[must_use]
    pub fn of_block(self, block: &str) -> Self {
        if self.field_path() == Some("only") { self.within(block) } else { self }
    }

    /// The dotted path of the parameter at fault, if the error is about one.
    #[must_use]
    pub fn field_path(&self) -> Option<&str> {
        match self {
            Self::Field(FieldError { field, .. })
            | Self::UnknownField { field, .. }
            | Self::MissingField { field, .. }
            | Self::Follows { field, .. } => Some(field),
            _ => None,
        }
    }

    /// Says in which file the parameter at fault stands, unless that is already known.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        if let Self::Field(FieldError { file, .. })
        | Self::UnknownField { file, .. }
        | Self::MissingField { file, .. }
        | Self::Follows { file, .. }
        | Self::Changed { file, .. }
        | Self::UnknownCase { file, .. } = &mut self
        {
            file.get_or_insert_with(|| path.to_owned());
        }
        self
    }
}
