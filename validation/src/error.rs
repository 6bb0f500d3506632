//! Errors that a user's input can cause: each names file, field, value, rule and remedy.

use std::path::{Path, PathBuf};

/// Bad input. The program prints it and ends with exit code 2.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// A field holds a value that breaks a rule; cases build it with [`InputError::field`].
    #[error("{}`{field}` is {value}, but must be {rule}; {remedy}", origin(.file))]
    Field {
        /// File it stands in, where known; the loader adds it.
        file: Option<PathBuf>,
        /// Dotted TOML path.
        field: String,
        /// The offending value as written.
        value: String,
        /// The rule it breaks, completing "must be …".
        rule: String,
        /// What to do about it.
        remedy: String,
    },
    /// The parameters are each in range, but together give no valid scene.
    #[error("the parameters give no valid scene: {0}")]
    Scene(#[from] bagnold_solver::run::SceneError),
    /// The parameters ask for no simulation, so no gate could fail.
    #[error(
        "the parameters of `{case}` ask for no run; fill at least one of its lists, `bagnold show {case}` prints them"
    )]
    NothingToRun {
        /// The case.
        case: String,
    },
    /// The committed baseline or list of known failures cannot be used.
    #[error("failed to {0}; correct the file or restore it from version control")]
    Baseline(#[from] crate::report::BaselineError),
    /// A report cannot be written.
    #[error("failed to {0}; check the folder and its permissions")]
    Report(#[from] crate::report::ReportError),
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
    #[error("{}`{field}` is missing; `bagnold show {case}` prints it with a valid value", origin(.file))]
    MissingField {
        /// File that lacks it, where known.
        file: Option<PathBuf>,
        /// Dotted TOML path.
        field: String,
        /// Whose parameters they are.
        case: String,
    },
    /// A file is not TOML.
    #[error("{}: line {line}, column {column}: {message}; correct the TOML syntax there", .file.display())]
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
    /// A plan is not TOML, or not one of its command.
    #[error("{}: line {line}, column {column}: {message}; `bagnold {command} --help` shows a plan", .file.display())]
    Plan {
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
    /// A file does not say whose parameters it holds.
    #[error("{}: `case` is missing, but must name the case that the file describes; add `case = \"…\"` (`bagnold list` prints the names)", .file.display())]
    NoCase {
        /// The file.
        file: PathBuf,
    },
    /// No case has this name.
    #[error("{}unknown case `{name}`; {}`bagnold list` prints all cases", origin(.file), did_you_mean(.nearest))]
    UnknownCase {
        /// File that names it, if it was not the command line.
        file: Option<PathBuf>,
        /// The name asked for.
        name: String,
        /// The case whose name is nearest.
        nearest: Option<String>,
    },
    /// A file cannot be read.
    #[error("{}: cannot be read ({reason}); check the path and its permissions", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// `--set` without `=`.
    #[error("`--set {argument}` must have the form path=value; for example `--set {example}`")]
    SetForm {
        /// The argument as given.
        argument: String,
        /// A valid one for this case.
        example: String,
    },
    /// `--set` names a path that the case's parameters do not have.
    #[error("`--set {path}={value}`: unknown field `{path}`; {}`bagnold show {case}` prints all fields", did_you_mean(.nearest))]
    SetPath {
        /// The dotted path as given.
        path: String,
        /// The value as given.
        value: String,
        /// The existing path that is nearest.
        nearest: Option<String>,
        /// Whose parameters they are.
        case: String,
    },
    /// A plan names a path that a case's parameters do not have.
    #[error("{}: `path` is `{path}`, but `{case}` has no such field; {}`bagnold show {case}` prints all fields", .file.display(), did_you_mean(.nearest))]
    PlanPath {
        /// The plan.
        file: PathBuf,
        /// The dotted path as given.
        path: String,
        /// The existing path that is nearest.
        nearest: Option<String>,
        /// Whose parameters they are.
        case: String,
    },
    /// `--set` gives a value of the wrong type.
    #[error("`--set {path}={value}`: `{path}` is {value}, but must be {rule}; {remedy}")]
    SetValue {
        /// The dotted path as given.
        path: String,
        /// The value as given.
        value: String,
        /// The rule it breaks, completing "must be …".
        rule: String,
        /// What to do about it.
        remedy: String,
    },
    /// A folder holds work that may be continued.
    #[error("{}: holds a {what} already; add --resume to go on with it, or name another folder with --out", .folder.display())]
    InUse {
        /// A sweep or a calibration.
        what: &'static str,
        /// The folder.
        folder: PathBuf,
    },
    /// A folder holds other work than what is asked for.
    #[error("{}: holds a {what} {}; name another folder with --out", .folder.display(), if *.by_program { "of another version of bagnold, whose numbers may differ" } else { "of another plan" })]
    OtherPlan {
        /// A sweep or a calibration.
        what: &'static str,
        /// The folder.
        folder: PathBuf,
        /// Whether the program differs, not the plan.
        by_program: bool,
    },
    /// A file of reference data cannot be used.
    #[error("failed to {0}")]
    Reference(#[from] crate::reference::ReferenceError),
    /// A run is fitted and held out.
    #[error("{}: the run `{run}` is in both `{fit}` and `{hold_out}`; what is predicted must not be fitted, so take it out of one", .file.display())]
    InBoth {
        /// The plan.
        file: PathBuf,
        /// The run.
        run: String,
        /// Where it is fitted.
        fit: String,
        /// Where it is held out.
        hold_out: String,
    },
    /// Data have no counterpart in what a case computes.
    #[error("{}: `{field}`: the case gives {reason}", .file.display())]
    Counterpart {
        /// The plan.
        file: PathBuf,
        /// The group of data.
        field: String,
        /// What is missing, and what there is.
        reason: String,
    },
    /// A search cannot begin or has found nothing.
    #[error("{}: {reason}", .file.display())]
    Search {
        /// The plan.
        file: PathBuf,
        /// Why.
        reason: String,
    },
    /// A folder holds no sweep.
    #[error("{}: holds no sweep (no manifest.json); name the folder that `bagnold sweep` wrote", .folder.display())]
    NoSweep {
        /// The folder.
        folder: PathBuf,
    },
    /// A file of ours cannot be understood.
    #[error("{}: damaged ({reason}); {remedy}", .file.display())]
    Damaged {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        reason: String,
        /// What to do about it.
        remedy: String,
    },
    /// A command of the scheduler is missing or refuses.
    #[error("slurm: `{command}` {reason}; {remedy}")]
    Slurm {
        /// The command.
        command: String,
        /// What happened.
        reason: String,
        /// What to do about it.
        remedy: String,
    },
    /// The output folder holds files that are not Bagnold's.
    #[error("output folder {}: not empty and not written by bagnold, so nothing was changed; name an empty or new folder with --out", .folder.display())]
    ForeignFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// Files cannot be written.
    #[error("{}: cannot be written ({reason}); choose a folder that you may write to with --out", .path.display())]
    Unwritable {
        /// File or folder.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// The thread pool cannot be built.
    #[error("`--threads {threads}` cannot be started ({reason}); ask for fewer threads")]
    Threads {
        /// Number of threads asked for.
        threads: usize,
        /// The system's reason.
        reason: String,
    },
}

impl InputError {
    /// A parameter that breaks a rule: "`field` is `value`, but must be `rule`; `remedy`".
    #[must_use]
    pub fn field(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        Self::Field {
            file: None,
            field: field.to_owned(),
            value: value.to_string(),
            rule: rule.to_owned(),
            remedy: remedy.to_owned(),
        }
    }

    /// Says that the parameter at fault is part of a group of parameters.
    #[must_use]
    pub fn within(mut self, group: &str) -> Self {
        if let Self::Field { field, .. } = &mut self {
            *field = format!("{group}.{field}");
        }
        self
    }

    /// Types a plan's text; `command` is the one whose help shows a valid plan.
    ///
    /// # Errors
    /// A text that is not TOML or does not have the type's fields, with the place.
    pub fn parse_plan<T: serde::de::DeserializeOwned>(
        file: &Path,
        text: &str,
        command: &'static str,
    ) -> Result<T, Self> {
        toml::from_str(text).map_err(|error| {
            let (line, column) = crate::case::position(text, error.span().map_or(0, |span| span.start));
            Self::Plan { file: file.to_owned(), line, column, message: error.message().to_owned(), command }
        })
    }

    /// A file that cannot be read, with the system's reason.
    #[must_use]
    pub fn unreadable(file: &Path, error: &std::io::Error) -> Self {
        Self::Unreadable { file: file.to_owned(), reason: reason(error) }
    }

    /// A file or folder that cannot be written, with the system's reason.
    #[must_use]
    pub fn unwritable(path: &Path, error: &std::io::Error) -> Self {
        Self::Unwritable { path: path.to_owned(), reason: reason(error) }
    }

    /// The dotted path of the parameter at fault, if the error is about one.
    #[must_use]
    pub fn field_path(&self) -> Option<&str> {
        match self {
            Self::Field { field, .. } | Self::UnknownField { field, .. } | Self::MissingField { field, .. } => {
                Some(field)
            }
            _ => None,
        }
    }

    /// Puts what is wrong with a setting into the words of the plan that asks for it.
    #[must_use]
    pub fn in_plan(self, plan: &Path) -> Self {
        match self {
            Self::SetPath { path, nearest, case, .. } => Self::PlanPath { file: plan.to_owned(), path, nearest, case },
            Self::SetValue { path, value, rule, remedy } => {
                Self::Field { file: Some(plan.to_owned()), field: path, value, rule, remedy }
            }
            other => other.in_file(plan),
        }
    }

    /// Says in which file the parameter at fault stands, unless that is already known.
    #[must_use]
    pub fn in_file(mut self, path: &Path) -> Self {
        if let Self::Field { file, .. }
        | Self::UnknownField { file, .. }
        | Self::MissingField { file, .. }
        | Self::UnknownCase { file, .. } = &mut self
        {
            file.get_or_insert_with(|| path.to_owned());
        }
        self
    }
}

/// The name that is most like `name`, if any is like it at all.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    // Jaro–Winkler forgives a wrong tail and swapped letters; below 0.7 a suggestion would be a guess.
    known
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(likeness, _)| *likeness >= 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate.to_owned())
}

fn origin(file: &Option<PathBuf>) -> String {
    file.as_ref().map_or_else(String::new, |file| format!("{}: ", file.display()))
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!("did you mean `{name}`? "))
}

/// The system's words without the error number, which means nothing to a reader: "permission denied".
fn reason(error: &std::io::Error) -> String {
    let text = error.to_string();
    let words = text.split(" (os error").next().unwrap_or(&text);
    let mut letters = words.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}
