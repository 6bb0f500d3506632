//! A sweep as a TOML file.

use super::error::SweepError;
use super::manifest::{Manifest, SweepRun};
use super::values::{check_levels, check_values};
use crate::case::{Limits, ParameterError, PreparedCase, Registry};
use crate::evaluation::{self, CaseRequest, Paths, PlanError, read_plan, toml_number};
use crate::input::{FieldError, check_name};
use crate::sampling::{Bounds, Spacing, design};
use crate::store::identity_or_unique;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use toml::Value;

/// More runs than this are a slip of the pen.
const MOST_RUNS: usize = 100_000;

/// Length of the Sobol sequence.
const MOST_SOBOL_POINTS: usize = 65_536;

/// Columns that the table of results has anyway.
const TAKEN: [&str; 9] = ["run", "case", "tier", "metric", "variant", "value", "unit", "verdict", "reason"];

/// Arrangement of the points.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected design = \"grid\", or a table [design.latin_hypercube] or [design.sobol] with `points` and `seed`"
)]
enum Design {
    /// All combinations of the parameters' values.
    Word(Word),
    /// Points spread over the range.
    Spread(SpaceFillingDesign),
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum Word {
    Grid,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum SpaceFillingDesign {
    /// One point in each of `points` slices along every axis.
    LatinHypercube {
        /// Number of points
        points: usize,
        /// Seed of the points
        seed: u64,
    },
    /// The first points of a scrambled Sobol sequence.
    Sobol {
        /// Number of points
        points: usize,
        /// Seed of the scrambling
        seed: u64,
    },
}

impl Design {
    const GRID: Self = Self::Word(Word::Grid);
}

#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "struct Varied")]
struct SweptParameter {
    /// Dotted path of the parameter, or a table of paths by case
    path: Paths,
    /// Name of the column in the results; the last key of the path, if it is left out
    name: Option<String>,
    /// Values, numbers or words
    #[schemars(with = "Option<Vec<serde_json::Value>>")]
    values: Option<Vec<Value>>,
    /// Lowest value, in place of `values`
    lower: Option<f64>,
    /// Highest value
    upper: Option<f64>,
    /// Division of the range
    #[serde(default)]
    #[schemars(extend("enum" = ["linear", "log"]), with = "String")]
    scale: Spacing,
    /// Values between `lower` and `upper` of a grid
    levels: Option<usize>,
}

#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SweepText {
    /// Arrangement of the points: `grid` for all combinations, or one of the tables
    design: Design,
    /// Cases that are run at every point
    cases: Vec<CaseRequest>,
    /// Parameters that vary
    parameters: Vec<SweptParameter>,
    /// Metrics that are drawn; those that change, if it is left out
    #[serde(default)]
    metrics: Vec<String>,
}

/// A sweep that was read.
#[derive(Debug, Clone)]
pub struct SweepPlan {
    file: PathBuf,
    text: SweepText,
}

impl SweepPlan {
    /// Reads a file; its cases' parameters are checked when the manifest is made.
    ///
    /// # Errors
    /// A file that cannot be read or typed, or ranges that break a rule.
    pub fn read(file: &Path) -> Result<Self, SweepError> {
        let plan = Self { file: file.to_owned(), text: read_plan(file, "bagnold sweep")? };
        plan.check().map_err(|error| error.in_file(file))?;
        Ok(plan)
    }

    fn check(&self) -> Result<(), FieldError> {
        let missing = |field: &str, example: &str| {
            Err(FieldError::new(field, "empty", "at least one table", &format!("add a `[[{field}]]` table, {example}")))
        };
        if self.text.cases.is_empty() {
            return missing("cases", "such as case = \"film\"");
        }
        if self.text.parameters.is_empty() {
            return missing("parameters", "with path and values, or lower and upper");
        }
        let mut names = BTreeSet::new();
        for (index, parameter) in self.text.parameters.iter().enumerate() {
            let field = format!("parameters[{index}]");
            parameter.check(&field, self.text.design == Design::GRID)?;
            let name = parameter.name();
            if let Some(own) = &parameter.name {
                check_name(&format!("{field}.name"), own)?;
            }
            if !names.insert(name.clone()) || TAKEN.contains(&name.as_str()) {
                let remedy = "give each a `name` of its own that is no column of the results";
                return Err(FieldError::new(&format!("{field}.name"), name, "unique", remedy));
            }
            if self.text.parameters[..index].iter().any(|other| other.path == parameter.path) {
                let field = format!("{field}.path");
                return Err(FieldError::new(&field, "given twice", "unique", "vary a path once"));
            }
            for request in &self.text.cases {
                if parameter.path.in_case(&request.case).is_none() {
                    let remedy = format!("add {} = \"…\"", request.case);
                    return Err(FieldError::new(&format!("{field}.path"), "a table", "one with every case", &remedy));
                }
            }
        }
        for (index, request) in self.text.cases.iter().enumerate() {
            if let Some(name) = &request.name {
                check_name(&format!("cases[{index}].name"), name)?;
            }
            if self.text.cases[..index].iter().any(|other| other.label() == request.label()) {
                let (rule, remedy) = ("unique", "give a case that stands twice a `name` each time");
                return Err(FieldError::new(&format!("cases[{index}].name"), request.label(), rule, remedy));
            }
        }
        match self.text.design {
            Design::Word(Word::Grid) => {
                let levels = |parameter: &SweptParameter| {
                    parameter.values.as_ref().map_or_else(|| parameter.levels.unwrap_or(1), Vec::len)
                };
                let product = self.text.parameters.iter().try_fold(1usize, |product, parameter| {
                    product.checked_mul(levels(parameter)).filter(|product| *product <= MOST_RUNS)
                });
                let rule = format!("a grid of at most {MOST_RUNS} points");
                let too_many =
                    || FieldError::new("parameters", "too many values", &rule, "take fewer values or levels");
                product.map(|_| ()).ok_or_else(too_many)
            }
            Design::Spread(design) => {
                let (points, most) = match design {
                    SpaceFillingDesign::LatinHypercube { points, .. } => (points, MOST_RUNS),
                    SpaceFillingDesign::Sobol { points, .. } => (points, MOST_SOBOL_POINTS),
                };
                if (1..=most).contains(&points) {
                    return Ok(());
                }
                let rule = format!("between 1 and {most}");
                Err(FieldError::new("design.points", points, &rule, "every point is one run of each case"))
            }
        }
    }

    /// One setting text a parameter, for every point.
    fn points(&self) -> Vec<Vec<String>> {
        let parameters = &self.text.parameters;
        let in_cube = |points: Vec<Vec<f64>>| -> Vec<Vec<String>> {
            let at =
                |(parameter, &coordinate): (&SweptParameter, &f64)| toml_number(parameter.bounds().value(coordinate));
            points.iter().map(|point| parameters.iter().zip(point).map(at).collect()).collect()
        };
        match self.text.design {
            Design::Word(Word::Grid) => {
                let values: Vec<Vec<String>> = parameters.iter().map(SweptParameter::grid).collect();
                let place = |levels: &[usize]| -> Vec<String> {
                    levels.iter().zip(&values).map(|(&level, values)| values[level].clone()).collect()
                };
                let counts: Vec<usize> = values.iter().map(Vec::len).collect();
                design::combinations(&counts).iter().map(|levels| place(levels)).collect()
            }
            Design::Spread(SpaceFillingDesign::LatinHypercube { points, seed }) => {
                in_cube(design::latin_hypercube(points, parameters.len(), seed))
            }
            Design::Spread(SpaceFillingDesign::Sobol { points, seed }) => {
                in_cube(design::sobol(points, parameters.len(), seed))
            }
        }
    }

    /// Every run with its checked parameters. A point that its case refuses is an entry too: it fails with the reason,
    /// unless all points do.
    ///
    /// # Errors
    /// A case's fields or a path that do not exist, or values that no run accepts or that all ask for more than `limits`.
    pub fn manifest(&self, registry: Registry, limits: Limits) -> Result<Manifest, SweepError> {
        let points = self.points();
        let runs = points.len() * self.text.cases.len();
        if runs > MOST_RUNS {
            let rule = format!("at most {MOST_RUNS} runs");
            return Err(FieldError::new("parameters", runs, &rule, "take fewer values").in_file(&self.file).into());
        }
        let mut entries = Vec::with_capacity(runs);
        let mut refusal = None;
        for (index, request) in self.text.cases.iter().enumerate() {
            let prepared = request.prepare(registry, &self.file, &[], limits);
            prepared.map_err(|error| error.of_block(&format!("cases[{index}]")))?;
            for point in &points {
                let setting = |(parameter, value): (&SweptParameter, &String)| {
                    format!("{}={value}", parameter.path.in_case(&request.case).unwrap_or_default())
                };
                let settings: Vec<String> = self.text.parameters.iter().zip(point).map(setting).collect();
                let number = entries.len() + 1;
                let folder = format!("{number:04}-{}", file_name(request.label()));
                let mut entry = SweepRun {
                    number,
                    case: request.case.clone(),
                    label: request.label().to_owned(),
                    tier: request.tier,
                    folder,
                    point: point.clone(),
                    key: String::new(),
                    particle_steps: 0.0,
                    parameters_toml: String::new(),
                    only: request.only.clone(),
                    refusal: None,
                };
                match request.prepare(registry, &self.file, &settings, limits) {
                    Ok(prepared) => {
                        entry.key = evaluation::key(prepared.as_ref());
                        entry.particle_steps = cost(prepared.as_ref());
                        entry.parameters_toml = prepared.parameters_toml().to_owned();
                    }
                    // a path or a type that is wrong is wrong at every point
                    Err(error @ ParameterError::Setting(_)) => {
                        return Err(PlanError::of(error, &self.file).into());
                    }
                    Err(error) => {
                        entry.refusal = Some(error.to_string());
                        refusal.get_or_insert(error);
                    }
                }
                entries.push(entry);
            }
        }
        match refusal {
            Some(error) if entries.iter().all(|entry| entry.refusal.is_some()) => Err(error.into()),
            _ => Ok(Manifest {
                source_hash: identity_or_unique(registry.origin()).to_owned(),
                parameters: self.text.parameters.iter().map(SweptParameter::name).collect(),
                metrics: self.text.metrics.clone(),
                entries,
            }),
        }
    }
}

/// A label as a file name.
fn file_name(label: &str) -> String {
    label.chars().map(|letter| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '-' }).collect()
}

fn cost(prepared: &dyn PreparedCase) -> f64 {
    let sum: f64 = (0..prepared.run_count()).map(|run| prepared.particle_steps(run)).sum();
    // JSON has no infinity
    sum.min(f64::MAX)
}

impl SweptParameter {
    fn name(&self) -> String {
        self.name.clone().unwrap_or_else(|| self.path.name())
    }

    fn bounds(&self) -> Bounds {
        Bounds { lower: self.lower.unwrap_or(f64::NAN), upper: self.upper.unwrap_or(f64::NAN), spacing: self.scale }
    }

    /// The values of a grid as TOML.
    fn grid(&self) -> Vec<String> {
        match (&self.values, self.levels) {
            (Some(values), _) => values.iter().map(Value::to_string).collect(),
            (None, levels) => {
                let points = design::full_grid(&[levels.unwrap_or(2)]);
                points.iter().map(|point| toml_number(self.bounds().value(point[0]))).collect()
            }
        }
    }

    fn check(&self, field: &str, grid: bool) -> Result<(), FieldError> {
        let has_range = self.lower.is_some() || self.upper.is_some();
        match (&self.values, has_range) {
            (Some(_), true) => {
                let remedy = "keep either the values or the range";
                Err(FieldError::new(&format!("{field}.values"), "given", "alone, without lower and upper", remedy))
            }
            (Some(values), false) if values.is_empty() => {
                Err(FieldError::new(&format!("{field}.values"), "[]", "at least one value", "list them"))
            }
            (Some(_), false) if !grid => {
                let remedy = "give lower and upper, or take design = \"grid\"";
                Err(FieldError::new(&format!("{field}.values"), "given", "absent outside a grid", remedy))
            }
            (Some(_), false) if self.levels.is_some() => {
                let remedy = "keep either the values or the levels";
                Err(FieldError::new(&format!("{field}.levels"), "given", "absent beside values", remedy))
            }
            (Some(values), false) => check_values(values, &format!("{field}.values")),
            (None, _) => {
                for (name, bound) in [("lower", self.lower), ("upper", self.upper)] {
                    if bound.is_none() {
                        let remedy = if grid { "or list `values`" } else { "give both bounds" };
                        return Err(FieldError::new(&format!("{field}.{name}"), "missing", "a number", remedy));
                    }
                }
                self.bounds().check().map_err(|error| FieldError::of_bounds(field, &error))?;
                match (self.levels, grid) {
                    (None, false) => Ok(()),
                    (Some(2..=MOST_RUNS), true) => check_levels(&self.grid(), &format!("{field}.levels")),
                    // the grid as a whole is refused
                    (Some(2..), true) => Ok(()),
                    (levels, _) => {
                        let shown = levels.map_or_else(|| "missing".to_owned(), |levels| levels.to_string());
                        let rule = if grid { "2 or more" } else { "absent outside a grid" };
                        let remedy = "the levels divide the range of a grid's parameter";
                        Err(FieldError::new(&format!("{field}.levels"), shown, rule, remedy))
                    }
                }
            }
        }
    }
}
