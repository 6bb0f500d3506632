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
pub use given::changes::{table_of_settings, twice_given};
pub use given::error::{ParameterError, SettingError};
pub use given::file::CaseFile;
pub use given::output::{OUTPUT_FIELDS, OutputPlan, StateOutput};
pub use outcome::conditions::{Condition, Conditions};
pub use outcome::foreign::{
    ExternalColumn, ExternalData, ExternalObservation, ExternalResult, ExternalSchema, NamedColumns, ParticleFrame,
    RunScales,
};
pub use outcome::result::{CaseResult, RunSummary};
pub use plan::erased::{AnyCase, PreparedCase};
pub use plan::estimate::{Estimate, Limits};
pub use plan::expectation::{speed_up, wall_time};
pub use plan::registry::Registry;
pub(crate) use plan::request::only;
pub use plan::request::{Request, Requested};
pub use plan::schedule::{Monitor, Silent, execute, share_out, share_out_for};
pub use shown::features::{FeatureOption, Features};
pub use shown::tables::tables_to_add;

use crate::checkpoint::Checkpoints;
use crate::figure::{Animation, Figure};
use crate::input::FieldError;
use crate::metric::{FlowRegime, Metric, Quantity, Variant};
use crate::observation::Recorded;
use crate::store::CodeOrigin;
use bagnold_solver::material::rheology::Rheology;
use schemars::JsonSchema;
use serde::{Serialize, de::DeserializeOwned};
use std::sync::OnceLock;

/// Cost of a case.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, serde::Deserialize, JsonSchema, clap::ValueEnum,
)]
#[serde(rename_all = "snake_case")]
pub enum Tier {
    /// Seconds to three minutes per case.
    Quick,
    /// Minutes to hours per case.
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

/// The parameters of a case, each declared once: a field with its doc comment, unit and range (`bagnold_solver::parameter`).
/// The top-level names `case` and `tier` are taken by the file format.
pub trait Parameters: Serialize + DeserializeOwned + JsonSchema + Clone + Send + Sync + 'static {
    /// One independent simulation.
    type Run: Run;
    /// Lists that a file states whole: one that it leaves out is empty there, and not the tier's. Those of the second kind say which
    /// runs there are; a file without a field is the case as it comes, with all of its runs.
    const STATED: [&'static [&'static str]; 2] = [&[], &[]];

    /// A tier's parameters.
    fn of_tier(tier: Tier) -> Self;
    /// The rules between fields; called once every field is in its own range.
    ///
    /// # Errors
    /// The first field that breaks a rule, by its dotted TOML path.
    fn check(&self) -> Result<(), ParameterError> {
        Ok(())
    }
    /// The rules that concern some runs only; `runs` are those that are to be simulated, all or those that the user has
    /// chosen. Called after [`Self::check`]; until then [`Self::runs`] must not panic.
    ///
    /// # Errors
    /// The first field that breaks a rule of one of these runs, by its dotted TOML path.
    fn check_runs(&self, _runs: &[&Self::Run]) -> Result<(), ParameterError> {
        Ok(())
    }
    /// Warnings of values that are possible but unlikely; asked of parameters that hold.
    fn doubts(&self) -> Vec<String> {
        Vec::new()
    }
    /// The rules between fields and those of every run.
    ///
    /// # Errors
    /// The first field that breaks a rule, by its dotted TOML path.
    fn check_all(&self) -> Result<(), ParameterError> {
        self.check()?;
        let runs = self.runs();
        self.check_runs(&runs.iter().collect::<Vec<_>>())
    }
    /// The parameters of a table whose fields are sound.
    ///
    /// # Errors
    /// What no schema can tell, such as a place in a list of runs that breaks a rule.
    fn of_table(case: &str, table: toml::Table) -> Result<Self, ParameterError> {
        given::changes::typed(case, table)
    }
    /// Keys that tell a run apart from others with its own name.
    fn label(&self, _run: &Self::Run) -> Variant {
        Variant::default()
    }
    /// Full name of a run.
    fn variant_of(&self, run: &Self::Run) -> Variant {
        run.variant().followed_by(&self.label(run))
    }
    /// The independent simulations that these parameters ask for, in report order.
    fn runs(&self) -> Vec<Self::Run>;
    /// The field that takes the place of one of earlier files.
    fn field_now(_: &str) -> Option<String> {
        None
    }
    /// Makes the values at these paths those of all runs, whatever the list of runs says of them.
    fn set_for_all(_: &mut toml::Table, _: &[String]) {}
}

/// One independent simulation of a case. Its serialised form is its identity in the store, so it
/// holds everything that the simulation depends on.
pub trait Run: Serialize + Clone + Send + Sync {
    /// Observation that the run produces: plain data, stored and shared by tests and report. Stored as postcard, which
    /// needs serde's plain derive: no untagged or internally tagged enums, no `flatten`.
    type Observation: Serialize + DeserializeOwned + Send + Sync;

    /// Full name of the run, `key=value,…` in the case's fixed order; unique within the case.
    fn variant(&self) -> Variant;
    /// Expected cost in particle-steps, for scheduling the longest first and for the progress bar; all alike, if nothing is
    /// known.
    fn particle_steps(&self) -> f64 {
        1e6
    }
    /// Particles, or cells, that it holds at once `[-]`: what its memory is estimated from. 0, if nothing is known.
    fn particles(&self) -> f64 {
        0.0
    }
    /// Time of a particle-step on one core `[s]`, for estimates: that of the weakly compressible model, unless a case tells.
    fn seconds_per_particle_step(&self) -> f64 {
        cost::WEAKLY_COMPRESSIBLE
    }
    /// Time of one core before the first step `[s]`: nothing, unless a case tells.
    fn preparation_seconds(&self) -> f64 {
        0.0
    }
    /// Expected resources.
    fn cost(&self) -> RunCost {
        RunCost {
            particle_steps: self.particle_steps(),
            seconds_per_particle_step: self.seconds_per_particle_step(),
            preparation_seconds: self.preparation_seconds(),
            ..RunCost::weakly_compressible(self.particles(), 0.0)
        }
    }
    /// The regime of the flow that it leaves behind; nothing, unless a case tells.
    fn regime(&self, _: &Self::Observation) -> FlowRegime {
        FlowRegime::default()
    }
    /// Scales r_0 and t_0 of columns that another code gives; none, unless a case tells.
    fn scales(&self) -> Option<RunScales> {
        None
    }
    /// Constitutive laws of its scene that its own fields do not name, because they hold a law's numbers alone.
    fn laws(&self) -> Vec<Rheology> {
        Vec::new()
    }
    /// One line on the run before it starts, for the terminal; nothing, unless a case tells.
    fn brief(&self) -> Option<String> {
        None
    }
    /// The run without its end, equal for runs of which one continues the other; none if a longer run begins anew.
    fn trajectory(&self) -> Option<Self> {
        None
    }
    /// Simulates it. A divergence is part of the record, not an error.
    ///
    /// # Errors
    /// Parameters whose combination gives no valid scene.
    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<Self::Observation>, ParameterError>;
}

/// Progress of a run; called often, must be cheap.
pub trait Progress: Sync {
    /// `simulated` of `total` seconds are done, with `particle_steps` particle-steps so far.
    fn advance(&self, simulated: f64, total: f64, particle_steps: f64);
    /// News of the run for its user: where it resumes, or why it begins anew.
    fn tell(&self, news: &str);
    /// Checkpoints of the run; none if nothing is kept.
    fn checkpoints(&self) -> Option<&Checkpoints> {
        None
    }
    /// States near the end of finished runs that this one may continue, and the place of its own; none if nothing is kept.
    fn ends(&self) -> Option<&Checkpoints> {
        None
    }
    /// Place for boundaries and start of the run, which then ends before its first step; none for a run that is simulated.
    fn conditions(&self) -> Option<&OnceLock<Conditions>> {
        None
    }
    /// Receiver of states during the run; none if no states are requested.
    fn output(&self) -> Option<&dyn StateOutput> {
        None
    }
}

/// A run of a case with these parameters.
pub type RunOf<P> = <P as Parameters>::Run;

/// Observation that a run of a case with these parameters produces.
pub type ObservationOf<P> = <RunOf<P> as Run>::Observation;

/// A run with what it left behind.
pub type RecordOf<P> = (RunOf<P>, Recorded<ObservationOf<P>>);

/// A canonical case. Implementors hold no state: everything comes from the parameters.
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
    /// Data that the case accepts for a run from an external code, besides single numbers.
    const EXTERNAL_SCHEMA: ExternalSchema = ExternalSchema::NUMBERS;
    /// Typed parameters.
    type Parameters: Parameters;

    /// Judges the observations.
    fn metrics(parameters: &Self::Parameters, records: &[RecordOf<Self::Parameters>]) -> Vec<Metric>;
    /// Draws the observations.
    fn figures(_: &Self::Parameters, _: &[RecordOf<Self::Parameters>]) -> Vec<Figure> {
        Vec::new()
    }
    /// Draws what the runs start from; scenes do.
    fn setup(_: &Self::Parameters) -> Option<Figure> {
        None
    }
    /// Moving pictures of the observations; few cases have any.
    fn animations(_: &Self::Parameters, _: &[RecordOf<Self::Parameters>]) -> Vec<Animation> {
        Vec::new()
    }
    /// The observation of a run from what another code gives of it; none where the case takes single numbers only.
    ///
    /// # Errors
    /// Columns that are missing beside others.
    fn from_external(
        _: &RunOf<Self::Parameters>,
        _: &ExternalData,
    ) -> Result<Option<ExternalObservation<ObservationOf<Self::Parameters>>>, FieldError> {
        Ok(None)
    }
    /// Tables for `run`'s output folder: profiles and time series.
    fn tables(_: &Self::Parameters, _: &[RecordOf<Self::Parameters>]) -> Vec<crate::output::Table> {
        Vec::new()
    }
}
