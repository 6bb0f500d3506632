//! A user's own study: a file that says what is simulated, what of it is measured, and what that is judged by.
//!
//! The simulation is that of any case: a scene of the user's own as well as a layer, a column or a channel. [`Study::read`]
//! reads the file, [`Study::prepare`] gives the cases to be simulated, one per variant, and [`Study::judge`] makes of their
//! results a single one, which is written, drawn and shown as that of a case is.
//!
//! ```toml
//! study = "collapse-in-my-flume"
//! summary = "Glass beads collapse in a flume of 10 cm"
//! base = "flume.toml"                       # a case file; or case = "scene" and [set]
//!
//! [[vary]]
//! path = "spacing"
//! values = [0.01, 0.005]
//!
//! [[checks]]
//! name = "front_at_rest"
//! table = "gauges"                          # the tables that the case writes
//! column = "front: front [m]"
//! value = "last"
//! reference = 0.31
//! standard_uncertainty = 0.01
//! source = "own flume, May 2026"
//! within_uncertainties = 2.0
//! ```

mod canonical;
mod check;
mod control;
mod doubts;
mod drawn;
mod figures;
mod file;
mod probe;
mod reading;
mod schema;
mod suite;

pub use canonical::canonical;
pub use schema::schema;
pub use suite::{Suite, is_study};

use crate::case::list::ListedChange;
use crate::case::{
    CaseFile, CaseResult, Changes, Limits, ParameterError, PreparedCase, Registry, Tier, hash_of_states,
    table_of_settings, twice_given,
};
use crate::evaluation::parse_plan;
use crate::figure::Figure;
use crate::input::{FieldError, MeasuredFiles, WRITTEN_BY_HAND, read_text};
use crate::measured::Measurements;
use crate::metric::Metric;
use crate::output::{FileError, caution};
use check::{CheckedQuantity, StudyCheck};
use file::StudyText;
use probe::ColumnWindow;
use reading::{Reading, joined};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A study that was read; nothing has been simulated.
#[derive(Debug, Clone)]
pub struct Study {
    file: PathBuf,
    text: StudyText,
    base: CaseFile,
    checks: Vec<StudyCheck>,
    changes: Vec<ListedChange>,
}

impl Study {
    /// Reads a file and the files that it names.
    ///
    /// # Errors
    /// A file that cannot be read or typed, or a field that breaks a rule.
    pub fn read(file: &Path, registry: Registry) -> Result<Self, ParameterError> {
        let text = read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error))?;
        let study = Self::parse(file, &text)?;
        // a canonical study may be printed, changed and run from its file
        if registry.find(study.name()).is_ok_and(|case| !case.is_study()) {
            let value = format!("\"{}\"", study.name());
            let remedy = "choose another name, under which pages and baseline values are stored";
            return Err(FieldError::new("study", value, "different from all cases", remedy).in_file(file).into());
        }
        for doubt in study.doubts() {
            caution(&format!("study `{}`: {doubt}", study.name()));
        }
        Ok(study)
    }

    /// The study of a file with this text, and of the files that it names.
    fn parse(file: &Path, text: &str) -> Result<Self, ParameterError> {
        let text: StudyText = parse_plan(file, text, "bagnold run")?;
        let in_file = |error: FieldError| error.in_file(file);
        text.check().map_err(in_file)?;
        let beside = file.parent().unwrap_or(Path::new(""));
        let base = CaseFile::of_plan(file, text.case.as_deref(), text.base.as_deref(), text.tier, &text.set)?;
        let mut checks: Vec<StudyCheck> = Vec::new();
        for (place, own) in text.checks.iter().enumerate() {
            let within = |error: FieldError| in_file(error.within(&format!("checks[{place}]")));
            let check = StudyCheck::of(own, beside).map_err(within)?;
            if checks.iter().any(|other| other.name == check.name && other.only == check.only) {
                let remedy = "give each another name, or other variants by `only`";
                return Err(within(FieldError::new("name", &check.name, "unique", remedy)).into());
            }
            let earlier = match &check.read {
                CheckedQuantity::Order { of, .. } => Some(("order_of", of)),
                CheckedQuantity::Difference { of, .. } => Some(("difference_of", of)),
                _ => None,
            };
            if let Some((field, of)) = earlier.filter(|(_, of)| !checks.iter().any(|other| other.name == **of)) {
                let remedy = "name a check that stands above this one";
                return Err(within(FieldError::new(field, of, "the name of an earlier check", remedy)).into());
            }
            if let CheckedQuantity::Order { in_parameter, .. } = &check.read {
                let is_varied =
                    |varied: &crate::case::VariedParameter| varied.label() == in_parameter && varied.values.len() > 1;
                if !text.vary.iter().any(is_varied) {
                    let rule = "the name of a parameter that [[vary]] gives several values";
                    let error = FieldError::new("order_in", in_parameter, rule, "vary it, or name another");
                    return Err(within(error).into());
                }
            }
            checks.push(check);
        }
        let changes = text.list().changes();
        let mut files = BTreeMap::new();
        for changed in &changes {
            if let Some(twin) = files.insert(changed.variant.file_name(), &changed.variant) {
                let rule = format!("different from {twin} also as part of file names");
                let error =
                    FieldError::new("variants", &changed.variant, &rule, "rename one: letters, digits and dashes");
                return Err(in_file(error).into());
            }
        }
        Ok(Self { file: file.to_owned(), text, base, checks, changes })
    }

    /// Name.
    pub fn name(&self) -> &str {
        &self.text.study
    }

    /// Tier that supplies parameters missing in the file.
    pub fn tier(&self) -> Tier {
        self.base.tier.unwrap_or(Tier::Quick)
    }

    /// The study at a tier: with the parameters that its file lays over the base values there.
    fn of_tier(&self, tier: Tier) -> Self {
        let mut study = self.clone();
        if tier != Tier::Quick {
            study.base.lay_over(&self.text.paper);
        }
        study
    }

    /// The study with the runs of a tier, and without the checks of other ones.
    fn with_variants_of(mut self, tier: Tier) -> Self {
        self.changes = self.text.list().of_tier(tier).changes();
        self.drop_checks_without_runs();
        self
    }

    /// The study whose results tell settings (`path=value`) of the command line among their parameters.
    pub fn told_with(mut self, settings: &[String]) -> Self {
        self.base.lay_over(&table_of_settings(settings));
        self
    }

    /// Leaves out the checks of variants that are not run.
    fn drop_checks_without_runs(&mut self) {
        let changes = &self.changes;
        let of_study = |check: &StudyCheck| {
            let variant = check.only.get("variant");
            variant.is_none_or(|own| changes.iter().any(|changed| changed.variant.get("variant") == Some(own)))
        };
        self.checks.retain(of_study);
    }

    /// The cases to be simulated, one per variant and then one per control and variant, with settings (`path=value`) of the command line over
    /// all of them.
    ///
    /// # Errors
    /// A case that does not exist or refuses a variant's parameters.
    pub fn prepare(
        &self,
        registry: Registry,
        tier: Option<Tier>,
        settings: &[String],
        limits: Limits,
    ) -> Result<Vec<Box<dyn PreparedCase>>, ParameterError> {
        for setting in settings {
            self.refuse_varied(setting)?;
        }
        let mut cases = self.prepare_variants(registry, tier, settings, limits)?;
        self.refuse_unknown_columns(&cases).map_err(|error| error.in_file(&self.file))?;
        cases.extend(self.prepare_controls(registry, tier, settings, limits)?);
        Ok(cases)
    }

    fn prepare_variants(
        &self,
        registry: Registry,
        tier: Option<Tier>,
        settings: &[String],
        limits: Limits,
    ) -> Result<Vec<Box<dyn PreparedCase>>, ParameterError> {
        let case = registry.find(&self.base.case).map_err(|error| error.in_file(&self.base.path))?;
        let base = self.of_tier(tier.unwrap_or(self.tier())).base;
        let prepare = |changed: &ListedChange, settings: &[String]| {
            let settings: Vec<String> = changed.settings().chain(settings.iter().cloned()).collect();
            let file = Some((base.path.as_path(), base.fields.clone()));
            let changes = Changes { file, settings: &settings, limits, only: &[] };
            case.prepare(tier.unwrap_or(self.tier()), &changes)
        };
        // what the file says is refused by its place there, what the command line says by its field
        let refused = |changed: &ListedChange, error: ParameterError| match prepare(changed, &[]) {
            Ok(_) => error,
            Err(error) => error.in_plan(&self.file),
        };
        let of_variant = |changed| prepare(changed, settings).map_err(|error| refused(changed, error));
        self.changes.iter().map(of_variant).collect()
    }

    /// Refuses tables, columns and units that no run will have and measurements after the end of every scene, where these are known before
    /// anything is simulated.
    fn refuse_unknown_columns(&self, cases: &[Box<dyn PreparedCase>]) -> Result<(), FieldError> {
        let outlines: Vec<CaseResult> = cases.iter().filter_map(|case| case.outline()).collect();
        for (place, check) in self.checks.iter().enumerate() {
            let (CheckedQuantity::Value(column, _) | CheckedQuantity::Distance(column, ..)) = &check.read else {
                continue;
            };
            let within = |error: FieldError| error.within(&format!("checks[{place}]"));
            let compared = column.window.0..=column.window.1;
            let whole = ColumnWindow { window: (f64::NEG_INFINITY, f64::INFINITY), ..column.clone() };
            let (mut last, mut end) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
            for outline in &outlines {
                for curve in whole.curves(outline).map_err(within)? {
                    let Some(measured) = check.read.measured() else { continue };
                    let points = measured.in_units(probe::unit_of(&curve.over), probe::unit_of(&column.column))?;
                    let times = points.iter().map(|point| point[0]).filter(|time| compared.contains(time));
                    last = times.fold(last, f64::max);
                    end = curve.points.last().map_or(end, |point| point.0.max(end));
                }
            }
            if last > end && column.over.is_none() {
                let rule = format!("at least {last} s, the last time that `checks[{place}]` compares");
                let remedy = "raise it, or end the comparison with `to`";
                return Err(FieldError::new("duration", format!("{end} s"), &rule, remedy));
            }
        }
        Ok(())
    }

    /// Refuses a setting of the command line for a parameter to which the study gives values itself.
    fn refuse_varied(&self, setting: &str) -> Result<(), FieldError> {
        for (place, path, value) in self.changes.iter().flat_map(|changed| &changed.values) {
            if let Some(field) = twice_given(&format!("{path}={value}"), setting) {
                let file = self.file.display();
                let rule = format!("of a parameter that the study leaves free: `{place}` in {file} gives `{field}`");
                let remedy = "change it there, or leave --set out";
                return Err(FieldError::new("--set", setting, &rule, remedy));
            }
        }
        Ok(())
    }

    /// The files with measurements that its checks compare with.
    pub fn measurements(&self) -> impl Iterator<Item = &Measurements> {
        self.checks.iter().filter_map(|check| check.read.measured())
    }

    /// Number of cases that [`Self::prepare`] gives.
    fn case_count(&self) -> usize {
        self.changes.len() * (1 + self.text.controls.len())
    }

    /// One result of all cases' results, in the order of [`Self::prepare`]: the checks first, then whether they reject the controls, then what
    /// the case says of its runs itself.
    ///
    /// # Errors
    /// A check that names a table, column, metric or variant that there is not.
    pub fn judge(&self, mut results: Vec<CaseResult>) -> Result<CaseResult, ParameterError> {
        let mut wrong = results.split_off(self.changes.len().min(results.len())).into_iter();
        let mut judged = self.judge_variants(results)?;
        let mut rejections = Vec::new();
        for place in 0..self.text.controls.len() {
            let wrong = self.judge_variants(wrong.by_ref().take(self.changes.len()).collect())?;
            rejections.extend(self.rejections(&judged, place, &wrong));
        }
        let is_check = |metric: &Metric| self.checks.iter().any(|check| check.name == metric.name);
        let place = judged.metrics.iter().rposition(is_check).map_or(0, |last| last + 1);
        judged.metrics.splice(place..place, rejections);
        Ok(judged)
    }

    fn judge_variants(&self, results: Vec<CaseResult>) -> Result<CaseResult, ParameterError> {
        let tier = results.first().map_or(Tier::Quick, |result| result.tier);
        let mut judged = CaseResult {
            name: self.text.study.clone(),
            origin: results.first().map(|result| result.origin).unwrap_or_default(),
            summary: self.text.summary.clone(),
            description: self.text.description.trim().to_owned(),
            tier,
            parameters_toml: self.complete(tier),
            command: "bagnold run case.toml".to_owned(),
            ..CaseResult::default()
        };
        for (place, check) in self.checks.iter().enumerate() {
            let wrong = |error: FieldError| error.within(&format!("checks[{place}]")).in_file(&self.file);
            let readings = self.readings(check, &results, &judged.metrics).map_err(wrong)?;
            if readings.is_empty() {
                let variants: Vec<String> =
                    self.changes.iter().take(5).map(|changed| format!("\"{}\"", changed.variant)).collect();
                let rule = format!("keys and values of a variant, such as {}", variants.join(", "));
                let remedy = "correct it, or leave it out to select all";
                return Err(wrong(FieldError::new("only", format!("\"{}\"", check.only), &rule, remedy)).into());
            }
            let metric = |reading: &Reading| {
                let metric = check.metric(&reading.variant, reading.value, &reading.unit);
                metric.known_as(&reading.uncertainty).remarked(reading.remark.clone())
            };
            judged.metrics.extend(readings.iter().map(metric));
            figures::add(&mut judged.figures, check, &readings).map_err(wrong)?;
        }
        let own: Vec<Figure> = self.text.figures.iter().map(|figure| figure.draw(&judged.metrics)).collect();
        let state_hash = hash_of_states(results.iter().map(|result| &result.state_hash));
        for (changed, result) in self.changes.iter().zip(results) {
            judged = judged.and(result.labelled(&changed.variant, |variant| joined(&changed.variant, variant)));
        }
        judged.state_hash = state_hash;
        for (place, figure) in own.iter().enumerate() {
            if judged.figures.iter().any(|other| other.name == figure.name) {
                let rule = "different from the names of the case's own figures and those of the checks";
                let error =
                    FieldError::new(&format!("figures[{place}].name"), &figure.name, rule, "choose another name");
                return Err(error.in_file(&self.file).into());
            }
        }
        judged.figures.splice(0..0, own);
        Ok(judged)
    }

    /// The study as a file that needs no other but the copies of its measurements.
    fn complete(&self, tier: Tier) -> String {
        let mut text = StudyText {
            case: Some(self.base.case.clone()),
            base: None,
            tier: Some(tier),
            set: self.base.fields.clone(),
            ..self.text.clone()
        };
        for (own, check) in text.checks.iter_mut().zip(&self.checks) {
            if let Some(measured) = check.read.measured() {
                own.compare = Some(MeasuredFiles::One(PathBuf::from(measured.kept())));
            }
        }
        toml::to_string(&text).unwrap_or_else(|error| format!("# the study cannot be written as TOML: {error}\n"))
    }
}
