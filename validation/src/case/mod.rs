//! What a case is: typed parameters → independent runs → observations → metrics and figures.

mod erased;
mod error;
mod fault;
mod file;
mod parameters;
#[cfg(test)]
pub(crate) mod pendulum;
mod registry;
mod result;
mod schedule;

pub use erased::{AnyCase, Prepared};
pub use error::{ParameterError, SettingError};
pub use file::CaseFile;
pub use parameters::Changes;
pub use registry::Registry;
pub use result::{CaseResult, RunSummary};
pub use schedule::{Monitor, Silent, execute, share_out};

use crate::figure::{Animation, Figure};
use crate::metric::{Metric, Quantity, Variant};
use crate::observation::Recorded;
use serde::{Serialize, de::DeserializeOwned};

/// How much a case may cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, serde::Deserialize, clap::ValueEnum)]
#[serde(rename_all = "snake_case")]
pub enum Tier {
    /// Seconds a case.
    Quick,
    /// Minutes a case.
    Paper,
    /// As long as it takes.
    Fine,
}

impl Tier {
    /// Name on the command line and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Paper => "paper",
            Self::Fine => "fine",
        }
    }
}

impl std::fmt::Display for Tier {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str(self.name())
    }
}

/// One independent simulation of a case. Its serialised form is its identity in the store, so it
/// holds everything that the simulation depends on.
pub trait Run: Serialize + Clone + Send + Sync {
    /// Full name of the run, `key=value,…` in the case's fixed order; unique within the case.
    fn variant(&self) -> Variant;
    /// Expected cost in particle-steps, for scheduling the longest first and for the progress bar; all alike, if nothing is
    /// known.
    fn particle_steps(&self) -> f64 {
        1e6
    }
}

/// How far a run has come; called often, must be cheap.
pub trait Progress: Sync {
    /// `simulated` of `total` seconds are done, with `particle_steps` particle-steps so far.
    fn advance(&self, simulated: f64, total: f64, particle_steps: f64);
}

/// A canonical case. Implementors hold no state: everything comes from the parameters.
pub trait Case: Sync + 'static {
    /// Typed parameters; every struct refuses unknown fields. The top-level names `case` and `tier`
    /// are taken by the file format. Enums are tagged externally (serde's default), so that a file
    /// can replace one choice by another.
    type Parameters: Serialize + DeserializeOwned + Clone + Send + Sync;
    /// One independent simulation.
    type Run: Run;
    /// What a run leaves behind: plain data, stored and shared by tests and report. Stored as postcard,
    /// which needs serde's plain derive: no untagged or internally tagged enums, no `flatten`.
    type Observation: Serialize + DeserializeOwned + Send + Sync;

    /// Name on the command line and in files, kebab-case.
    fn name(&self) -> &'static str;
    /// One line for `bagnold list`.
    fn summary(&self) -> &'static str;
    /// A paragraph for the report: what is simulated and what it is judged against.
    fn description(&self) -> &'static str {
        self.summary()
    }
    /// Remarks for `bagnold show`: dotted TOML path and what stands there, with its unit.
    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }
    /// The tier's parameters.
    fn parameters(&self, tier: Tier) -> Self::Parameters;
    /// Checks ranges; the error names the field (dotted TOML path), the value, the rule and the remedy.
    ///
    /// # Errors
    /// The first field that breaks a rule.
    fn check(&self, parameters: &Self::Parameters) -> Result<(), ParameterError>;
    /// The independent simulations that these parameters ask for, in report order.
    fn runs(&self, parameters: &Self::Parameters) -> Vec<Self::Run>;
    /// Simulates one run. A divergence is part of the record, not an error.
    ///
    /// # Errors
    /// Parameters whose combination gives no valid scene.
    fn simulate(&self, run: &Self::Run, progress: &dyn Progress)
    -> Result<Recorded<Self::Observation>, ParameterError>;
    /// The quantities that its metrics are built from, each declared once; empty for a case that does not declare them.
    const QUANTITIES: &'static [Quantity] = &[];
    /// Judges the observations.
    fn metrics(
        &self,
        parameters: &Self::Parameters,
        records: &[(Self::Run, Recorded<Self::Observation>)],
    ) -> Vec<Metric>;
    /// Draws the observations.
    fn figures(
        &self,
        _parameters: &Self::Parameters,
        _records: &[(Self::Run, Recorded<Self::Observation>)],
    ) -> Vec<Figure> {
        Vec::new()
    }
    /// Moving pictures of the observations; few cases have any.
    fn animations(
        &self,
        _parameters: &Self::Parameters,
        _records: &[(Self::Run, Recorded<Self::Observation>)],
    ) -> Vec<Animation> {
        Vec::new()
    }
    /// Tables for `run`'s output folder: profiles and time series.
    fn tables(
        &self,
        _parameters: &Self::Parameters,
        _records: &[(Self::Run, Recorded<Self::Observation>)],
    ) -> Vec<crate::output::Table> {
        Vec::new()
    }
}
