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
pub use plan::schedule::{execute, pool, share_out};
pub use shown::features::{FeatureOption, Features};
pub use shown::tables::tables_to_add;

use crate::figure::{Animation, Figure};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::observation::Recorded;
use crate::output::Table;
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

/// From records to metrics.
pub type Judge<F> = fn(&[RecordOf<F>]) -> Vec<Metric>;
/// From records to figures.
pub type DrawFigures<F> = fn(&[RecordOf<F>]) -> Vec<Figure>;
/// From records to moving pictures.
pub type Animate<F> = fn(&[RecordOf<F>]) -> Vec<Animation>;
/// From records to tables.
pub type Tabulate<F> = fn(&[RecordOf<F>]) -> Vec<Table>;
/// From the runs of a list to a drawing of their starts.
pub type Setup<F> = fn(&RunList<F>) -> Option<Figure>;
/// From what another code gives of a run to an observation; columns that are missing beside others are an error.
pub type FromExternal<F> =
    fn(&F, &ExternalData) -> Result<Option<ExternalObservation<<F as Flow>::Observation>>, FieldError>;

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
    /// Axes of figures that are there behind the runs only.
    const AXES_OF_RUNS: &'static [[&'static str; 2]] = &[];
    /// Data that the case accepts for a run from an external code, besides single numbers.
    const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema::NUMBERS;
    /// Flows.
    type Flow: Flow;

    /// Judges the observations.
    const METRICS: Judge<Self::Flow>;
    /// Draws the observations.
    const FIGURES: DrawFigures<Self::Flow> = |_| Vec::new();
    /// Draws what the runs start from; scenes do.
    const SETUP: Setup<Self::Flow> = |_| None;
    /// Moving pictures of the observations; few cases have any.
    const ANIMATIONS: Animate<Self::Flow> = |_| Vec::new();
    /// The observation of a run from what another code gives of it; none where the case takes single numbers only.
    const FROM_EXTERNAL: FromExternal<Self::Flow> = |_, _| Ok(None);
    /// Tables for `run`'s output folder: profiles and time series.
    const TABLES: Tabulate<Self::Flow> = |_| Vec::new();
}
