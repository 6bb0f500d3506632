//! Submission of an external code: a TOML file with its case, its runs, and the data of each run.

use crate::case::{CaseFile, ParameterError, Tier, leaves};
use crate::evaluation::read_plan;
use crate::input::{FieldError, Origin, check_name};
use crate::metric::Variant;
use crate::output::caution;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Place of measurements that judge other codes.
const MEASURED: &str = "to judge both codes by it, give the scene in `base` a table [[measured]] with gauge, source, file = \"mine.csv\" and limit";

/// A submission as its file gives it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Submission {
    /// The file.
    #[serde(skip)]
    pub path: PathBuf,
    /// Name of the case.
    pub case: String,
    /// Tier whose runs are meant.
    #[serde(default)]
    pub tier: Tier,
    /// A case file with the parameters, beside this one: a scene of one's own.
    pub base: Option<PathBuf>,
    /// Refused: measurements stand in the scene that is judged by.
    overlay: Option<toml::Value>,
    /// The parameters that this file gives itself.
    #[serde(skip)]
    own: toml::Table,
    /// Parameters that differ from the tier's, or from those of `base`, as in a case's file.
    #[serde(default)]
    pub with: toml::Table,
    /// Name and version of the judged code.
    pub code: Code,
    /// The law that its runs obey.
    #[serde(default)]
    pub law: LawOrigin,
    /// Digest of the inputs that it was made from, as the export names it.
    pub inputs: Option<String>,
    /// Digest of the gates that it was made for, as the export names it.
    pub gates: Option<String>,
    /// Digests of the limits, separated by blanks: they count the limits that have moved.
    #[serde(default)]
    pub limits: String,
    /// Runs of the case with their results.
    #[serde(rename = "run", default)]
    pub runs: Vec<ForeignRun>,
}

/// The law of a code's runs. Against exact solutions and other codes of one law only the same law is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LawOrigin {
    /// The case's law with its numbers.
    #[default]
    Same,
    /// Another law or other numbers.
    Own,
    /// None: grains, of which a law was measured at most.
    Grains,
}

/// Another code.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Code {
    /// Name, as it stands in tables and legends.
    pub name: String,
    /// Version, or what else tells it from others of its name.
    #[serde(default)]
    pub version: String,
}

/// Data of one run of the external code, each part optional.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ForeignRun {
    /// Keys of the case's run that it is, such as `material=lagree,aspect_ratio=1`; those that are the code's own business,
    /// such as the resolution, may be left out.
    #[serde(default)]
    pub variant: Variant,
    /// Single numbers: metrics of the run by name, in their units.
    #[serde(default)]
    pub numbers: BTreeMap<String, f64>,
    /// Particles, or cells, at several times.
    pub particles: Option<ParticleFiles>,
    /// Time series.
    pub series: Option<TableFile>,
    /// A profile.
    pub profile: Option<TableFile>,
    /// The run on a coarser mesh, for the code's own order of convergence.
    pub coarse: Option<CoarseRun>,
}

/// Profile of a run on a coarser mesh, with the columns of the run's own profile.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoarseRun {
    /// Cell size over that of the run `[-]`.
    pub ratio: f64,
    /// The file, beside the submission.
    pub profile: PathBuf,
}

/// Files of particles, one a time
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ParticleFiles {
    /// Files beside the plan: tables, VTK or its collections, or a single dump of LAMMPS, `.dump` or `.lammpstrj`
    pub files: Vec<PathBuf>,
    /// Times of the files `[s]`; absent where a single file says them
    #[serde(default)]
    pub times: Vec<f64>,
    /// Length of a step `[s]` of a dump that counts steps
    pub time_step: Option<f64>,
    /// Columns of the files by quantity, such as `x = "x [m]"`
    #[schemars(with = "BTreeMap<String, serde_json::Value>")]
    pub columns: BTreeMap<String, toml::Value>,
}

/// A file with a table of numbers.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableFile {
    /// The file, beside the submission.
    pub file: PathBuf,
    /// Assignment of the file's columns to quantities; by their headings, if it is left out.
    #[serde(default)]
    pub columns: BTreeMap<String, toml::Value>,
}

impl Submission {
    /// Reads a submission; the files that it names are read later.
    ///
    /// # Errors
    /// A file that cannot be read, is not TOML, or lacks something.
    pub fn read(path: &Path) -> Result<Self, ParameterError> {
        let submission: Self = read_plan(path, "bagnold judge")?;
        submission.check().map_err(|error| error.in_file(path))?;
        let fields = submission.parameters(path)?;
        Ok(Self { path: path.to_owned(), own: submission.with, with: fields, ..submission })
    }

    /// The file of its parameters, the base where there is one.
    pub fn parameter_file(&self) -> PathBuf {
        let beside = self.path.parent().unwrap_or(Path::new(""));
        self.base.as_ref().map_or_else(|| self.path.clone(), |base| beside.join(base))
    }

    /// An error of the parameters, in this file if the field at fault stands here and not in the base.
    pub fn placed(&self, mut error: ParameterError) -> ParameterError {
        let is_within = |inner: &str, outer: &str| {
            inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        if let ParameterError::Field(FieldError { field, origin, .. }) = &mut error
            && leaves(&self.own).iter().any(|own| is_within(own, field) || is_within(field, own))
        {
            *origin = Some(Origin::File(self.path.clone()));
        }
        if let ParameterError::Field(error) = &mut error
            && self.base.is_none()
            && self.own.is_empty()
        {
            error.remedy = format!("name the file of the {} by `base`, or give its fields in `with`", self.case).into();
        }
        error
    }

    /// The parameters: those of `base` with those of `with` laid over them.
    fn parameters(&self, path: &Path) -> Result<toml::Table, ParameterError> {
        let file = CaseFile::of_plan(path, Some(&self.case), self.base.as_deref(), None, &self.with)?;
        if let Some(tier) = file.tier.filter(|tier| *tier != self.tier) {
            let rule = format!("the tier of {}, {tier}", file.path.display());
            let remedy = "name the same tier in both files";
            return Err(FieldError::new("tier", self.tier, &rule, remedy).in_file(path).into());
        }
        if !file.overlay.is_empty() {
            let name = file.path.display();
            caution(&format!("{name}: `overlay` judges runs of Bagnold only; {MEASURED}"));
        }
        Ok(file.fields)
    }

    /// Files that it names, as it names them.
    pub fn files(&self) -> Vec<PathBuf> {
        let of_run = |run: &ForeignRun| {
            let tables = [&run.series, &run.profile].map(|table| table.as_ref().map(|table| table.file.clone()));
            let coarse = run.coarse.as_ref().map(|coarse| coarse.profile.clone());
            let particles = run.particles.iter().flat_map(|particles| particles.files.clone());
            tables.into_iter().chain([coarse]).flatten().chain(particles).collect::<Vec<_>>()
        };
        self.runs.iter().flat_map(of_run).collect()
    }

    fn check(&self) -> Result<(), FieldError> {
        if self.overlay.is_some() {
            return Err(FieldError::finding("overlay", "measurements in a submission", MEASURED));
        }
        if self.code.name.trim().is_empty() || self.code.name.chars().count() > 60 {
            let rule = "a name of 1 to 60 letters";
            return Err(FieldError::new("code.name", format!("\"{}\"", self.code.name), rule, "name the code"));
        }
        check_name("code.name", &self.code.name)?;
        if !self.code.version.is_empty() {
            check_name("code.version", &self.code.version)?;
        }
        if self.runs.is_empty() {
            let remedy = "add a table [[run]] with the results of the code";
            return Err(FieldError::finding("run", "missing", remedy));
        }
        for (place, run) in self.runs.iter().enumerate() {
            let field = format!("run {}", place + 1);
            if let Some((name, value)) = run.numbers.iter().find(|(_, value)| value.is_nan()) {
                let remedy = "leave quantities without a value out";
                return Err(FieldError::new(&format!("{field}.numbers.{name}"), value, "a number", remedy));
            }
            let is_coarser = |coarse: &CoarseRun| coarse.ratio > 1.0 && coarse.ratio.is_finite();
            if let Some(coarse) = run.coarse.as_ref().filter(|coarse| !is_coarser(coarse) || run.profile.is_none()) {
                let remedy = "give the ratio of the cell sizes, such as 2, and the profile of the finer mesh";
                let rule = "finite, larger than 1 and given with a profile";
                return Err(FieldError::new(&format!("{field}.coarse.ratio"), coarse.ratio, rule, remedy));
            }
            if let Some(files) = &run.particles {
                files.check().map_err(|error| error.within(&field))?;
            }
            let is_empty = run.numbers.is_empty() && run.particles.is_none() && run.series.is_none();
            if is_empty && run.profile.is_none() {
                let remedy = "add numbers, particles, series or profile, or leave the run out";
                return Err(FieldError::finding(&field, "no results", remedy));
            }
        }
        Ok(())
    }
}

impl ForeignRun {
    /// Data of the run on its coarser mesh; empty without one.
    pub(super) fn on_coarser_mesh(&self) -> Self {
        let table = |coarse: &CoarseRun| Some(TableFile { file: coarse.profile.clone(), ..self.profile.clone()? });
        let profile = self.coarse.as_ref().and_then(table);
        Self { profile, variant: self.variant.clone(), ..Self::default() }
    }
}

impl ParticleFiles {
    pub(crate) fn check(&self) -> Result<(), FieldError> {
        let wrong = |field: &str, value: String, rule: &str, remedy: &str| {
            Err(FieldError::new(&format!("particles.{field}"), value, rule, remedy))
        };
        if self.files.is_empty() {
            return wrong("files", "no files".to_owned(), "", "name one file for each time");
        }
        if self.is_collection() {
            return if self.times.is_empty() {
                Ok(())
            } else {
                wrong("times", "given with a .pvd or dump".to_owned(), "", "leave it out: the file contains the times")
            };
        }
        if self.times.len() != self.files.len() {
            let defect = format!("{} times for {} files", self.times.len(), self.files.len());
            return wrong("times", defect, "", "give the time of each file in s");
        }
        rising(&self.times).map_or(Ok(()), |time| {
            let remedy = "list the files in the order of time";
            wrong("times", time.to_string(), "finite and larger than the one before", remedy)
        })
    }

    /// Whether one file names or holds the pictures.
    pub(super) fn is_collection(&self) -> bool {
        let is_one = |file: &PathBuf| {
            let ending = file.extension().and_then(|ending| ending.to_str());
            ending.is_some_and(|ending| ["pvd", "series", "dump", "lammpstrj"].contains(&ending))
        };
        matches!(self.files.as_slice(), [file] if is_one(file))
    }
}

/// The first number that does not exceed the one before, or is not finite.
pub(super) fn rising(numbers: &[f64]) -> Option<f64> {
    let mut before = f64::NEG_INFINITY;
    numbers.iter().copied().find(|&number| {
        let is_wrong = !(number > before && number.is_finite());
        before = number;
        is_wrong
    })
}
