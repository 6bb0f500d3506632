//! Definition of a case: typed parameters → independent runs → observations → metrics and figures.

mod flow;
mod given;
mod outcome;
#[cfg(test)]
pub(crate) mod pendulum;
mod plan;
pub mod recording;
mod shown;

pub use flow::cost::RunCost;
pub use flow::list::{ListOfRuns, NamedVariant, VariedParameter, settings_to_vary};
pub use flow::{Flow, RunList};
pub use flow::{cost, list};
pub use given::changes::Changes;
pub use given::changes::{leaves, table_of_settings, twice_given, untaken};
pub use given::error::ParameterError;
pub use given::file::CaseFile;
pub use given::output::{OUTPUT_FIELDS, OutputPlan, StateOutput};
pub use outcome::conditions::{Condition, Conditions};
pub use outcome::foreign::{
    ExternalColumn, ExternalData, ExternalObservation, ExternalResult, ExternalSchema, NamedColumns, ParticleFrame,
    RunScales,
};
pub use outcome::result::{CaseResult, RunSummary, hash_of_states};
pub use plan::erased::{AnyCase, PreparedCase};
pub use plan::estimate::{Estimate, Limits};
pub use plan::expectation::{speed_up, wall_time};
pub use plan::progress::{Monitor, Progress, Silent};
pub use plan::registry::Registry;
pub(crate) use plan::request::only;
pub use plan::request::{Request, Requested};
pub use plan::schedule::{execute, share_out};
pub use shown::features::{FeatureOption, Features};
pub use shown::tables::tables_to_add;

use crate::figure::{Animation, Figure};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::observation::Recorded;
use crate::store::CodeOrigin;
use clap::ValueEnum;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cost of a case.
#[derive(
    Debug, Default, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema, ValueEnum,
)]
#[serde(rename_all = "snake_case")]
pub enum Tier {
    /// Seconds to three minutes per case.
    #[default]
    Quick,
    /// Minutes to hours per case.
    Paper,
    /// Hours or longer per case, at the finest resolution.
    Fine,
}

impl Tier {
    /// Name on the command line and in files.
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

/// A flow and the record of its run.
pub type RecordOf<F> = (F, Recorded<<F as Flow>::Observation>);

/// A canonical case. Implementors hold no state: everything comes from the flows.
pub trait Case: Sync + 'static {
    /// Name on the command line and in files, kebab-case.
    const NAME: &'static str;
    /// One line for `bagnold list`.
    const SUMMARY: &'static str;
    /// A paragraph for the report: what is simulated and what it is judged against.
    const DESCRIPTION: &'static str = Self::SUMMARY;
    /// The quantities that its metrics are built from, each declared once; empty for a case that does not declare them.
    const QUANTITIES: &'static [Quantity] = &[];
    /// Origin of the code of the case. Leave it as it is: no hash of sources covers a case of another crate, so its
    /// results are known by the program that computed them.
    const ORIGIN: CodeOrigin = CodeOrigin::ELSEWHERE;
    /// Whether only its runs tell the axes of its figures: headings of measurements are checked behind them.
    const AXES_BY_RUNS: bool = false;
    /// Data that the case accepts for a run from an external code, besides single numbers.
    const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema::NUMBERS;
    /// Its flows.
    type Flow: Flow;

    /// Judges the observations.
    fn metrics(records: &[RecordOf<Self::Flow>]) -> Vec<Metric>;
    /// Draws the observations.
    fn figures(_: &[RecordOf<Self::Flow>]) -> Vec<Figure> {
        Vec::new()
    }
    /// Draws what the runs start from; scenes do.
    fn setup(_: &RunList<Self::Flow>) -> Option<Figure> {
        None
    }
    /// Moving pictures of the observations; few cases have any.
    fn animations(_: &[RecordOf<Self::Flow>]) -> Vec<Animation> {
        Vec::new()
    }
    /// The observation of a run from what another code gives of it; none where the case takes single numbers only.
    ///
    /// # Errors
    /// Columns that are missing beside others.
    fn from_external(
        _: &Self::Flow,
        _: &ExternalData,
    ) -> Result<Option<ExternalObservation<<Self::Flow as Flow>::Observation>>, FieldError> {
        Ok(None)
    }
    /// Tables for `run`'s output folder: profiles and time series.
    fn tables(_: &[RecordOf<Self::Flow>]) -> Vec<crate::output::Table> {
        Vec::new()
    }
}
