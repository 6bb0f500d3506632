//! Cases without their types: what the command line, the report and the tests work with.

use super::guard::{Guard, with_changed};
use crate::case::given::changes::{Changes, ParameterSource, table_of};
use crate::case::given::error::ParameterError;
use crate::case::outcome::causes::explained;
use crate::case::outcome::finite::{fail_broken_profiles, fail_diverged};
use crate::case::outcome::foreign::ExternalResult;
use crate::case::outcome::result::{CaseResult, RunSummary, hash_of_states, microseconds_each};
use crate::case::shown::{notes::notes, schema};
use crate::case::{
    Case, CaseFile, Conditions, Estimate, ExternalData, ExternalSchema, Flow, Progress, RecordOf, RunList, RunScales,
    Tier, tables_to_add,
};
use crate::checkpoint::{Checkpoints, is_interrupted};
use crate::control::{self, Control};
use crate::evidence::completed;
use crate::figure::{Axis, Figure, Panel};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity, Variant};
use crate::observation::Recorded;
use crate::output::Table;
use crate::statistics::grouped;
use crate::store::{CodeOrigin, Store};
use bagnold_solver::parameter::schema_of;
use std::path::PathBuf;
use std::sync::OnceLock;

/// A case whose types are hidden; every [`Case`] is one.
pub trait AnyCase: Sync {
    /// Name on the command line and in files.
    fn name(&self) -> &'static str;
    /// One line for `bagnold list`.
    fn summary(&self) -> &'static str;
    /// Setup, and what is judged, in prose.
    fn description(&self) -> &str;
    /// Quantities from which the metrics of the case are built; empty if the case does not declare them.
    fn quantities(&self) -> &'static [Quantity] {
        &[]
    }
    /// Origin of the code of the case: these packages or another crate.
    fn origin(&self) -> CodeOrigin;
    /// Whether it is a canonical study: runs of other cases under checks of its own.
    fn is_study(&self) -> bool {
        false
    }
    /// Wrong physics and wrong inputs that its gates are to reject.
    fn controls(&self) -> Vec<Control> {
        control::of_case(self.name())
    }
    /// The tier's parameters as a complete, commented file for `bagnold run`.
    fn show(&self, tier: Tier) -> String;
    /// The JSON Schema (2020-12) of a case file, with the tier's parameters as defaults.
    fn schema(&self, tier: Tier) -> serde_json::Value;
    /// The schema of its parameters, as their type has it.
    fn parameter_schema(&self) -> &'static serde_json::Value;
    /// Columns that the case accepts from an external code for a run, besides single numbers.
    fn form(&self) -> &'static ExternalSchema {
        &ExternalSchema::NUMBERS
    }
    /// Types and checks a tier's parameters with the user's changes.
    ///
    /// # Errors
    /// The first field that is unknown, of the wrong type, or breaks a rule.
    fn prepare(&'static self, tier: Tier, changes: &Changes<'_>) -> Result<Box<dyn PreparedCase>, ParameterError>;
}

/// Checked parameters and the runs that they ask for; each run's record is kept as it comes in.
pub trait PreparedCase: Send + Sync {
    /// Name of the case.
    fn name(&self) -> &'static str;
    /// Origin of the code of the case: these packages or another crate.
    fn origin(&self) -> CodeOrigin;
    /// The parameters: a complete file for `bagnold run`.
    fn parameters_toml(&self) -> &str;
    /// Drawing of the initial state of the runs; none for a case that does not draw it.
    fn setup(&self) -> Option<Figure>;
    /// Number of runs.
    fn run_count(&self) -> usize;
    /// Full name of a run; empty where the case has a single one.
    fn variant(&self, run: usize) -> Variant;
    /// Everything that a run depends on, by the names of its fields; null if it cannot be written as JSON.
    fn run_parameters(&self, run: usize) -> serde_json::Value;
    /// Estimated resources of a run.
    fn estimate(&self, run: usize) -> Estimate;
    /// Estimated resources of all runs together.
    fn estimate_of_all(&self) -> Estimate {
        (0..self.run_count()).map(|run| self.estimate(run)).fold(Estimate::default(), Estimate::and)
    }
    /// One line on each run that has something to tell before it starts.
    fn briefs(&self) -> Vec<String>;
    /// Key of a run in a store, equal for identical simulations; none if the store is bypassed.
    fn identity(&self, run: usize, store: &Store) -> Option<String>;
    /// File of the newest state near the end of a run that a store keeps; none where it keeps none.
    fn kept_state(&self, run: usize, store: &Store) -> Option<PathBuf>;
    /// Takes a run's record from the store or simulates it, in the current rayon pool.
    ///
    /// # Errors
    /// Parameters whose combination gives no valid scene.
    fn simulate(&self, run: usize, store: &Store, progress: &Progress) -> Result<(), ParameterError>;
    /// Scales of a run, in which another code may give its columns.
    fn scales(&self, _run: usize) -> Option<RunScales> {
        None
    }
    /// The same with some of its runs only, in this order.
    fn choose(self: Box<Self>, runs: &[usize]) -> Box<dyn PreparedCase>;
    /// Judges and draws what another code gives, a run each; those of which it gives no files are left out.
    ///
    /// # Errors
    /// Columns that are missing beside others, of the run of that number.
    fn judge_external(&self, _given: &[ExternalData]) -> Result<ExternalResult, (usize, FieldError)> {
        Ok(ExternalResult::default())
    }
    /// Limits and references of runs of which another code gives nothing yet; empty where the case takes single numbers only.
    fn asked(&self) -> ExternalResult {
        ExternalResult::default()
    }
    /// Tables and figures with the headings and axes of the runs' before these are simulated; none for a case that does not tell.
    fn outline(&self) -> Option<CaseResult> {
        None
    }
    /// Figures with all axes of those of the runs, perhaps without curves; empty where only runs tell them.
    fn axes(&self) -> Vec<Figure> {
        Vec::new()
    }
    /// Boundaries and start of a run; none for a case that is not simulated by particles.
    fn conditions(&self, _run: usize) -> Option<Conditions> {
        None
    }
    /// Judges and draws the records. Runs that were not simulated are left out.
    ///
    /// # Errors
    /// A check of a study that names what its runs do not give.
    fn finish(self: Box<Self>) -> Result<CaseResult, ParameterError>;
}

impl<C: Case> AnyCase for C {
    fn name(&self) -> &'static str {
        C::NAME
    }

    fn summary(&self) -> &'static str {
        C::SUMMARY
    }

    fn description(&self) -> &str {
        C::DESCRIPTION
    }

    fn quantities(&self) -> &'static [Quantity] {
        C::QUANTITIES
    }

    fn origin(&self) -> CodeOrigin {
        C::ORIGIN
    }

    fn form(&self) -> &'static ExternalSchema {
        &C::EXTERNAL_SCHEMA
    }

    fn show(&self, tier: Tier) -> String {
        file_text::<C>(tier, &RunList::<C::Flow>::of_tier(tier))
            + &tables_to_add(&[("", schema_of::<RunList<C::Flow>>())])
    }

    fn schema(&self, tier: Tier) -> serde_json::Value {
        let defaults = table_of(&RunList::<C::Flow>::of_tier(tier));
        schema::of_file(C::NAME, C::SUMMARY, tier, schema_of::<RunList<C::Flow>>(), &defaults)
    }

    fn parameter_schema(&self) -> &'static serde_json::Value {
        schema_of::<RunList<C::Flow>>()
    }

    fn prepare(&'static self, tier: Tier, changes: &Changes<'_>) -> Result<Box<dyn PreparedCase>, ParameterError> {
        let defaults = RunList::<C::Flow>::of_tier(tier);
        let changes = changes.with_lists(RunList::<C::Flow>::STATED);
        let parameters = defaults.resolve(C::NAME, &changes)?;
        let guard = Guard::new((C::NAME, tier), &changes, (&defaults, &parameters));
        let runs = guard.runs()?;
        let differs = guard.changed();
        let changed = table_of(&parameters) != table_of(&defaults);
        Ok(Box::new(CasePlan::<C> {
            tier,
            command: if changed {
                "bagnold run case.toml".to_owned()
            } else {
                format!("bagnold run {} --tier {tier}", C::NAME)
            },
            parameters_toml: file_text::<C>(tier, &parameters),
            slots: runs.into_iter().map(|run| (run, OnceLock::new())).collect(),
            differs,
            source: changes.source(),
            parameters,
        }))
    }
}

/// A run and, once it is done, its record and whether that came from the store.
type Slot<R> = (R, OnceLock<(Recorded<<R as Flow>::Observation>, bool)>);

struct CasePlan<C: Case> {
    tier: Tier,
    parameters: RunList<C::Flow>,
    parameters_toml: String,
    command: String,
    /// Fields that differ from the tier's, with their values.
    differs: Vec<(String, String)>,
    /// Source of the user's parameters.
    source: ParameterSource,
    slots: Vec<Slot<C::Flow>>,
}

impl<C: Case> CasePlan<C> {
    /// States near the end of a run, where a store keeps them.
    fn ends(&self, run: usize, store: &Store) -> Option<Checkpoints> {
        let trajectory = self.slots[run].0.trajectory().filter(|_| store.keeps_ends)?;
        store.key(C::ORIGIN, C::NAME, &("trajectory", trajectory)).map(|key| store.ends(&key))
    }

    /// Judges and draws the records of runs with one label.
    fn result(&self, slots: Vec<Slot<C::Flow>>) -> CaseResult {
        let (mut summaries, records): (Vec<RunSummary>, Vec<RecordOf<C::Flow>>) = slots
            .into_iter()
            .filter_map(|(run, slot)| slot.into_inner().map(|(record, from_store)| (run, record, from_store)))
            .map(|(run, record, from_store)| (summary(&run, &record, from_store), (run, record)))
            .unzip();
        let mut metrics = completed(C::NAME, (C::METRICS)(&records));
        let figures = (C::FIGURES)(&records);
        let animations = (C::ANIMATIONS)(&records);
        let tables = (C::TABLES)(&records);
        let regimes = records.iter().map(|(run, record)| run.regime(&record.data)).collect();
        let run_parameters = records.iter().map(|(run, _)| as_json(run)).collect();
        let (frames, first_bad) = records.into_iter().map(|(_, record)| (record.frames, record.first_bad)).unzip();
        fail_broken_profiles(&mut summaries, &tables);
        fail_diverged(&mut metrics, &summaries);
        CaseResult {
            name: C::NAME.to_owned(),
            origin: C::ORIGIN,
            summary: C::SUMMARY.to_owned(),
            description: C::DESCRIPTION.to_owned(),
            tier: self.tier,
            parameters_toml: self.parameters_toml.clone(),
            command: self.command.clone(),
            metrics,
            figures,
            animations,
            tables,
            state_hash: String::new(),
            runs: summaries,
            run_parameters,
            regimes,
            frames,
            first_bad,
        }
    }

    /// What the case says of records, those of one label together.
    fn said(&self, records: Vec<RecordOf<C::Flow>>) -> ExternalResult {
        let mut said = ExternalResult::default();
        for (label, records) in by_label(records, |(run, _)| self.parameters.label(run)) {
            let metrics = (C::METRICS)(&records).into_iter();
            said.metrics
                .extend(metrics.map(|metric| Metric { variant: metric.variant.clone().followed_by(&label), ..metric }));
            let figures = (C::FIGURES)(&records).into_iter();
            said.figures.extend(figures.map(|figure| Figure { name: figure.name + &label.suffix(), ..figure }));
            let tables = (C::TABLES)(&records).into_iter();
            said.tables.extend(tables.map(|table| Table { name: table.name + &label.suffix(), ..table }));
        }
        said
    }
}

/// Items with one label together, in the order of the labels; a group of none where there are no items.
fn by_label<T>(items: Vec<T>, label: impl Fn(&T) -> Variant) -> Vec<(Variant, Vec<T>)> {
    let mut groups = grouped(items.into_iter().map(|item| (label(&item), item)));
    if groups.is_empty() {
        groups.push((Variant::default(), Vec::new()));
    }
    groups
}

impl<C: Case> PreparedCase for CasePlan<C> {
    fn name(&self) -> &'static str {
        C::NAME
    }

    fn origin(&self) -> CodeOrigin {
        C::ORIGIN
    }

    fn parameters_toml(&self) -> &str {
        &self.parameters_toml
    }

    fn setup(&self) -> Option<Figure> {
        (C::SETUP)(&self.parameters)
    }

    fn run_count(&self) -> usize {
        self.slots.len()
    }

    fn variant(&self, run: usize) -> Variant {
        self.parameters.variant_of(&self.slots[run].0)
    }

    fn run_parameters(&self, run: usize) -> serde_json::Value {
        as_json(&self.slots[run].0)
    }

    fn scales(&self, run: usize) -> Option<RunScales> {
        self.slots[run].0.scales()
    }

    fn estimate(&self, run: usize) -> Estimate {
        Estimate::of(self.slots[run].0.cost())
    }

    fn briefs(&self) -> Vec<String> {
        self.slots.iter().filter_map(|(run, _)| run.brief()).collect()
    }

    fn identity(&self, run: usize, store: &Store) -> Option<String> {
        store.key(C::ORIGIN, self.name(), &self.slots[run].0).map(|key| key.0)
    }

    fn kept_state(&self, run: usize, store: &Store) -> Option<PathBuf> {
        self.ends(run, store)?.newest()
    }

    fn simulate(&self, run: usize, store: &Store, progress: &Progress) -> Result<(), ParameterError> {
        let (description, slot) = &self.slots[run];
        if is_interrupted() {
            return Err(ParameterError::Interrupted);
        }
        let key = store.key(C::ORIGIN, self.name(), description);
        // states on the way are nowhere but in the run itself, from its start
        let anew = progress.output().is_some();
        if let Some(record) = key.as_ref().filter(|_| !anew).and_then(|key| store.fetch(key)) {
            slot.get_or_init(|| (record, true));
            return Ok(());
        }
        let checkpoints = key.as_ref().filter(|_| !anew).map(|key| store.checkpoints(key));
        let ends = if anew { None } else { self.ends(run, store) };
        let simulated =
            description.simulate(&Progress { checkpoints: checkpoints.as_ref(), ends: ends.as_ref(), ..*progress });
        let record = match simulated {
            // what was cut short may look like something that is refused
            Err(_) if is_interrupted() => return Err(ParameterError::Interrupted),
            simulated => {
                let placed = |error| self.source.placed(with_changed(error, &self.differs));
                simulated.map(explained).map_err(placed)?
            }
        };
        if let Some(key) = &key {
            store.keep(key, &record);
        }
        slot.get_or_init(|| (record, false));
        Ok(())
    }

    fn choose(self: Box<Self>, runs: &[usize]) -> Box<dyn PreparedCase> {
        let mut plan = *self;
        let mut slots: Vec<Option<Slot<C::Flow>>> = plan.slots.into_iter().map(Some).collect();
        plan.slots = runs.iter().filter_map(|&run| slots.get_mut(run)?.take()).collect();
        Box::new(plan)
    }

    fn asked(&self) -> ExternalResult {
        let nothing = ExternalData::default();
        let record = |(run, _): &Slot<C::Flow>| {
            let seen = (C::FROM_EXTERNAL)(run, &nothing).ok().flatten()?;
            Some((run.clone(), nothing.record(seen.observation)))
        };
        ExternalResult { tables: Vec::new(), ..self.said(self.slots.iter().filter_map(record).collect()) }
    }

    fn outline(&self) -> Option<CaseResult> {
        let record = |(run, _): &Slot<C::Flow>| Some((run.clone(), ExternalData::default().record(run.outline()?)));
        let records: Option<Vec<RecordOf<C::Flow>>> = self.slots.iter().map(record).collect();
        let of_label = |(label, records): (Variant, Vec<RecordOf<C::Flow>>)| {
            let (name, figures, tables) = (C::NAME.to_owned(), (C::FIGURES)(&records), (C::TABLES)(&records));
            CaseResult { name, figures, tables, ..CaseResult::default() }.labelled(&label, Variant::clone)
        };
        let parts = by_label(records?, |(run, _)| self.parameters.label(run));
        parts.into_iter().map(of_label).reduce(CaseResult::and)
    }

    fn axes(&self) -> Vec<Figure> {
        let is_told = C::ORIGIN == CodeOrigin::PACKAGE && !C::AXES_BY_RUNS;
        if !is_told {
            return Vec::new();
        }
        let panel = |[x, y]: &[&str; 2]| Panel::new("", Axis::linear(x), Axis::linear(y));
        let of_runs = Figure::new("further figures", "", C::AXES_OF_RUNS.iter().map(panel).collect());
        let of_runs = Some(of_runs).filter(|figure| !figure.panels.is_empty());
        self.asked().figures.into_iter().chain(of_runs).collect()
    }

    fn conditions(&self, run: usize) -> Option<Conditions> {
        let described = OnceLock::new();
        // a run of particles ends before its first step; what a case of another crate does is unknown
        if C::ORIGIN == CodeOrigin::PACKAGE {
            self.slots[run].0.simulate(&Progress { conditions: Some(&described), ..Progress::SILENT }).err()?;
        }
        described.into_inner()
    }

    fn judge_external(&self, given: &[ExternalData]) -> Result<ExternalResult, (usize, FieldError)> {
        let mut records: Vec<RecordOf<C::Flow>> = Vec::new();
        let mut measured = Vec::new();
        for (number, (given, (run, _))) in given.iter().zip(&self.slots).enumerate() {
            if given.is_empty() {
                continue;
            }
            if let Some(foreign) = (C::FROM_EXTERNAL)(run, given).map_err(|error| (number, error))? {
                measured.push((self.parameters.variant_of(run), foreign.measured));
                records.push((run.clone(), given.record(foreign.observation)));
            }
        }
        Ok(ExternalResult { measured, ..self.said(records) })
    }

    fn finish(mut self: Box<Self>) -> Result<CaseResult, ParameterError> {
        let slots = by_label(std::mem::take(&mut self.slots), |(run, _)| self.parameters.label(run));
        let named = |variant: &Variant, label: &Variant| variant.clone().followed_by(label);
        let parts = slots
            .into_iter()
            .map(|(label, slots)| self.result(slots).labelled(&label, |variant| named(variant, &label)));
        let whole = parts.reduce(CaseResult::and).unwrap_or_else(|| self.result(Vec::new()));
        Ok(CaseResult { state_hash: hash_of_states(whole.runs.iter().map(|run| &run.state_hash)), ..whole })
    }
}

/// A run by the names of its fields, with the laws that it makes of them.
fn as_json(run: &impl Flow) -> serde_json::Value {
    let mut fields = serde_json::to_value(run).unwrap_or_default();
    let laws: Vec<serde_json::Value> = run.laws().iter().filter_map(|law| serde_json::to_value(law).ok()).collect();
    if let Some(fields) = fields.as_object_mut().filter(|_| !laws.is_empty()) {
        fields.insert("laws_of_scene".to_owned(), laws.into());
    }
    fields
}

fn file_text<C: Case>(tier: Tier, parameters: &RunList<C::Flow>) -> String {
    let text = toml::to_string(parameters).expect("a case's parameters are structs that TOML can hold");
    CaseFile::text(C::NAME, tier, &text, &notes(schema_of::<RunList<C::Flow>>(), &table_of(parameters)))
}

fn summary<R: Flow>(run: &R, record: &Recorded<R::Observation>, from_store: bool) -> RunSummary {
    RunSummary {
        variant: run.variant(),
        outcome: record.outcome.clone(),
        particles: record.particles,
        steps: record.steps,
        simulated_time: record.simulated_time,
        wall_seconds: record.wall_seconds,
        threads: record.threads,
        microseconds_per_particle_step: microseconds_each(
            record.wall_seconds,
            record.particles as f64 * record.steps as f64,
        ),
        state_hash: record.state_hash.clone(),
        from_store,
    }
}
