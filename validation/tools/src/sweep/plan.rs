//! A sweep as a TOML file.

use super::manifest::{Manifest, SweepRun};
use crate::ToolError;
use crate::case::list::ListedChange;
use crate::case::{Limits, ListOfRuns, Registry, VariedParameter};
use crate::evaluation::{self, CaseRequest, Paths, read_plan};
use crate::input::{FieldError, check_name};
use crate::measured::read_overlay;
use crate::metric::Variant;
use crate::sampling::{Bounds, Spacing, design};
use crate::store::identity_or_unique;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
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
    vary: Vec<SweptParameter>,
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
    pub fn read(file: &Path) -> Result<Self, ToolError> {
        let mut text: SweepText = read_plan(file, "bagnold sweep")?;
        for request in &mut text.cases {
            *request = request.clone().based(file).map_err(|error| error.in_file(file))?;
        }
        let plan = Self { file: file.to_owned(), text };
        plan.check().map_err(|error| error.in_file(file))?;
        Ok(plan)
    }

    fn check(&self) -> Result<(), FieldError> {
        let missing = |field: &str, example: &str| {
            Err(FieldError::finding(field, "no table", &format!("add a `[[{field}]]` table, {example}")))
        };
        if self.text.cases.is_empty() {
            return missing("cases", "such as case = \"film\"");
        }
        if self.text.vary.is_empty() {
            return missing("vary", "with path and values, or lower and upper");
        }
        for (index, varied) in self.text.vary.iter().enumerate() {
            let field = format!("vary[{index}]");
            varied.check(&field, self.text.design == Design::GRID)?;
            let name = varied.name();
            if TAKEN.contains(&name.as_str()) {
                let defect = format!("\"{name}\" is a column of the results");
                return Err(FieldError::finding(&format!("{field}.name"), defect, "give it another `name`"));
            }
            for request in &self.text.cases {
                if varied.path.in_case(&request.case).is_none() {
                    let remedy = format!("add {} = \"…\"", request.case);
                    let defect = format!("no path for the case {}", request.case);
                    return Err(FieldError::finding(&format!("{field}.path"), defect, &remedy));
                }
            }
        }
        for (index, request) in self.text.cases.iter().enumerate() {
            if let Some(name) = &request.name {
                check_name(&format!("cases[{index}].name"), name)?;
            }
            if self.text.cases[..index].iter().any(|other| other.label() == request.label()) {
                let (rule, remedy) = ("unique", "give each entry of the same case another `name`");
                return Err(FieldError::new(&format!("cases[{index}].name"), request.label(), rule, remedy));
            }
        }
        for request in &self.text.cases {
            self.list(&request.case).check_at_most(MOST_RUNS, "list fewer values or levels")?;
        }
        let (points, most) = match self.text.design {
            Design::Word(Word::Grid) => return Ok(()),
            Design::Spread(SpaceFillingDesign::LatinHypercube { points, .. }) => (points, MOST_RUNS),
            Design::Spread(SpaceFillingDesign::Sobol { points, .. }) => (points, MOST_SOBOL_POINTS),
        };
        if (1..=most).contains(&points) {
            return Ok(());
        }
        let rule = format!("between 1 and {most}");
        Err(FieldError::new("design.points", points, &rule, "correct the number; every point is one run of each case"))
    }

    /// The list of a grid's points in a case. Outside a grid it stands for the names and paths alone.
    fn list(&self, case: &str) -> ListOfRuns {
        let listed = |varied: &SweptParameter| VariedParameter {
            path: varied.path.in_case(case).unwrap_or_default().to_owned(),
            name: Some(varied.name()),
            values: if self.text.design == Design::GRID {
                varied.grid()
            } else {
                varied.lower.into_iter().map(Value::from).collect()
            },
            paper: None,
            fine: None,
        };
        ListOfRuns { variants: Vec::new(), vary: self.text.vary.iter().map(listed).collect() }
    }

    /// The values of every point, by their paths in a case.
    fn points(&self, case: &str) -> Vec<ListedChange> {
        let (list, axes) = (self.list(case), self.text.vary.len());
        let points = match self.text.design {
            Design::Word(Word::Grid) => return list.changes(),
            Design::Spread(SpaceFillingDesign::LatinHypercube { points, seed }) => {
                design::latin_hypercube(points, axes, seed)
            }
            Design::Spread(SpaceFillingDesign::Sobol { points, seed }) => design::sobol(points, axes, seed),
        };
        let change = |point: Vec<f64>| {
            let values = self.text.vary.iter().zip(&list.vary).zip(point).map(|((varied, listed), coordinate)| {
                (String::new(), listed.path.clone(), varied.bounds().value(coordinate).into())
            });
            ListedChange { variant: Variant::default(), values: values.collect() }
        };
        points.into_iter().map(change).collect()
    }

    /// Every run with its checked parameters. A point that its case refuses is an entry too: it fails with the reason,
    /// unless all points do.
    ///
    /// # Errors
    /// A case's fields or a path that do not exist, or values that no run accepts or that all ask for more than `limits`.
    pub fn manifest(&self, registry: Registry, limits: Limits) -> Result<Manifest, ToolError> {
        let points: Vec<Vec<ListedChange>> = self.text.cases.iter().map(|request| self.points(&request.case)).collect();
        let runs: usize = points.iter().map(Vec::len).sum();
        if runs > MOST_RUNS {
            let defect = format!("{runs} runs, above the limit of {MOST_RUNS}");
            return Err(FieldError::finding("vary", defect, "list fewer values").in_file(&self.file).into());
        }
        let mut entries = Vec::with_capacity(runs);
        let (mut refusal, mut overlay) = (None, BTreeMap::new());
        for (index, (request, points)) in self.text.cases.iter().zip(points).enumerate() {
            let prepared = request.prepare(registry, &self.file, &[], limits);
            let prepared = prepared.map_err(|error| error.of_block(&format!("cases[{index}]")))?;
            let measured = read_overlay(prepared.as_ref(), &request.overlay, &[])?;
            for point in points {
                let settings: Vec<String> = point.settings().collect();
                let number = entries.len() + 1;
                let folder = format!("{number:04}-{}", file_name(request.label()));
                let mut entry = SweepRun {
                    number,
                    case: request.case.clone(),
                    label: request.label().to_owned(),
                    tier: request.tier.unwrap_or_default(),
                    folder,
                    point: point.values.iter().map(|(.., value)| value.to_string()).collect(),
                    only: request.only.clone(),
                    ..SweepRun::default()
                };
                match request.prepare(registry, &self.file, &settings, limits) {
                    Ok(prepared) => {
                        entry.key = evaluation::key(prepared.as_ref(), &measured);
                        // JSON has no infinity
                        entry.particle_steps = prepared.estimate_of_all().particle_steps.min(f64::MAX);
                        entry.parameters_toml = prepared.parameters_toml().to_owned();
                    }
                    // a path or a type that is wrong is wrong at every point
                    Err(error) if error.is_of_setting() => return Err(error.in_plan(&self.file).into()),
                    Err(error) => {
                        entry.refusal = Some(error.to_string());
                        refusal.get_or_insert(error);
                    }
                }
                entries.push(entry);
            }
            if !measured.is_empty() {
                overlay.insert(request.label().to_owned(), measured);
            }
        }
        match refusal {
            Some(error) if entries.iter().all(|entry| entry.refusal.is_some()) => Err(error.into()),
            _ => Ok(Manifest {
                source_hash: identity_or_unique(registry.origin()).to_owned(),
                parameters: self.text.vary.iter().map(SweptParameter::name).collect(),
                metrics: self.text.metrics.clone(),
                overlay,
                entries,
            }),
        }
    }
}

/// A label as a file name.
fn file_name(label: &str) -> String {
    label.chars().map(|letter| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '-' }).collect()
}

impl SweptParameter {
    fn name(&self) -> String {
        self.name.clone().unwrap_or_else(|| self.path.name())
    }

    fn bounds(&self) -> Bounds {
        Bounds { lower: self.lower.unwrap_or(f64::NAN), upper: self.upper.unwrap_or(f64::NAN), spacing: self.scale }
    }

    /// The values of a grid.
    fn grid(&self) -> Vec<Value> {
        let levels = || {
            let points = design::full_grid(&[self.levels.unwrap_or(2)]);
            points.iter().map(|point| self.bounds().value(point[0]).into()).collect()
        };
        self.values.clone().unwrap_or_else(levels)
    }

    /// Refuses values beside a range, and what does not fit the design.
    fn check(&self, field: &str, grid: bool) -> Result<(), FieldError> {
        let refused = |name: &str, value: String, rule: &str, remedy: &str| {
            Err(FieldError::new(&format!("{field}.{name}"), value, rule, remedy))
        };
        let range =
            [("lower", self.lower.is_some()), ("upper", self.upper.is_some()), ("levels", self.levels.is_some())];
        if self.values.is_some() {
            return match range.iter().find(|(_, given)| *given) {
                _ if !grid => {
                    let remedy = "give lower and upper, or choose design = \"grid\"";
                    refused("values", "only for design = \"grid\"".to_owned(), "", remedy)
                }
                Some((name, _)) => refused(name, "given together with `values`".to_owned(), "", "keep one of the two"),
                None => Ok(()),
            };
        }
        if let Some((name, _)) = range[..2].iter().find(|(_, given)| !given) {
            let remedy = if grid { "give both bounds, or list `values`" } else { "give both bounds" };
            return refused(name, "missing".to_owned(), "", remedy);
        }
        self.bounds().check().map_err(|error| FieldError::of_bounds(field, &error))?;
        match (self.levels, grid) {
            (None, false) => Ok(()),
            (Some(levels @ 2..=MOST_RUNS), true) => match self.grid().windows(2).find(|pair| pair[0] == pair[1]) {
                None => Ok(()),
                Some(pair) => {
                    let defect = format!("{levels} levels are too close together: several are {}", pair[0]);
                    refused("levels", defect, "", "give fewer levels, or a wider range")
                }
            },
            (levels, _) => {
                let shown = levels.map_or_else(|| "missing".to_owned(), |levels| levels.to_string());
                let rule =
                    if grid { format!("between 2 and {MOST_RUNS}") } else { "left out, without grid".to_owned() };
                refused("levels", shown, &rule, "give the number of grid values from `lower` to `upper`")
            }
        }
    }
}
