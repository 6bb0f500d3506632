//! Quantity of a case's record with which a datum is compared, and the comparison.

use crate::evaluation::EvaluationRecord;
use crate::input::{is_same_heading, nearest, parted};
use crate::number::short_digits;
use crate::output::Table;
use crate::statistics::{Extrapolation, interpolated};
use serde::{Deserialize, Serialize};

/// A table is read up to half a step beyond its ends, no farther.
const HALF_A_STEP: (Extrapolation, Extrapolation) = (Extrapolation::Line(0.5), Extrapolation::Line(0.5));

/// Table of a law that is compared with points, its abscissa and its ordinate.
pub(super) const CURVE: [&str; 3] = ["law", "inertial_number [-]", "friction [-]"];

/// Location of a datum in a profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ProfileLocation {
    /// Table of the case.
    pub table: String,
    /// Column of abscissas, with its unit.
    pub x: String,
    /// Column that is compared, with its unit.
    pub y: String,
    /// Abscissa of the datum, in the unit of column x.
    pub at: f64,
}

impl ProfileLocation {
    /// Table among others, with the places of its columns.
    pub(super) fn found<'t>(&self, tables: &'t [Table]) -> Result<(&'t Table, usize, usize), String> {
        let table = &self.table;
        let found = tables.iter().find(|other| other.name == *table).ok_or_else(|| {
            let names: Vec<&str> = tables.iter().map(|table| table.name.as_str()).collect();
            format!("no table `{table}`; it has {}", names.join(", "))
        })?;
        let column = |name: &str| {
            let place = found.columns.iter().position(|column| is_same_heading(column, name));
            place.ok_or_else(|| format!("no column `{name}` in `{table}`; it has {}", found.columns.join(", ")))
        };
        Ok((found, column(&self.x)?, column(&self.y)?))
    }
}

/// Quantity of a record with which a datum is compared.
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
    Profile(ProfileLocation),
}

/// Standard uncertainty of a datum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum DatumUncertainty {
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
    /// Quantity with which the datum is compared.
    pub(super) target: Target,
    /// The value, in `unit`.
    pub(super) value: f64,
    /// Unit.
    pub(super) unit: String,
    /// Standard uncertainty.
    pub(super) uncertainty: DatumUncertainty,
    /// Source of the value.
    pub(super) source: String,
}

impl Target {
    /// Predicted value in a record, with its unit.
    ///
    /// # Errors
    /// The words for what the record does not have.
    pub(super) fn predicted(&self, record: &EvaluationRecord) -> Result<(f64, String), String> {
        match self {
            Self::Metric { name, variant } => {
                let mut found = record
                    .metrics
                    .iter()
                    .filter(|m| m.name == *name && variant.as_ref().is_none_or(|v| *v == m.variant.to_string()));
                let missing = || {
                    let known = record.metrics.iter().filter(|metric| metric.name == *name);
                    let variants: Vec<String> = known.map(|metric| metric.variant.to_string()).collect();
                    if variants.is_empty() {
                        let names = record.metrics.iter().map(|metric| metric.name.as_str());
                        let guess =
                            nearest(name, names).map_or_else(String::new, |near| format!(", did you mean `{near}`?"));
                        format!("no metric `{name}`{guess}")
                    } else {
                        let wanted = variant.as_deref().unwrap_or_default();
                        format!("no variant `{wanted}` of `{name}`; it has {}", variants.join("; "))
                    }
                };
                let first = found.next().ok_or_else(missing)?;
                if variant.is_none() && found.next().is_some() {
                    let one = &first.variant;
                    return Err(format!("several variants of `{name}`; name one with `variant`, such as `{one}`"));
                }
                match first.remark.as_ref().filter(|_| first.value.is_nan()) {
                    Some(reason) => Err(format!("no `{name}`: {reason}; let the runs last longer")),
                    None => Ok((first.value, first.unit.clone())),
                }
            }
            Self::Profile(location) => {
                let (found, x, y) = location.found(&record.tables)?;
                let ProfileLocation { table, at, .. } = location;
                let mut points: Vec<(f64, f64)> = found.rows.iter().map(|row| (row[x], row[y])).collect();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                let unit = parted(&found.columns[y]).1.to_owned();
                interpolated(&points, *at, HALF_A_STEP).map(|value| (value, unit)).ok_or_else(|| {
                    let ends = points.first().zip(points.last()).map(|(first, last)| (first.0, last.0));
                    let (first, last) = ends.unwrap_or_default();
                    let (there, all) = (points.iter().filter(|point| point.1.is_finite()).count(), points.len());
                    format!(
                        "no value of `{table}` at {at}; it reaches from {first} to {last}, and {there} of {all} rows have a value"
                    )
                })
            }
        }
    }

    /// The same metric of another variant.
    pub(super) fn with_variant(&self, change: impl FnOnce(&str) -> String) -> Self {
        let mut changed = self.clone();
        if let Self::Metric { variant: Some(variant), .. } = &mut changed {
            *variant = change(variant);
        }
        changed
    }

    /// Location of the datum in a profile.
    pub(super) fn place(&self) -> Option<ProfileLocation> {
        if let Self::Profile(location) = self { Some(location.clone()) } else { None }
    }

    /// Name for tables and figures.
    pub(super) fn label(&self) -> String {
        match self {
            Self::Metric { name, variant: Some(variant) } if !variant.is_empty() => format!("{name} {variant}"),
            Self::Metric { name, .. } => name.clone(),
            Self::Profile(ProfileLocation { table, y, at, .. }) => format!("{table}: {y} at {}", short_digits(*at, 5)),
        }
    }
}

impl Datum {
    /// (model − datum)/σ, or the same of logarithms `[-]`.
    pub(super) fn residual(&self, predicted: f64) -> f64 {
        match self.uncertainty {
            DatumUncertainty::Absolute(sigma) => (predicted - self.value) / sigma,
            // a transport that has ceased is as wrong as one too small by e^30
            DatumUncertainty::Factor(factor) => {
                let ratio = predicted / self.value;
                // the larger of both would also swallow what is not a number
                let ratio = if ratio < 1e-13 { 1e-13 } else { ratio };
                libm::log(ratio) / libm::log(factor)
            }
        }
    }

    /// The value that has a residual.
    pub(super) fn of_residual(&self, residual: f64) -> f64 {
        match self.uncertainty {
            DatumUncertainty::Absolute(sigma) => self.value + sigma * residual,
            DatumUncertainty::Factor(factor) => self.value * libm::pow(factor, residual),
        }
    }

    /// The value one standard deviation below and above.
    pub(super) fn band(&self) -> (f64, f64) {
        match self.uncertainty {
            DatumUncertainty::Absolute(sigma) => (self.value - sigma, self.value + sigma),
            DatumUncertainty::Factor(factor) => (self.value / factor, self.value * factor),
        }
    }
}
