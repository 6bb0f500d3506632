//! Data of a calibration: single numbers, profiles from a CSV file, or synthetic data.

use super::repeated::Repeated;
use super::target::{CURVE, Datum, DatumUncertainty, ProfileLocation, Target};
use crate::ToolError;
use crate::input::{FieldError, MeasuredFiles, parted};
use crate::measured::{Measurements, WantedColumns};
use crate::sampling::Random;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// No datum is larger, in whatever unit; squares of such numbers are still finite.
const LARGEST: f64 = 1e30;

/// A group of data as a plan gives it.
#[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DatumText {
    /// Metric of the case
    metric: Option<String>,
    /// Variant of the metric; may be left out if there is one only
    variant: Option<String>,
    /// Table of the case, in place of `metric`
    table: Option<String>,
    /// Column of the table that the data are given over, with its unit
    x: Option<String>,
    /// Column of the table that is compared, with its unit
    y: Option<String>,
    /// CSV file with the data, beside the plan
    file: Option<MeasuredFiles>,
    /// A single measured value, in place of `file`
    value: Option<f64>,
    /// Unit of `value`
    unit: Option<String>,
    /// Standard uncertainty of `value`
    uncertainty: Option<f64>,
    /// Standard uncertainty of `value` as a factor, which compares logarithms `[-]`
    factor: Option<f64>,
    /// Source of `value`
    source: Option<String>,
    /// Relative standard deviation of the noise of synthetic data, in place of `file` or `value` `[-]`
    pub(super) noise: Option<f64>,
    /// Points of a synthetic profile
    bins: Option<usize>,
}

impl DatumText {
    /// CSV files of the data, beside the plan.
    pub(super) fn files(&self) -> &[PathBuf] {
        self.file.as_ref().map_or(&[], MeasuredFiles::files)
    }

    /// Compares a file of points with the friction of a law; whether it is one.
    pub(super) fn fill_law(&mut self) -> bool {
        let is_free = self.metric.is_none() && self.table.is_none();
        [self.table, self.x, self.y] = CURVE.map(|name| Some(name.to_owned()));
        is_free && self.file.is_some()
    }

    /// Checks what is given and what is missing; `field` names the table.
    pub(super) fn check(&self, field: &str) -> Result<(), FieldError> {
        let wrong = |name: &str, value: &str, rule: &str, remedy: &str| {
            Err(FieldError::new(&format!("{field}.{name}"), value, rule, remedy))
        };
        match (&self.metric, &self.table) {
            (Some(_), Some(_)) | (None, None) => {
                return wrong("metric", "missing, or given together with `table`", "", "give one of the two");
            }
            (None, Some(_)) if self.x.is_none() || self.y.is_none() => {
                return wrong("x", "this or `y` is missing", "", "name both columns of the table, such as \"y [m]\"");
            }
            _ => {}
        }
        for (name, column) in [("x", &self.x), ("y", &self.y)] {
            if let Some(column) = column.as_ref().filter(|column| !column.contains('[') || !column.ends_with(']')) {
                let rule = "a column with its unit, as in the heading of the table";
                return wrong(name, column, rule, "write such as \"y [m]\"");
            }
        }
        let numbers = [("value", self.value), ("uncertainty", self.uncertainty), ("factor", self.factor)];
        let words = [("unit", &self.unit), ("source", &self.source)];
        let spare = numbers.iter().find(|(_, number)| number.is_some()).map(|(name, _)| *name);
        let spare = spare.or_else(|| words.iter().find(|(_, text)| text.is_some()).map(|(name, _)| *name));
        if self.metric.is_some() && (self.x.is_some() || self.y.is_some()) {
            return wrong("x", "given together with a metric", "", "leave `x` and `y` out: they belong to a table");
        }
        if self.bins.is_some_and(|bins| !(1..=10_000).contains(&bins)) || (self.bins.is_some() && self.noise.is_none())
        {
            let remedy = "give 1 to 10000 points of synthetic data with `noise`, or leave it out";
            return wrong("bins", "out of range, or given without `noise`", "", remedy);
        }
        if let Some(noise) = self.noise {
            if !(noise > 0.0 && noise.is_finite()) {
                return wrong("noise", &noise.to_string(), "positive", "give a value such as 0.01 for 1 %");
            }
            if let Some(name) = spare.or_else(|| self.file.is_some().then_some("file")) {
                let remedy = "leave one of the two out: synthetic data have no measurement";
                return wrong(name, "given together with `noise`", "", remedy);
            }
            return Ok(());
        }
        if self.file.is_some() {
            return match spare {
                Some(name) => wrong(name, "given together with a `file`", "", "leave it out: the file contains it"),
                None => Ok(()),
            };
        }
        let Some(value) = self.value else {
            return wrong("value", "missing", "", "give a number, a `file`, or a `noise` for synthetic data");
        };
        if self.table.is_some() {
            return wrong("file", "missing", "", "give a CSV file for the profile, or a `noise`");
        }
        if value.abs() > LARGEST || value.is_nan() {
            let remedy = "check the exponent and the unit";
            return wrong("value", &value.to_string(), "at most 1e30 in absolute value", remedy);
        }
        if self.unit.is_none() {
            return wrong("unit", "missing", "", "give it such as unit = \"m\", or \"-\" for none");
        }
        if self.source.is_none() {
            return wrong("source", "missing", "", "give the origin, such as source = \"own experiment, May\"");
        }
        if self.uncertainty(value).is_none() {
            let remedy = "give a standard deviation in the unit of the value, or `factor` for a logarithmic one";
            return wrong("uncertainty", "missing or not positive", "", remedy);
        }
        Ok(())
    }

    /// Whether both denote the same measurement.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let same_file = self.file.is_some() && self.file == other.file;
        let same_value = self.value.is_some() && (self.value, &self.source) == (other.value, &other.source);
        let same_target = (&self.metric, &self.table, &self.y) == (&other.metric, &other.table, &other.y);
        same_target && self.variant == other.variant && (same_file || same_value)
    }

    fn uncertainty(&self, value: f64) -> Option<DatumUncertainty> {
        match (self.uncertainty, self.factor) {
            (Some(sigma), None) if sigma > 0.0 && sigma.is_finite() => Some(DatumUncertainty::Absolute(sigma)),
            (None, Some(factor)) if factor > 1.0 && factor.is_finite() && value > 0.0 => {
                Some(DatumUncertainty::Factor(factor))
            }
            _ => None,
        }
    }

    /// Place in the case's tables or metrics of the data's counterpart.
    pub(super) fn target(&self, at: f64) -> Target {
        match (&self.metric, &self.table) {
            (Some(name), _) => Target::Metric { name: name.clone(), variant: self.variant.clone() },
            (None, table) => Target::Profile(ProfileLocation {
                table: table.clone().unwrap_or_default(),
                x: self.x.clone().unwrap_or_default(),
                y: self.y.clone().unwrap_or_default(),
                at,
            }),
        }
    }

    /// Reads the data, unless they are synthetic; `plan` is the file that names a CSV file relative to itself.
    pub(super) fn read(&self, block: usize, plan: &Path) -> Result<Vec<Datum>, ToolError> {
        if let Some(file) = &self.file {
            return self.of_file(block, &file.beside(plan.parent().unwrap_or_else(|| Path::new(""))));
        }
        let datum = |value: f64| Datum {
            block,
            target: self.target(0.0),
            value,
            unit: self.unit.clone().unwrap_or_default(),
            uncertainty: self.uncertainty(value).unwrap_or(DatumUncertainty::Absolute(f64::NAN)),
            source: self.source.clone().unwrap_or_default(),
        };
        Ok(self.value.map(datum).into_iter().collect())
    }

    /// Synthetic data from the truth's answer: equidistant abscissas over the table of the first seed, or a metric, with noise.
    pub(super) fn make(
        &self,
        block: usize,
        share: f64,
        truth: &Repeated,
        noise: &mut Random,
    ) -> Result<Vec<Datum>, String> {
        if let Some(failure) = truth.failure() {
            return Err(format!("no numbers for the truth: {failure}"));
        }
        let places = match self.target(0.0) {
            Target::Profile(location) => {
                let tables = truth.with_seed(0).map_or(&[][..], |record| &record.tables);
                let found = location.found(tables).ok();
                let range = found.and_then(|(found, x, _)| Some((found.rows.first()?[x], found.rows.last()?[x])));
                // a table or column that does not exist is named by the first prediction
                let (first, last) = range.unwrap_or_default();
                let bins = self.bins.unwrap_or(20);
                let step = (last - first) / (bins.max(2) - 1) as f64;
                (0..bins).map(|k| first + k as f64 * step).collect()
            }
            Target::Metric { .. } => vec![0.0],
        };
        let datum = |place: f64| {
            let target = self.target(place);
            let (value, unit) = truth.predicted(&target)?;
            let sigma = share * value.abs();
            if sigma == 0.0 {
                return Err(format!("zero for `{}`, so a relative noise means nothing", target.label()));
            }
            Ok(Datum {
                block,
                target,
                value: value + sigma * noise.normal(),
                unit,
                uncertainty: DatumUncertainty::Absolute(sigma),
                source: format!("made by Bagnold itself, with {} % of noise", 100.0 * share),
            })
        };
        places.into_iter().map(datum).collect()
    }

    fn of_file(&self, block: usize, files: &MeasuredFiles) -> Result<Vec<Datum>, ToolError> {
        let (over, column) = (self.x.as_deref().map(parted), self.y.as_deref().map(parted));
        let quantity = column.map(|(name, _)| name).or(self.metric.as_deref()).unwrap_or_default();
        let wanted =
            WantedColumns { over: over.map(|(name, _)| name), quantity: &[quantity, "value"], ..Default::default() };
        let data = Measurements::read(files, wanted)?;
        let unit = column.map_or(&*data.measured.unit, |(_, unit)| unit);
        let points = data.in_units(over.map_or("-", |(_, unit)| unit), unit)?;
        let datum = |(row, [at, value, sigma]): (usize, [f64; 3])| Datum {
            block,
            target: match (self.target(at), data.variants.get(row)) {
                (Target::Metric { name, .. }, Some(variant)) => Target::Metric { name, variant: Some(variant.clone()) },
                (target, _) => target,
            },
            value,
            unit: unit.to_owned(),
            uncertainty: DatumUncertainty::Absolute(sigma),
            source: data.source(),
        };
        Ok(points.into_iter().enumerate().map(datum).collect())
    }
}
