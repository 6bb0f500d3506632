//! Errors in the parameters of a case.

use crate::input::{FieldError, Origin, before, did_you_mean};
use crate::output::FileError;
use std::path::Path;

/// Parameters that a case does not take, or a plan that cannot be followed; cases build the commonest with [`ParameterError::field`].
#[derive(Debug, thiserror::Error)]
pub enum ParameterError {
    /// A field holds a value that breaks a rule.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// An error that names no field of the user's.
    #[error("{}{error}; changed from the tier's defaults: {changed}", before(origin))]
    Changed {
        /// File of the user's, where there is one.
        origin: Option<Origin>,
        /// Error of the changed parameters together.
        error: Box<ParameterError>,
        /// The fields that the user has changed, with their values.
        changed: String,
    },
    /// The parameters are each in range, but together give no valid scene.
    #[error("the parameters give no valid scene: {0}")]
    Scene(#[from] bagnold_solver::run::SceneError),
    /// A file cannot be read.
    #[error(transparent)]
    File(#[from] FileError),
    /// A signal has asked the program to end; what the run has come to is kept where it can be.
    #[error("interrupted before the run was finished")]
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

impl ParameterError {
    /// A parameter that breaks a rule: "`field` is `value`, but must be `rule`; `remedy`".
    pub fn field(field: &str, value: impl std::fmt::Display, rule: &str, remedy: &str) -> Self {
        Self::Field(FieldError::new(field, value, rule, remedy))
    }

    /// No case has this name; the error suggests the nearest one.
    pub fn unknown_case(name: &str, nearest: &Option<String>) -> Self {
        let is_file = Path::new(name).extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        let meant = did_you_mean(nearest);
        let instead = if is_file { "run a file with `bagnold run`; " } else { meant.as_str() };
        FieldError::finding(name, "unknown case", &format!("{instead}`bagnold list` prints all cases")).into()
    }

    /// Marks the parameter at fault as part of a group of parameters.
    #[must_use]
    pub fn within(self, group: &str) -> Self {
        if let Self::Field(error) = self { Self::Field(error.within(group)) } else { self }
    }

    /// The place in a plan of what only a plan's block says: which runs are meant.
    pub fn of_block(self, block: &str) -> Self {
        if self.field_path() == Some("only") { self.within(block) } else { self }
    }

    /// The dotted path of the parameter at fault, if the error is about one.
    pub fn field_path(&self) -> Option<&str> {
        if let Self::Field(error) = self { Some(&error.field) } else { None }
    }

    /// Whether a `--set` has the wrong form, path or type, whatever the other parameters are.
    pub fn is_of_setting(&self) -> bool {
        matches!(self, Self::Field(FieldError { origin: Some(Origin::Setting(_)), .. }))
    }

    /// Names the case of a report that refuses a setting.
    pub fn in_case(mut self, case: &str) -> Self {
        if let Self::Field(FieldError { remedy, .. }) = &mut self {
            *remedy = format!("{remedy} (refused by the case {case}; --cases can leave it out)").into();
        }
        self
    }

    /// Marks the error: no case of the report has the field.
    pub fn in_no_case(mut self) -> Self {
        if let Self::Field(FieldError { value, .. }) = &mut self {
            "no case of this report has this field".clone_into(value);
        }
        self
    }

    /// Adds the file of the parameter at fault, unless it is already known.
    pub fn in_file(mut self, path: &Path) -> Self {
        if let Self::Field(FieldError { origin, .. }) | Self::Changed { origin, .. } = &mut self {
            origin.get_or_insert_with(|| Origin::File(path.to_owned()));
        }
        self
    }

    /// Adds the file of the parameter at fault, if a file gives it.
    pub(in crate::case) fn given_in(self, file: Option<&Path>) -> Self {
        if let Some(file) = file { self.in_file(file) } else { self }
    }

    /// Adds the plan file that contains the field; settings of a plan are its values.
    pub fn in_plan(mut self, plan: &Path) -> Self {
        if let Self::Field(FieldError { origin: origin @ Some(Origin::Setting(_)), .. }) = &mut self {
            *origin = None;
        }
        self.in_file(plan)
    }
}
