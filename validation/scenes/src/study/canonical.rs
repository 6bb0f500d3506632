//! Canonical studies: studies that the program carries and judges like any case.
//!
//! A study is a case whose runs are those of other cases and whose gates are its checks. It is found by its name, is part of the
//! report, and has a baseline, a list of gates and expected failures.

use super::file::StudyText;
use super::{Study, schema};
use crate::case::{
    AnyCase, CaseResult, Changes, Estimate, ParameterError, PreparedCase, Progress, Registry, Tier, tables_to_add,
};
use crate::control::{Control, TriedControls};
use crate::figure::Figure;
use crate::metric::Variant;
use crate::store::{CodeOrigin, Store};
use bagnold_solver::parameter::schema_of;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// A study of the program.
struct CanonicalStudy {
    /// Name, which is that of its file.
    name: &'static str,
    /// Text of its file.
    text: &'static str,
    /// Cases that its runs may be of.
    cases: Registry,
    read: OnceLock<Study>,
}

impl CanonicalStudy {
    /// The study.
    ///
    /// # Panics
    /// A text that is no study, or has another name than its file: a test reads those of the program.
    fn study(&self) -> &Study {
        self.read.get_or_init(|| {
            let study = Study::parse(Path::new(&format!("{}.toml", self.name)), self.text)
                .unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(study.name(), self.name, "a canonical study has the name of its file");
            study
        })
    }

    fn base(&self) -> &'static dyn AnyCase {
        let base = &self.study().base.case;
        self.cases.find(base).unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }
}

impl AnyCase for CanonicalStudy {
    fn name(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        // the lists of all cases read no study
        let line = self.text.lines().find_map(|line| line.strip_prefix("summary = \""));
        line.and_then(|line| line.strip_suffix('"')).unwrap_or_default()
    }

    fn description(&self) -> &str {
        &self.study().text.description
    }

    fn origin(&self) -> CodeOrigin {
        self.base().origin()
    }

    fn is_study(&self) -> bool {
        true
    }

    fn controls(&self) -> Vec<Control> {
        let (mut controls, tried) = (self.study().controls(), TriedControls::shipped(self.name));
        for control in &mut controls {
            control.in_table = tried.trial(control).is_some();
        }
        controls
    }

    fn show(&self, _: Tier) -> String {
        let schemas = [("", schema_of::<StudyText>()), ("set", self.parameter_schema())];
        self.text.to_owned() + &tables_to_add(&schemas)
    }

    /// The schema of a study, with the parameters of its case.
    fn schema(&self, _: Tier) -> serde_json::Value {
        let mut schema = schema();
        let mut parameters = self.base().schema(self.study().tier())["properties"].take();
        if let Some(fields) = parameters.as_object_mut() {
            fields.retain(|name, _| self.parameter_schema()["properties"].get(name).is_some());
        }
        for table in ["set", "paper"] {
            schema["properties"][table]["properties"] = parameters.clone();
            schema["properties"][table]["additionalProperties"] = false.into();
        }
        schema
    }

    fn parameter_schema(&self) -> &'static serde_json::Value {
        self.base().parameter_schema()
    }

    fn prepare(&'static self, tier: Tier, changes: &Changes<'_>) -> Result<Box<dyn PreparedCase>, ParameterError> {
        let mut study = self.study().of_tier(tier);
        if let Some((_, fields)) = &changes.file {
            // a sweep hands the study back as it was written
            let whole = fields.get("set").and_then(toml::Value::as_table);
            study.base.lay_over(whole.filter(|_| fields.contains_key("checks")).unwrap_or(fields));
        }
        let base_tier = study.tier();
        // what is set is part of the parameters, by which evaluations are known and repeated
        let parameters_toml = study.clone().told_with(changes.settings).complete(tier);
        // a report runs them beside the study
        let study = study.without_controls().with_variants_of(tier);
        let parts = study.prepare(self.cases, Some(base_tier), changes.settings, changes.limits)?;
        Ok(Box::new(StudyPlan { name: self.name, tier, study, parameters_toml, parts }))
    }
}

/// A study whose cases are prepared, one per variant.
struct StudyPlan {
    name: &'static str,
    tier: Tier,
    study: Study,
    parameters_toml: String,
    parts: Vec<Box<dyn PreparedCase>>,
}

impl StudyPlan {
    /// Runs in order, each by the number of its part and its own number there.
    fn places(&self) -> impl Iterator<Item = (usize, usize)> {
        self.parts.iter().enumerate().flat_map(|(part, case)| (0..case.run_count()).map(move |run| (part, run)))
    }

    fn at(&self, run: usize) -> (&dyn PreparedCase, usize, usize) {
        let (part, own) = self.places().nth(run).unwrap_or_default();
        (&*self.parts[part], own, part)
    }
}

impl PreparedCase for StudyPlan {
    fn name(&self) -> &'static str {
        self.name
    }

    fn origin(&self) -> CodeOrigin {
        self.parts.iter().map(|part| part.origin()).fold(CodeOrigin::PACKAGE, CodeOrigin::and)
    }

    fn parameters_toml(&self) -> &str {
        &self.parameters_toml
    }

    fn setup(&self) -> Option<Figure> {
        self.parts.first()?.setup()
    }

    fn run_count(&self) -> usize {
        self.places().count()
    }

    fn variant(&self, run: usize) -> Variant {
        let (case, own, part) = self.at(run);
        super::joined(&self.study.changes[part].variant, &case.variant(own))
    }

    fn run_parameters(&self, run: usize) -> serde_json::Value {
        let (case, own, _) = self.at(run);
        case.run_parameters(own)
    }

    fn estimate(&self, run: usize) -> Estimate {
        let (case, own, _) = self.at(run);
        case.estimate(own)
    }

    fn briefs(&self) -> Vec<String> {
        self.parts.iter().flat_map(|part| part.briefs()).collect()
    }

    fn identity(&self, run: usize, store: &Store) -> Option<String> {
        let (case, own, _) = self.at(run);
        case.identity(own, store)
    }

    fn kept_state(&self, run: usize, store: &Store) -> Option<PathBuf> {
        let (case, own, _) = self.at(run);
        case.kept_state(own, store)
    }

    fn simulate(&self, run: usize, store: &Store, progress: &Progress) -> Result<(), ParameterError> {
        let (case, own, _) = self.at(run);
        case.simulate(own, store, progress)
    }

    fn choose(self: Box<Self>, runs: &[usize]) -> Box<dyn PreparedCase> {
        let places: Vec<(usize, usize)> = self.places().collect();
        let mut plan = *self;
        let changes = std::mem::take(&mut plan.study.changes);
        for (part, (case, change)) in std::mem::take(&mut plan.parts).into_iter().zip(changes).enumerate() {
            let chosen = runs.iter().filter_map(|&run| places.get(run)).filter(|place| place.0 == part);
            let chosen: Vec<usize> = chosen.map(|place| place.1).collect();
            if !chosen.is_empty() {
                plan.parts.push(case.choose(&chosen));
                plan.study.changes.push(change);
            }
        }
        plan.study.drop_checks_without_runs();
        Box::new(plan)
    }

    fn finish(self: Box<Self>) -> Result<CaseResult, ParameterError> {
        let Self { tier, study, parameters_toml, parts, .. } = *self;
        let results = parts.into_iter().map(PreparedCase::finish).collect::<Result<_, _>>()?;
        let judged = study.judge(results)?;
        Ok(CaseResult { tier, parameters_toml, command: format!("bagnold run {} --tier {tier}", self.name), ..judged })
    }
}

/// Canonical studies of embedded files, in the order of their names; other files are left alone.
pub fn canonical(files: &'static [(&'static str, &'static str)], cases: Registry) -> Vec<&'static dyn AnyCase> {
    let studies = files.iter().filter_map(|(name, text)| Some((name.strip_suffix(".toml")?, *text)));
    let study = |(name, text)| CanonicalStudy { name, text, cases, read: OnceLock::new() };
    studies.map(|file| &*Box::leak(Box::new(study(file))) as &dyn AnyCase).collect()
}
