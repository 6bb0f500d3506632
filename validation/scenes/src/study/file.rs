//! A study as a TOML file.

use super::control::{self, ControlText};
use super::drawn::{FigureText, NamesOfStudy};
use crate::case::list::Fields;
use crate::case::{ListOfRuns, NamedVariant, Tier, VariedParameter};
use crate::figure::is_file_name;
use crate::input::{FieldError, MeasuredFiles, check_name, check_text};
use crate::metric::{Confidence, Variant};
use bagnold_solver::parameter::{filled, positive, range_problem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use toml::{Table, Value};

/// The file, field by field.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct StudyText {
    /// Name of the study, also of its folder and page.
    pub(super) study: String,
    /// One line.
    pub(super) summary: String,
    /// Description of the simulation and its references; paragraphs are separated by empty lines.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) description: String,
    /// The case that simulates.
    pub(super) case: Option<String>,
    /// A case file with the base values, in place of `case`.
    pub(super) base: Option<PathBuf>,
    /// Tier that supplies parameters missing in the base values.
    pub(super) tier: Option<Tier>,
    /// Base values: the case's parameters, as in a case file.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "Fields")]
    pub(super) set: Table,
    /// Values that a canonical study has in their place at the paper tier.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "Fields")]
    pub(super) paper: Table,
    /// Named changes of the base values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) variants: Vec<NamedVariant>,
    /// Parameters that take several values, each with each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) vary: Vec<VariedParameter>,
    /// Checks of the results, each with a limit or observed only.
    #[serde(default)]
    #[schemars(transform = filled("at least one table", "add a [[checks]] table: without one there is no verdict"))]
    pub(super) checks: Vec<CheckText>,
    /// Wrong physics and wrong inputs that checks must reject.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) controls: Vec<ControlText>,
    /// Figures of checks over the variants.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) figures: Vec<FigureText>,
}

/// A check: what is measured, and what it is judged by. It has one of `metric`, `value`, `compare`, `order_of`
/// and `difference_of`, and at most one limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckText {
    /// Name of the metric: lower-case letters, digits and `_`.
    pub(super) name: String,
    /// Variants that are judged, as `key=value`; all, if it is left out.
    #[schemars(with = "Option<String>")]
    pub(super) only: Option<Variant>,

    /// A metric of the case itself.
    pub(super) metric: Option<String>,
    /// A table that the case writes, by its name or the beginning of it; beside `value` or `compare`.
    pub(super) table: Option<String>,
    /// Heading of the column that is measured; beside `value` or `compare`.
    pub(super) column: Option<String>,
    /// Heading of a column of the same table that is added to it; beside `value` or `compare`.
    pub(super) plus: Option<String>,
    /// Heading of a column of the same table that is taken from it, such as that of a mirror image; beside `value` or `compare`.
    pub(super) minus: Option<String>,
    /// Heading of the column that it is measured over; the first one, if it is left out.
    pub(super) over: Option<String>,
    /// First value of the column `over` that counts, in its unit.
    pub(super) from: Option<f64>,
    /// Last value of the column `over` that counts, in its unit.
    pub(super) to: Option<f64>,
    /// Value of the column that is judged.
    pub(super) value: Option<Reduction>,
    /// CSV file with what was varied, what was measured and its standard uncertainty, or those of repeats.
    pub(super) compare: Option<MeasuredFiles>,
    /// Distance from the measured series.
    pub(super) distance: Option<Distance>,
    /// Name of an earlier check, an error whose order of convergence is judged.
    pub(super) order_of: Option<String>,
    /// Name of the varied parameter that the order is taken in; beside `order_of`.
    pub(super) order_in: Option<String>,
    /// Name of an earlier check whose values in two variants are compared, in % of the second.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) difference_of: Option<String>,
    /// The two variants, as `key=value`, such as `["spacing=0.02", "spacing=0.01"]`; beside `difference_of`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<(String, String)>")]
    pub(super) between: Option<(Variant, Variant)>,

    /// Expected value, in the unit of what is measured.
    pub(super) reference: Option<f64>,
    /// Standard uncertainty of the reference, in its unit.
    #[schemars(transform = positive("give a standard deviation in the unit of the value"))]
    pub(super) standard_uncertainty: Option<f64>,
    /// Source of the reference; required beside one.
    pub(super) source: Option<String>,
    /// Confidence in the reference; unverified ones allow no limit.
    pub(super) confidence: Option<Confidence>,
    /// Limit: largest value, in the unit of what is measured.
    pub(super) at_most: Option<f64>,
    /// Limit: smallest value, in the unit of what is measured.
    pub(super) at_least: Option<f64>,
    /// Limit: smallest and largest value, in the unit of what is measured.
    pub(super) within: Option<(f64, f64)>,
    /// Limit: largest distance from the reference in its standard uncertainties `[-]`.
    #[schemars(transform = positive("give a factor such as 2"))]
    pub(super) within_uncertainties: Option<f64>,
    /// Reason of the limit; required beside `at_most`, `at_least` and `within`.
    pub(super) reason: Option<String>,
}

/// Value taken of a column.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Reduction {
    /// The first value.
    First,
    /// The last value.
    Last,
    /// The largest value.
    Largest,
    /// The smallest value.
    Smallest,
    /// The mean, by the trapezoidal rule over the other column.
    Mean,
    /// The value at a place of the other column, linear between its rows.
    At(f64),
    /// The first place of the other column at which the value reaches a level from either side, linear between its rows.
    Reaches(f64),
    /// The slope of the least-squares line over the other column.
    Slope,
}

/// Distance of a column from a measured series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(super) enum Distance {
    /// Root mean square of the differences in their standard uncertainties `[-]`.
    Residual,
    /// Root of the mean square of the differences over that of the measured values `[%]`.
    RelativeL2,
    /// Largest difference, in the column's unit.
    Largest,
    /// Mean difference, in the column's unit: simulated less measured.
    Mean,
}

impl CheckText {
    /// Whether anything judges what is measured.
    fn has_limit(&self) -> bool {
        self.at_most.or(self.at_least).or(self.within_uncertainties).is_some() || self.within.is_some()
    }
}

impl StudyText {
    /// Refuses settings that no case would use.
    pub(super) fn check(&self) -> Result<(), FieldError> {
        check_name("study", &self.study)?;
        if !is_file_name(&self.study) {
            let rule = "a name that a folder can have: letters, digits, `-` and `_`";
            return Err(FieldError::new("study", format!("\"{}\"", self.study), rule, "name it, e.g. \"my-flume\""));
        }
        check_text("summary", &self.summary)?;
        self.description.lines().try_for_each(|line| check_text("description", line))?;
        match (&self.case, &self.base) {
            (Some(_), None) | (None, Some(_)) => {}
            (None, None) => {
                let remedy = "add case = \"scene\" with [set], or base = \"my-case.toml\"";
                return Err(FieldError::new("case", "missing", "the name of a case, or `base` a case file", remedy));
            }
            (Some(case), Some(_)) => {
                let remedy = "leave one of them out";
                return Err(FieldError::new("case", format!("\"{case}\" beside `base`"), "given alone", remedy));
            }
        }
        if let Some(problem) = range_problem(self) {
            return Err(FieldError::new(&problem.field, problem.value, &problem.rule, &problem.remedy));
        }
        let is_number = |value: &Value| value.is_float() || value.is_integer();
        let names = NamesOfStudy {
            variants: self.variants.iter().map(|named| named.name.as_str()).collect(),
            varied_numbers: self
                .vary
                .iter()
                .filter(|own| own.values.iter().all(is_number))
                .map(VariedParameter::label)
                .collect(),
            checks: self.checks.iter().map(|check| check.name.as_str()).collect(),
        };
        for (place, figure) in self.figures.iter().enumerate() {
            let field = format!("figures[{place}]");
            figure.check(&names).map_err(|error| error.within(&field))?;
            if self.figures[..place].iter().any(|other| other.name == figure.name) {
                let field = format!("{field}.name");
                return Err(FieldError::new(&field, &figure.name, "unique", "give each a name of its own"));
            }
        }
        let judged: Vec<&str> =
            self.checks.iter().filter(|check| check.has_limit()).map(|check| check.name.as_str()).collect();
        control::check(&self.controls, &judged)?;
        self.list().check()
    }

    /// The list of its runs.
    pub(super) fn list(&self) -> ListOfRuns {
        ListOfRuns { variants: self.variants.clone(), vary: self.vary.clone() }
    }
}
