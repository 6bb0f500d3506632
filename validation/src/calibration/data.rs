//! What a model is compared with: single numbers, profiles from a CSV file, or synthetic data.

use super::result::Place;
use crate::error::{InputError, nearest};
use crate::evaluation::Record;
use crate::reference::{Column, MeasuredData};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A group of data as a plan gives it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DatumText {
    /// Metric of the case, by name.
    metric: Option<String>,
    /// Its variant; may be left out if there is one only.
    variant: Option<String>,
    /// Table of the case, by name.
    table: Option<String>,
    /// Column of the table that the data are given over.
    x: Option<String>,
    /// Column of the table that is compared.
    y: Option<String>,
    /// CSV file with the data, beside the plan.
    file: Option<PathBuf>,
    /// A single datum.
    value: Option<f64>,
    unit: Option<String>,
    /// Its standard uncertainty.
    uncertainty: Option<f64>,
    /// Its standard uncertainty as a factor: the comparison is one of logarithms.
    factor: Option<f64>,
    source: Option<String>,
    /// Synthetic data: relative standard deviation of their noise.
    noise: Option<f64>,
    /// Points of a synthetic profile.
    bins: Option<usize>,
}

/// What of a record a datum is compared with.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Target {
    /// A metric.
    Metric {
        /// Name.
        name: String,
        /// Variant; `None` if there is one only.
        variant: Option<String>,
    },
    /// A value interpolated in a table.
    Profile {
        /// Name of the table.
        table: String,
        /// Column of abscissas, with its unit.
        x: String,
        /// Column of ordinates, with its unit.
        y: String,
        /// Abscissa.
        at: f64,
    },
}

/// How far a datum may be off, as a standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Uncertainty {
    /// In the datum's unit.
    Absolute(f64),
    /// As a factor on the datum.
    Factor(f64),
}

/// One datum.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Datum {
    /// The block whose case it is compared with.
    pub(super) block: usize,
    /// What it is compared with.
    pub(super) target: Target,
    /// The value, in `unit`.
    pub(super) value: f64,
    /// Unit.
    pub(super) unit: String,
    /// Standard uncertainty.
    pub(super) uncertainty: Uncertainty,
    /// Where it comes from.
    pub(super) source: String,
}

/// Synthetic data that are still to be made from the model itself.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Synthetic {
    /// The block.
    pub(super) block: usize,
    /// Table or metric; the abscissa is set when the data are made.
    pub(super) target: Target,
    /// Relative standard deviation of the noise `[-]`.
    pub(super) noise: f64,
    /// Points of a profile.
    pub(super) bins: usize,
}

/// A group of data that was read.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Group {
    /// Given data.
    Given(Vec<Datum>),
    /// Data to be made.
    Synthetic(Synthetic),
}

impl DatumText {
    /// Checks what is given and what is missing; `field` names the table.
    pub(super) fn check(&self, field: &str) -> Result<(), InputError> {
        let wrong = |name: &str, value: &str, rule: &str, remedy: &str| {
            Err(InputError::field(&format!("{field}.{name}"), value, rule, remedy))
        };
        match (&self.metric, &self.table) {
            (Some(_), Some(_)) | (None, None) => {
                return wrong("metric", "missing or beside `table`", "the one or the other", "name what is compared");
            }
            (None, Some(_)) if self.x.is_none() || self.y.is_none() => {
                return wrong("x", "missing, or y is", "given with y", "name the table's columns, such as \"y [m]\"");
            }
            _ => {}
        }
        if let Some(noise) = self.noise {
            if !(noise > 0.0 && noise.is_finite()) {
                return wrong("noise", &noise.to_string(), "positive", "0.01 is one per cent");
            }
            return Ok(());
        }
        if self.file.is_some() {
            return Ok(());
        }
        let Some(value) = self.value else {
            return wrong("value", "missing", "a number", "or name a `file`, or a `noise` for synthetic data");
        };
        if self.table.is_some() {
            return wrong("file", "missing", "given with a table", "a profile needs a CSV file, or a `noise`");
        }
        if !value.is_finite() {
            return wrong("value", &value.to_string(), "finite", "give a number");
        }
        if self.unit.is_none() {
            return wrong("unit", "missing", "the unit of the value", "such as unit = \"m\"; \"-\" for none");
        }
        if self.source.is_none() {
            return wrong("source", "missing", "the origin of the value", "such as source = \"own experiment, May\"");
        }
        self.uncertainty(value).map_or_else(
            || {
                let remedy = "give the standard deviation in the value's unit, or `factor` for one in logarithms; \
                              Bagnold does not invent one";
                wrong("uncertainty", "missing or not positive", "positive", remedy)
            },
            |_| Ok(()),
        )
    }

    fn uncertainty(&self, value: f64) -> Option<Uncertainty> {
        match (self.uncertainty, self.factor) {
            (Some(sigma), None) if sigma > 0.0 && sigma.is_finite() => Some(Uncertainty::Absolute(sigma)),
            (None, Some(factor)) if factor > 1.0 && factor.is_finite() && value > 0.0 => {
                Some(Uncertainty::Factor(factor))
            }
            _ => None,
        }
    }

    fn target(&self, at: f64) -> Target {
        match (&self.metric, &self.table) {
            (Some(name), _) => Target::Metric { name: name.clone(), variant: self.variant.clone() },
            (None, table) => Target::Profile {
                table: table.clone().unwrap_or_default(),
                x: self.x.clone().unwrap_or_default(),
                y: self.y.clone().unwrap_or_default(),
                at,
            },
        }
    }

    /// Reads the data; `plan` is the file that names a CSV file relative to itself.
    pub(super) fn read(&self, block: usize, plan: &Path) -> Result<Group, InputError> {
        if let Some(noise) = self.noise {
            let bins = self.bins.unwrap_or(20).max(1);
            return Ok(Group::Synthetic(Synthetic { block, target: self.target(0.0), noise, bins }));
        }
        if let Some(file) = &self.file {
            let path = plan.parent().unwrap_or_else(|| Path::new("")).join(file);
            return Ok(Group::Given(self.of_file(block, &path)?));
        }
        let value = self.value.unwrap_or(f64::NAN);
        Ok(Group::Given(vec![Datum {
            block,
            target: self.target(0.0),
            value,
            unit: self.unit.clone().unwrap_or_default(),
            uncertainty: self.uncertainty(value).unwrap_or(Uncertainty::Absolute(f64::NAN)),
            source: self.source.clone().unwrap_or_default(),
        }]))
    }

    fn of_file(&self, block: usize, path: &Path) -> Result<Vec<Datum>, InputError> {
        let data = MeasuredData::read(path)?;
        let source = data.metadata.source.clone();
        let (values, unit) = match &self.table {
            // a profile: the columns have the table's names
            Some(_) => {
                let y = self.y.as_deref().unwrap_or_default();
                let (name, unit) = parted(y);
                (numbers(&data, path, name, Some(unit))?.0, unit.to_owned())
            }
            None => numbers(&data, path, "value", None)?,
        };
        let (sigmas, _) = numbers(&data, path, "uncertainty", Some(&unit)).map_err(|error| match error {
            InputError::Reference(_) => InputError::field(
                "uncertainty",
                "missing",
                "a column of standard deviations",
                &format!("add `uncertainty [{unit}]`; Bagnold does not invent one"),
            )
            .in_file(path),
            other => other,
        })?;
        if let Some(row) = sigmas.iter().position(|sigma| *sigma <= 0.0) {
            let field = format!("uncertainty, row {}", row + 1);
            return Err(InputError::field(&field, sigmas[row], "positive", "give the standard deviation").in_file(path));
        }
        let datum = |row: usize, target: Target| Datum {
            block,
            target,
            value: values[row],
            unit: unit.clone(),
            uncertainty: Uncertainty::Absolute(sigmas[row]),
            source: source.clone(),
        };
        if self.table.is_some() {
            let (name, unit) = parted(self.x.as_deref().unwrap_or_default());
            let (places, _) = numbers(&data, path, name, Some(unit))?;
            return Ok((0..values.len()).map(|row| datum(row, self.target(places[row]))).collect());
        }
        let variants = data.labels("variant").map(<[String]>::to_vec).unwrap_or_default();
        let target = |row: usize| match (self.target(0.0), variants.get(row)) {
            (Target::Metric { name, .. }, Some(variant)) => Target::Metric { name, variant: Some(variant.clone()) },
            (target, _) => target,
        };
        Ok((0..values.len()).map(|row| datum(row, target(row))).collect())
    }
}

/// Values and unit of a number column; the unit must be the expected one.
fn numbers(
    data: &MeasuredData,
    path: &Path,
    wanted: &str,
    expected: Option<&str>,
) -> Result<(Vec<f64>, String), InputError> {
    let values = data.numbers(wanted)?.to_vec();
    let unit = data.columns.iter().find_map(|column| match column {
        Column::Numbers { name, unit, .. } if name == wanted => Some(unit.clone()),
        _ => None,
    });
    let unit = unit.unwrap_or_default();
    match expected {
        Some(expected) if expected != unit => {
            let remedy = "convert the column; Bagnold does not guess";
            let rule = format!("in the simulated quantity's unit, [{expected}]");
            Err(InputError::field(wanted, format!("in [{unit}]"), &rule, remedy).in_file(path))
        }
        _ => Ok((values, unit)),
    }
}

/// Name and unit of a column such as `u [m/s]`.
fn parted(column: &str) -> (&str, &str) {
    column.split_once('[').map_or((column, "-"), |(name, rest)| (name.trim(), rest.trim_end_matches(']').trim()))
}

impl Target {
    /// What a record says, with its unit.
    ///
    /// # Errors
    /// The words for what the record does not have.
    pub(super) fn predicted(&self, record: &Record) -> Result<(f64, String), String> {
        match self {
            Self::Metric { name, variant } => {
                let mut found = record
                    .metrics
                    .iter()
                    .filter(|m| m.name == *name && variant.as_ref().is_none_or(|v| *v == m.variant));
                let missing = || {
                    let known = record.metrics.iter().filter(|metric| metric.name == *name);
                    let variants: Vec<&str> = known.map(|metric| metric.variant.as_str()).collect();
                    if variants.is_empty() {
                        let names = record.metrics.iter().map(|metric| metric.name.as_str());
                        let guess =
                            nearest(name, names).map_or_else(String::new, |near| format!(", did you mean `{near}`?"));
                        format!("no metric `{name}`{guess}")
                    } else {
                        format!(
                            "no variant `{}` of `{name}`; it has {}",
                            variant.clone().unwrap_or_default(),
                            variants.join("; ")
                        )
                    }
                };
                let first = found.next().ok_or_else(missing)?;
                if variant.is_none() && found.next().is_some() {
                    return Err(format!(
                        "several variants of `{name}`; name one with `variant`, such as `{}`",
                        first.variant
                    ));
                }
                Ok((first.value, first.unit.clone()))
            }
            Self::Profile { table, x, y, at } => {
                let found = record.tables.iter().find(|other| other.name == *table).ok_or_else(|| {
                    let names: Vec<&str> = record.tables.iter().map(|table| table.name.as_str()).collect();
                    format!("no table `{table}`; it has {}", names.join(", "))
                })?;
                let column =
                    |name: &str| {
                        found.columns.iter().position(|column| column == name).ok_or_else(|| {
                            format!("no column `{name}` in `{table}`; it has {}", found.columns.join(", "))
                        })
                    };
                let (x, y) = (column(x)?, column(y)?);
                let points: Vec<(f64, f64)> = found.rows.iter().map(|row| (row[x], row[y])).collect();
                let unit = parted(&found.columns[y]).1.to_owned();
                interpolated(&points, *at).map(|value| (value, unit)).ok_or_else(|| {
                    let ends = points.first().zip(points.last()).map(|(first, last)| (first.0, last.0));
                    let (first, last) = ends.unwrap_or_default();
                    format!("no value of `{table}` at {at}; it reaches from {first} to {last}")
                })
            }
        }
    }

    /// The same target of a profile at another abscissa.
    #[must_use]
    pub(super) fn at_abscissa(&self, place: f64) -> Self {
        let mut moved = self.clone();
        if let Self::Profile { at, .. } = &mut moved {
            *at = place;
        }
        moved
    }

    /// The same metric of another variant.
    #[must_use]
    pub(super) fn with_variant(&self, change: impl FnOnce(&str) -> String) -> Self {
        let mut changed = self.clone();
        if let Self::Metric { variant: Some(variant), .. } = &mut changed {
            *variant = change(variant);
        }
        changed
    }

    /// Where it lies in a profile.
    #[must_use]
    pub(super) fn place(&self) -> Option<Place> {
        match self {
            Self::Metric { .. } => None,
            Self::Profile { table, x, y, at } => {
                Some(Place { table: table.clone(), x: x.clone(), y: y.clone(), at: *at })
            }
        }
    }

    /// Name for tables and figures.
    #[must_use]
    pub(super) fn label(&self) -> String {
        match self {
            Self::Metric { name, variant } => match variant {
                Some(variant) if !variant.is_empty() => format!("{name} {variant}"),
                _ => name.clone(),
            },
            Self::Profile { table, y, at, .. } => format!("{table}: {y} at {at:.4e}"),
        }
    }
}

/// Linear interpolation in points of rising abscissa; half a step beyond the ends is extrapolated, no more.
fn interpolated(points: &[(f64, f64)], at: f64) -> Option<f64> {
    let place = points.windows(2).position(|pair| at <= pair[1].0).unwrap_or(points.len().checked_sub(2)?);
    let ((x0, y0), (x1, y1)) = (points[place], points[place + 1]);
    let share = (at - x0) / (x1 - x0);
    ((-0.5..=1.5).contains(&share) && share.is_finite()).then_some(y0 + share * (y1 - y0))
}

impl Datum {
    /// (model − datum)/σ, or the same of logarithms `[-]`.
    #[must_use]
    pub(super) fn residual(&self, predicted: f64) -> f64 {
        match self.uncertainty {
            Uncertainty::Absolute(sigma) => (predicted - self.value) / sigma,
            // a transport that has ceased is as wrong as one too small by e^30
            Uncertainty::Factor(factor) => {
                let ratio = (predicted / self.value).max(1e-13);
                libm::log(ratio) / libm::log(factor)
            }
        }
    }

    /// The value one standard deviation below and above.
    #[must_use]
    pub(super) fn band(&self) -> (f64, f64) {
        match self.uncertainty {
            Uncertainty::Absolute(sigma) => (self.value - sigma, self.value + sigma),
            Uncertainty::Factor(factor) => (self.value / factor, self.value * factor),
        }
    }
}
