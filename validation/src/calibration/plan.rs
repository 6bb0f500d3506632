//! A calibration as a TOML file.

use super::conditions::{self, Conditions, Known};
use super::data::DatumText;
use super::error::CalibrationError;
use super::repeats::Repeats;
use super::text::Text;
use crate::case::{Limits, Registry};
use crate::evaluation::{CaseRequest, Paths, PlanError, read_plan, toml_number};
use crate::inference::{Budget, Loss, Method};
use crate::input::{FieldError, check_name, nearest};
use crate::sampling::Bounds;
use crate::store::Store;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A parameter with its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name in tables and figures.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Range and scale.
    pub bounds: Bounds,
    /// Where the search begins.
    pub start: f64,
    /// The value that synthetic data were made with.
    pub truth: Option<f64>,
    /// Where it stands.
    pub path: Paths,
}

/// One of a few settings that are tried.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Name; in the data's variants, `{choice}` stands for it.
    pub name: String,
    /// `path=value` settings by case.
    pub set: BTreeMap<String, Vec<String>>,
}

/// A case, and whether its data are fitted or only predicted.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The case and what differs from its tier.
    pub request: CaseRequest,
    /// Whether its data are held out.
    pub held_out: bool,
    /// What makes its conditions, if it is held out.
    pub conditions: Option<Conditions>,
    /// Where it stands in the file, such as `fit[0]`.
    pub field: String,
}

/// A calibration that was read.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The file.
    pub file: PathBuf,
    /// What is calibrated, one line.
    pub title: String,
    /// What a reader of the page must know.
    pub note: String,
    /// How the minimum is looked for.
    pub method: Method,
    /// What the search may spend.
    pub budget: Budget,
    /// What a residual costs.
    pub loss: Loss,
    /// How much one point may ask for.
    pub limits: Limits,
    /// How often evaluations are repeated with other seeds.
    pub repeats: Repeats,
    /// Evaluations beyond the search that may map the region of agreement.
    pub region_evaluations: usize,
    /// Trajectories of the screening; 0 for none.
    pub trajectories: usize,
    /// What is sought.
    pub parameters: Vec<Parameter>,
    /// Levels of a design's grid along each parameter; empty for a Sobol sequence.
    pub levels: Vec<usize>,
    /// What is tried; empty for a search.
    pub choices: Vec<Choice>,
    /// Fitted blocks first.
    pub blocks: Vec<Block>,
    /// The data of each block.
    pub(super) data: Vec<Vec<DatumText>>,
}

impl Plan {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// A file that cannot be read or typed, ranges that break a rule, a case or a path that does not exist, a run that is
    /// in both fit and hold-out.
    pub fn read(file: &Path, registry: Registry, limits: Limits) -> Result<Self, CalibrationError> {
        let text: Text = read_plan(file, "calibrate")?;
        let plan = text.checked(file, limits).map_err(|error| error.in_file(file))?;
        plan.check_cases(registry)?;
        plan.check_data()?;
        Ok(plan)
    }

    /// The settings of a block's case at a point of physical values.
    #[must_use]
    pub fn settings(&self, block: &Block, values: &[f64]) -> Vec<String> {
        let path = |paths: &Paths| paths.in_case(&block.request.case).map(str::to_owned);
        self.parameters
            .iter()
            .zip(values)
            .filter_map(|(parameter, &value)| {
                path(&parameter.path).map(|path| format!("{path}={}", toml_number(value)))
            })
            .collect()
    }

    /// Physical values of a point of the unit cube.
    #[must_use]
    pub fn values(&self, point: &[f64]) -> Vec<f64> {
        self.parameters.iter().zip(point).map(|(parameter, &u)| parameter.bounds.value(u)).collect()
    }

    /// The method in words, with what every evaluation is the mean of.
    pub(super) fn method_name(&self) -> String {
        match self.repeats.count {
            1 => self.method.name().to_owned(),
            count => format!("{}, every evaluation the mean of {count} seeds", self.method.name()),
        }
    }

    /// The start in the unit cube.
    #[must_use]
    pub fn start(&self) -> Vec<f64> {
        self.parameters.iter().map(|parameter| parameter.bounds.coordinate(parameter.start).clamp(0.0, 1.0)).collect()
    }

    /// Every case that a parameter's path or a choice names must be compared with data, and the other way round.
    fn check_names(&self) -> Result<(), FieldError> {
        let cases: Vec<&str> = self.blocks.iter().map(|block| block.request.case.as_str()).collect();
        let known = |field: String, case: &str| {
            if cases.contains(&case) {
                return Ok(());
            }
            let guess = nearest(case, cases.iter().copied());
            let remedy = guess.map_or_else(
                || "use a case of `fit` or `hold_out`".to_owned(),
                |near| format!("did you mean `{near}`?"),
            );
            Err(FieldError::new(&field, case, "a case that has data", &remedy))
        };
        for (index, parameter) in self.parameters.iter().enumerate() {
            if let Paths::ByCase(paths) = &parameter.path {
                paths.keys().try_for_each(|case| known(format!("parameters[{index}].path"), case))?;
            }
            if self.parameters[..index].iter().any(|other| other.path == parameter.path) {
                let field = format!("parameters[{index}].path");
                return Err(FieldError::new(&field, "given twice", "unlike the others", "vary a path once"));
            }
        }
        if let Paths::ByCase(paths) = &self.repeats.path {
            paths.keys().try_for_each(|case| known("seed_path".to_owned(), case))?;
            if !self.blocks.iter().any(|block| !block.held_out && paths.contains_key(&block.request.case)) {
                let remedy = "name a case of `fit` with the path of its seed, or leave out `repeats`";
                return Err(FieldError::new("seed_path", "of no fitted case", "that of one at least", remedy));
            }
        }
        for (index, choice) in self.choices.iter().enumerate() {
            let field = format!("choices[{index}]");
            check_name(&format!("{field}.name"), &choice.name)?;
            choice.set.keys().try_for_each(|case| known(format!("{field}.set"), case))?;
            if let Some(case) = cases.iter().find(|case| choice.in_case(case).is_empty()) {
                let remedy = format!("say what {} sets there", choice.name);
                return Err(FieldError::new(
                    &format!("{field}.set"),
                    "incomplete",
                    &format!("given for `{case}`"),
                    &remedy,
                ));
            }
            if self.choices[..index].iter().any(|other| other.name == choice.name) {
                return Err(FieldError::new(&format!("{field}.name"), &choice.name, "unlike the others", "rename it"));
            }
        }
        Ok(())
    }

    /// The data's files are read before the folder of the calibration is touched, so that a bad one leaves nothing behind.
    fn check_data(&self) -> Result<(), CalibrationError> {
        let mut texts =
            self.data.iter().enumerate().flat_map(|(block, texts)| texts.iter().map(move |text| (block, text)));
        texts.try_for_each(|(block, text)| text.read(block, &self.file).map(drop))
    }

    fn check_cases(&self, registry: Registry) -> Result<(), CalibrationError> {
        self.check_names().map_err(|error| error.in_file(&self.file))?;
        let start: Vec<f64> = self.parameters.iter().map(|parameter| parameter.start).collect();
        let store = Store::open(crate::store::StorePolicy::Use);
        let mut fitted: BTreeMap<String, String> = BTreeMap::new();
        let mut known = Vec::new();
        for block in &self.blocks {
            let settings = self.settings(block, &start);
            if settings.is_empty() && self.choices.is_empty() {
                let remedy = "let a parameter name a path of the case";
                let field = format!("{}.case", block.field);
                return Err(FieldError::new(&field, &block.request.case, "a case with a parameter", remedy)
                    .in_file(&self.file)
                    .into());
            }
            let prepare = |settings: &[String]| {
                let prepared = block.request.prepare(registry, &self.file, settings, self.limits);
                prepared.map_err(|error| PlanError::of(error, &self.file))
            };
            for choice in &self.choices {
                prepare(&choice.in_case(&block.request.case))?;
            }
            let mut first = self.choices.first().map_or(settings, |choice| choice.in_case(&block.request.case));
            let mut prepared = prepare(&first)?;
            if let Some(path) = self.repeats.path_in(&block.request.case) {
                first.push(format!("{path}=1"));
                prepared = prepare(&first)
                    .map_err(|_| self.repeats.seedless(&block.request.case, path).in_file(&self.file))?;
            }
            for run in 0..prepared.run_count() {
                let Some(identity) = prepared.identity(run, &store) else { continue };
                if !block.held_out {
                    fitted.insert(identity, block.field.clone());
                } else if let Some(field) = fitted.get(&identity) {
                    return Err(CalibrationError::InBoth {
                        file: self.file.clone(),
                        run: format!("{} {}", prepared.name(), prepared.variant(run)).trim_end().to_owned(),
                        fit: field.clone(),
                        hold_out: block.field.clone(),
                    });
                }
            }
            // what the program itself wrote can be read
            let parameters = toml::from_str(prepared.parameters_toml()).unwrap_or_default();
            known.push(Known { block, parameters });
        }
        conditions::check(self, &known)
    }
}

impl Choice {
    /// The settings of a case.
    #[must_use]
    pub fn in_case(&self, case: &str) -> Vec<String> {
        self.set.get(case).cloned().unwrap_or_default()
    }
}
