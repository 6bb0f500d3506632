//! A calibration that was read: cases, parameters with ranges, data, and what is held out.

use super::data::DatumText;
use crate::case::Limits;
use crate::evaluation::{CaseRequest, Paths, toml_number};
use crate::inference::{Budget, Loss, Method};
use crate::input::{FieldError, check_name, nearest};
use crate::sampling::Bounds;
use schemars::JsonSchema;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// More repeats than this cost more than they tell.
const MOST_REPEATS: usize = 100;

/// A parameter with its range.
#[derive(Debug, Clone, PartialEq)]
pub struct CalibratedParameter {
    /// Name in tables and figures.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Range and scale.
    pub bounds: Bounds,
    /// Start of the search.
    pub start: f64,
    /// The value that synthetic data were made with.
    pub truth: Option<f64>,
    /// Path of the parameter in the cases.
    pub path: Paths,
}

/// One of a few settings that are tried.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Name; in the variants of data, `{choice}` stands for it
    pub name: String,
    /// Lists of `path=value`, by case
    pub set: BTreeMap<String, Vec<String>>,
}

/// Repetition of every evaluation with several seeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Repeats {
    /// Seeds: 1, 2, … up to this.
    pub count: usize,
    /// Path of the seed in a case.
    pub path: Paths,
}

impl Repeats {
    /// Repeats from the fields of a plan.
    ///
    /// # Errors
    /// A number out of range, repeats beside choices, a path without repeats.
    pub(super) fn checked(count: Option<usize>, path: Option<Paths>, choices: &[Choice]) -> Result<Self, FieldError> {
        let count = count.unwrap_or(1);
        if !(1..=MOST_REPEATS).contains(&count) {
            let remedy = "give 3 to 5 seeds to estimate the scatter of runs";
            return Err(FieldError::new("repeats", count, &format!("between 1 and {MOST_REPEATS}"), remedy));
        }
        if count > 1 && !choices.is_empty() {
            return Err(FieldError::new("repeats", count, "1 with `choices`", "leave it out: choices are tried once"));
        }
        if count == 1 && path.is_some() {
            let remedy = "add a line such as `repeats = 3`, or remove `seed_path`";
            return Err(FieldError::finding("seed_path", "given without `repeats`", remedy));
        }
        Ok(Self { count, path: path.unwrap_or_else(|| Paths::Everywhere("seed".to_owned())) })
    }

    /// Path of the seed in a case, if evaluations are repeated.
    pub(super) fn path_in(&self, case: &str) -> Option<&str> {
        self.path.in_case(case).filter(|_| self.count > 1)
    }

    /// The words for a case that has no seed there.
    pub(super) fn seedless(&self, case: &str, path: &str) -> FieldError {
        let remedy = format!(
            "`bagnold show {case}` prints its fields; if only some cases have seeds, name them: \
             seed_path = {{ column-planar = \"seed\" }}"
        );
        FieldError::new("seed_path", path, &format!("the path of a seed in `{case}`"), &remedy)
    }
}

/// A case, and whether its data are fitted or only predicted.
#[derive(Debug, Clone, PartialEq)]
pub struct DataBlock {
    /// The case and what differs from its tier.
    pub request: CaseRequest,
    /// Whether its data are held out.
    pub held_out: bool,
    /// Whether the case is the name of a law, which is compared with points of its friction.
    pub is_law: bool,
    /// Dotted paths of the parameters that make the conditions of a block that is held out, numbers or lists of numbers.
    pub conditions: Option<Vec<String>>,
    /// Relative difference up to which two conditions are the same `[-]`.
    pub same_within: f64,
    /// Field of the block in the file, such as `fit[0]`.
    pub field: String,
    /// Data that the block is compared with.
    pub(super) data: Vec<DatumText>,
}

/// A calibration that was read.
#[derive(Debug, Clone)]
pub struct CalibrationPlan {
    /// File of the plan.
    pub file: PathBuf,
    /// Subject of the calibration, one line.
    pub title: String,
    /// Remarks for the reader of the page.
    pub note: String,
    /// Search method.
    pub method: Method,
    /// Budget of the search.
    pub budget: Budget,
    /// Loss function of the residuals.
    pub loss: Loss,
    /// Resource limits of one point.
    pub limits: Limits,
    /// Repetition of the evaluations with other seeds.
    pub repeats: Repeats,
    /// Evaluations beyond the search that may map the region of agreement.
    pub region_evaluations: usize,
    /// Trajectories of the screening; 0 for none.
    pub trajectories: usize,
    /// Calibrated parameters.
    pub parameters: Vec<CalibratedParameter>,
    /// Levels of a design's grid along each parameter; empty for a Sobol sequence.
    pub levels: Vec<usize>,
    /// Choices that are tried; empty for a search.
    pub choices: Vec<Choice>,
    /// Fitted blocks first.
    pub blocks: Vec<DataBlock>,
}

/// Points that a search and its region usually need, from the studies of exact films of one to three parameters.
pub fn usual_search(parameters: usize, starts: usize, region_evaluations: usize) -> usize {
    starts + region_evaluations / 2 + 4 * parameters * (parameters + 1)
}

impl CalibrationPlan {
    /// The settings of a block's case at a point of physical values.
    pub fn settings(&self, block: &DataBlock, values: &[f64]) -> Vec<String> {
        let setting = |(parameter, value): (&CalibratedParameter, &f64)| {
            let path = parameter.path.in_case(&block.request.case)?;
            Some(format!("{path}={}", toml_number(*value)))
        };
        self.parameters.iter().zip(values).filter_map(setting).collect()
    }

    /// Physical values of a point of the unit cube.
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        self.parameters.iter().zip(point).map(|(parameter, &u)| parameter.bounds.value(u)).collect()
    }

    /// Simulations that a calibration of as many parameters usually needs; 0 of choices, which are all queued at once.
    pub fn usual_evaluations(&self) -> usize {
        let count = self.parameters.len();
        if !self.choices.is_empty() {
            return 0;
        }
        let search = if self.levels.is_empty() {
            usual_search(count, self.budget.starts, self.region_evaluations)
        } else {
            self.levels.iter().product()
        };
        let held_out = self.blocks.iter().filter(|block| block.held_out).count();
        let fitted = self.blocks.len() - held_out;
        let searches = 1 + usize::from(self.repeats.count > 1);
        let screening = self.trajectories * (count + 1);
        // of what is held out: the best point and both ends of every interval
        (fitted * (searches * search + screening) + held_out * (1 + 2 * count)) * self.repeats.count
    }

    /// The start in the unit cube.
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.bounds.coordinate(parameter.start).clamp(0.0, 1.0)).collect()
    }

    /// Every case that a parameter's path or a choice names must be compared with data, and the other way round.
    pub(super) fn check_names(&self) -> Result<(), FieldError> {
        let cases: Vec<&str> = self.blocks.iter().map(|block| block.request.case.as_str()).collect();
        let known = |field: String, case: &str| {
            if cases.contains(&case) {
                return Ok(());
            }
            let guess = nearest(case, cases.iter().copied());
            let nothing_near = || "use a case of `fit` or `hold_out`".to_owned();
            let remedy = guess.map_or_else(nothing_near, |near| format!("did you mean `{near}`?"));
            Err(FieldError::new(&field, case, "a case with data in `fit` or `hold_out`", &remedy))
        };
        for (index, parameter) in self.parameters.iter().enumerate() {
            if let Paths::ByCase(paths) = &parameter.path {
                paths.keys().try_for_each(|case| known(format!("parameters[{index}].path"), case))?;
            }
            if self.parameters[..index].iter().any(|other| other.path == parameter.path) {
                let field = format!("parameters[{index}].path");
                return Err(FieldError::finding(&field, "given twice", "list each path once"));
            }
        }
        if let Paths::ByCase(paths) = &self.repeats.path {
            paths.keys().try_for_each(|case| known("seed_path".to_owned(), case))?;
            if !self.blocks.iter().any(|block| !block.held_out && paths.contains_key(&block.request.case)) {
                let remedy = "name a case of `fit` with the path of its seed, or leave out `repeats`";
                return Err(FieldError::finding("seed_path", "names no fitted case", remedy));
            }
        }
        for (index, choice) in self.choices.iter().enumerate() {
            let field = format!("choices[{index}]");
            check_name(&format!("{field}.name"), &choice.name)?;
            choice.set.keys().try_for_each(|case| known(format!("{field}.set"), case))?;
            if let Some(case) = cases.iter().find(|case| choice.in_case(case).is_empty()) {
                let remedy = format!("give the value that {} sets there", choice.name);
                let (field, rule) = (format!("{field}.set"), format!("given for `{case}`"));
                return Err(FieldError::new(&field, "incomplete", &rule, &remedy));
            }
            if self.choices[..index].iter().any(|other| other.name == choice.name) {
                return Err(FieldError::new(&format!("{field}.name"), &choice.name, "unique", "rename it"));
            }
        }
        Ok(())
    }
}

impl Choice {
    /// The settings of a case.
    pub fn in_case(&self, case: &str) -> Vec<String> {
        self.set.get(case).cloned().unwrap_or_default()
    }
}
