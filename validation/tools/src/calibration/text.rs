//! A calibration as it is written: what its numbers and lists must satisfy before any case is looked at.

use super::data::DatumText;
use super::plan::{CalibratedParameter, CalibrationPlan, Choice, DataBlock, Repeats};
use crate::case::{Limits, Tier};
use crate::evaluation::{CaseRequest, Paths};
use crate::inference::{Budget, Loss, Method};
use crate::input::{FieldError, check_name, check_text};
use crate::metric::Variant;
use crate::sampling::{Bounds, Spacing};
use schemars::JsonSchema;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Evaluations of formulas over those of simulations, where none are given.
const FORMULA: usize = 10;
/// More evaluations than this are a slip of the pen.
const MOST_EVALUATIONS: usize = 10_000;

/// The same for the screening, each of whose trajectories costs one evaluation more than there are parameters.
const MOST_TRAJECTORIES: usize = 1000;

/// Relative difference up to which two conditions are the same, unless the plan says otherwise.
const SAME_WITHIN: f64 = 0.01;

/// One parameter that is sought.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ParameterText {
    /// Dotted path of the parameter, or a table of paths by case
    path: Paths,
    /// Name on the page; the last key of the path, if it is left out
    name: Option<String>,
    /// Unit of the parameter
    #[serde(default = "none")]
    unit: String,
    /// Lowest value that the search tries
    lower: f64,
    /// Highest value that the search tries
    upper: f64,
    /// Division of the range
    #[serde(default)]
    #[schemars(extend("enum" = ["linear", "log"]), with = "String")]
    scale: Spacing,
    /// First value that is tried; the middle of the range, if it is left out
    start: Option<f64>,
    /// Value that synthetic data are made with
    truth: Option<f64>,
    /// Points along this parameter of a grid in place of a search; for all parameters or none
    levels: Option<usize>,
}

/// A case and what is compared with it.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct BlockText {
    /// Case that is run; may be left out beside `base` or `law`
    #[serde(default)]
    case: String,
    /// Law, such as `"mu-i"`, whose friction over the inertial number is compared with points of a file, without a run
    law: Option<String>,
    /// A case file with the base values, beside the plan
    base: Option<PathBuf>,
    /// Tier that supplies parameters missing in `with`
    tier: Option<Tier>,
    /// Parameters, as in a case file
    #[serde(default)]
    #[schemars(with = "BTreeMap<String, Value>")]
    with: toml::Table,
    /// Runs that are needed, as `key=value`; all of the case, if it is left out
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    only: Vec<Variant>,
    /// Parameters that a `hold_out` block has otherwise than the fitted ones
    conditions: Option<Vec<String>>,
    /// Relative difference up to which two conditions are the same, 0.01 if it is left out `[-]`
    same_within: Option<f64>,
    /// Data that are compared
    data: Vec<DatumText>,
}

#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CalibrationText {
    /// Subject, one line
    title: String,
    /// Remark for the reader of the page
    #[serde(default)]
    note: String,
    /// Search method; `trust-region`, if it is left out
    #[schemars(extend("enum" = ["trust-region", "posterior", "design"]), with = "Option<String>")]
    method: Option<Method>,
    /// Most evaluations of the search for the best point, 40 if it is left out, of laws alone 400
    evaluations: Option<usize>,
    /// Seed of the starting points
    seed: Option<u64>,
    /// Step of numerical derivatives over the range, 0.02 if it is left out `[-]`
    difference: Option<f64>,
    /// Fall of χ² below which the search ends, 0.01 if it is left out `[-]`
    tolerance: Option<f64>,
    /// Trajectories of Morris' screening
    #[serde(default)]
    trajectories: usize,
    /// Most evaluations for intervals and joint region, anew where a lower point turns up; 16 per parameter if it is left out, of laws alone 160
    region_evaluations: Option<usize>,
    /// Starting points; 2 + 2 per parameter, if it is left out
    starts: Option<usize>,
    /// Loss of a residual; `huber` bounds the weight of outliers
    #[serde(default)]
    #[schemars(extend("enum" = ["squares", "huber"]), with = "String")]
    loss: Loss,
    /// Seeds that every evaluation is the mean of
    repeats: Option<usize>,
    /// Path of the seed; `seed`, if it is left out
    seed_path: Option<Paths>,
    /// Parameters that are sought
    #[serde(default)]
    parameters: Vec<ParameterText>,
    /// Settings that are ranked in place of a search
    #[serde(default)]
    choices: Vec<Choice>,
    /// Cases and data that are fitted
    #[serde(default)]
    fit: Vec<BlockText>,
    /// Cases and data that judge the fit, with the fields of `fit`
    #[serde(default)]
    hold_out: Vec<BlockText>,
}

fn none() -> String {
    "-".to_owned()
}

impl CalibrationText {
    /// The plan, unless its own numbers or lists break a rule.
    pub(super) fn checked(self, file: &Path, limits: Limits) -> Result<CalibrationPlan, FieldError> {
        self.check_lists()?;
        let parameters = self.parameters()?;
        let levels = self.levels()?;
        let mut budget = self.budget()?;
        let repeats = Repeats::checked(self.repeats, self.seed_path.clone(), &self.choices)?;
        let method = match (self.method, levels.is_empty()) {
            (Some(method), false) if method != Method::Design => {
                let remedy = "leave one of the two out, or set method = \"design\"";
                return Err(FieldError::finding("method", "does not fit the `levels` of a grid", remedy));
            }
            (_, false) => Method::Design,
            (method, true) => method.unwrap_or(Method::TrustRegion),
        };
        // a grid covers the whole range already
        let usual = if levels.is_empty() { 16 * parameters.len() } else { 0 };
        let local = matches!(method, Method::TrustRegion | Method::Posterior);
        let usual_starts = if local && !parameters.is_empty() { 2 * parameters.len() + 2 } else { 0 };
        budget.starts = self.starts.unwrap_or(usual_starts);
        let blocks = blocks(self.fit, self.hold_out)?;
        // a formula costs nothing
        let more = if blocks.iter().all(|block| block.is_law) { FORMULA } else { 1 };
        if self.evaluations.is_none() {
            budget.evaluations *= more;
        }
        Ok(CalibrationPlan {
            file: file.to_owned(),
            title: self.title,
            note: self.note,
            method,
            budget,
            loss: self.loss,
            limits,
            repeats,
            trajectories: self.trajectories,
            region_evaluations: self.region_evaluations.unwrap_or(more * usual),
            parameters,
            levels,
            choices: self.choices,
            blocks,
        })
    }

    /// Data to fit, and either parameters or choices.
    fn check_lists(&self) -> Result<(), FieldError> {
        if self.fit.is_empty() {
            let remedy = "add a `[[fit]]` table with case and data";
            return Err(FieldError::finding("fit", "no table", remedy));
        }
        if self.parameters.is_empty() == self.choices.is_empty() {
            let (defect, remedy) = if self.choices.is_empty() {
                ("no table", "add a `[[parameters]]` table with path, lower and upper, or `[[choices]]`")
            } else {
                ("given together with `choices`", "calibrate the parameters of each choice in a separate file")
            };
            return Err(FieldError::finding("parameters", defect, remedy));
        }
        if self.choices.len() == 1 {
            let remedy = "list two or more that are compared";
            return Err(FieldError::finding("choices", "a single choice", remedy));
        }
        Ok(())
    }

    fn parameters(&self) -> Result<Vec<CalibratedParameter>, FieldError> {
        let mut parameters: Vec<CalibratedParameter> = Vec::new();
        for (index, text) in self.parameters.iter().enumerate() {
            let parameter = text.checked(&format!("parameters[{index}]"))?;
            if parameters.iter().any(|other| other.name == parameter.name) {
                let field = format!("parameters[{index}].name");
                return Err(FieldError::new(&field, &parameter.name, "unique", "give each another name"));
            }
            parameters.push(parameter);
        }
        Ok(parameters)
    }

    /// Levels along each parameter; none without a grid.
    fn levels(&self) -> Result<Vec<usize>, FieldError> {
        let levels: Vec<usize> = self.parameters.iter().filter_map(|parameter| parameter.levels).collect();
        if !levels.is_empty() && levels.len() < self.parameters.len() {
            let remedy = "give `levels` for all parameters, or for none";
            return Err(FieldError::finding("parameters.levels", "given for some parameters only", remedy));
        }
        let points = levels.iter().try_fold(1usize, |product, count| product.checked_mul(*count));
        if points.is_none_or(|points| points > MOST_EVALUATIONS) {
            let defect = format!("the grid has more than {MOST_EVALUATIONS} points");
            return Err(FieldError::finding("parameters.levels", defect, "give fewer levels"));
        }
        Ok(levels)
    }

    /// Budget of the search.
    fn budget(&self) -> Result<Budget, FieldError> {
        for (name, value, most) in [
            ("evaluations", self.evaluations.unwrap_or(1), MOST_EVALUATIONS),
            ("region_evaluations", self.region_evaluations.unwrap_or(0), MOST_EVALUATIONS),
            ("starts", self.starts.unwrap_or(0), MOST_EVALUATIONS),
            ("trajectories", self.trajectories, MOST_TRAJECTORIES),
        ] {
            if value > most {
                return Err(FieldError::new(name, value, &format!("at most {most}"), "each costs a simulation"));
            }
        }
        if self.evaluations == Some(0) {
            return Err(FieldError::new("evaluations", 0, "at least 1", "give 25 for three parameters"));
        }
        for (name, value, least, most, remedy) in [
            ("difference", self.difference, 1e-6, 0.5, "give 0.02 for 2 % of a range, more where runs scatter"),
            ("tolerance", self.tolerance, 1e-9, 1e6, "give 0.01 of χ², far below one standard deviation"),
        ] {
            if let Some(value) = value.filter(|value| !(least..=most).contains(value)) {
                return Err(FieldError::new(name, value, &format!("between {least} and {most}"), remedy));
            }
        }
        let default = Budget::default();
        Ok(Budget {
            evaluations: self.evaluations.unwrap_or(default.evaluations),
            seed: self.seed.unwrap_or(default.seed),
            difference: self.difference.unwrap_or(default.difference),
            tolerance: self.tolerance.unwrap_or(default.tolerance),
            starts: 0,
        })
    }
}

/// Blocks and their data, fitted ones first.
fn blocks(fit: Vec<BlockText>, hold_out: Vec<BlockText>) -> Result<Vec<DataBlock>, FieldError> {
    let mut blocks: Vec<DataBlock> = Vec::new();
    for (kind, held_out, texts) in [("fit", false, fit), ("hold_out", true, hold_out)] {
        for (index, mut block) in texts.into_iter().enumerate() {
            let field = format!("{kind}[{index}]");
            block.fill_law(&field)?;
            if block.data.is_empty() {
                let remedy = "add the data that the case is compared with";
                return Err(FieldError::finding(&format!("{field}.data"), "no entry", remedy));
            }
            for (place, datum) in block.data.iter().enumerate() {
                let field = format!("{field}.data[{place}]");
                datum.check(&field)?;
                let mut fitted = blocks.iter().filter(|block| !block.held_out).flat_map(|block| &block.data);
                if held_out && fitted.any(|fitted| datum.is_same(fitted)) {
                    let remedy = "remove it from one: held-out data must not be fitted";
                    return Err(FieldError::finding(&field, "both fitted and held out", remedy));
                }
            }
            block.check_conditions(&field, held_out)?;
            let BlockText { case, law, base, tier, with, only, conditions, same_within, data } = block;
            let same_within = same_within.unwrap_or(SAME_WITHIN);
            let is_law = law.is_some();
            let request = CaseRequest { case: law.unwrap_or(case), base, tier, with, only, ..CaseRequest::default() };
            blocks.push(DataBlock { request, held_out, is_law, conditions, same_within, field, data });
        }
    }
    Ok(blocks)
}

impl BlockText {
    /// Gives the data of a law its table, and refuses what only a case has.
    fn fill_law(&mut self, field: &str) -> Result<(), FieldError> {
        let is_of_case = !self.case.is_empty() || self.base.is_some() || !self.only.is_empty();
        if self.law.is_none() || !is_of_case && self.data.iter_mut().all(DatumText::fill_law) {
            return Ok(());
        }
        let remedy = "leave `case`, `base` and `only` out, and give data such as data = [{ file = \"points.csv\" }]";
        Err(FieldError::finding(&format!("{field}.law"), "given together with entries for a case", remedy))
    }

    /// Refuses conditions that do not belong to the block, or name nothing.
    fn check_conditions(&self, field: &str, held_out: bool) -> Result<(), FieldError> {
        let given = [("conditions", self.conditions.is_some()), ("same_within", self.same_within.is_some())];
        if let Some((name, _)) = given.iter().find(|(_, given)| *given && !held_out) {
            let field = format!("{field}.{name}");
            return Err(FieldError::finding(&field, "for held-out data only", "leave it out"));
        }
        if let Some(same_within) = self.same_within.filter(|within| !(0.0..1.0).contains(within)) {
            let remedy = "give 0.01 for 1 %";
            return Err(FieldError::new(&format!("{field}.same_within"), same_within, "from 0 to below 1", remedy));
        }
        if self.conditions.as_ref().is_some_and(Vec::is_empty) {
            let remedy = "name the parameters that make its conditions, such as [\"slope_angle\"]";
            return Err(FieldError::finding(&format!("{field}.conditions"), "no path", remedy));
        }
        Ok(())
    }
}

impl ParameterText {
    fn checked(&self, field: &str) -> Result<CalibratedParameter, FieldError> {
        let bounds = Bounds { lower: self.lower, upper: self.upper, spacing: self.scale };
        bounds.check().map_err(|error| FieldError::of_bounds(field, &error))?;
        let start = self.start.unwrap_or_else(|| bounds.value(0.5));
        let rule = format!("between {} and {}", self.lower, self.upper);
        if !(start >= self.lower && start <= self.upper) {
            return Err(FieldError::new(&format!("{field}.start"), start, &rule, "give a start within the bounds"));
        }
        if let Some(levels) = self.levels.filter(|&levels| levels < 2) {
            return Err(FieldError::new(&format!("{field}.levels"), levels, "2 or more", "raise it, or leave it out"));
        }
        if let Some(name) = &self.name {
            check_name(&format!("{field}.name"), name)?;
        }
        check_text(&format!("{field}.unit"), &self.unit)?;
        let is_angle = self.unit == "-" && self.path.name() == "friction_angle";
        Ok(CalibratedParameter {
            name: self.name.clone().unwrap_or_else(|| self.path.name()),
            unit: if is_angle { "°".to_owned() } else { self.unit.clone() },
            bounds,
            start,
            truth: self.truth,
            path: self.path.clone(),
        })
    }
}
