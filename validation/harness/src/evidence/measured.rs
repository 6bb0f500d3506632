//! Reference data in CSV files with a header that says what they are and how far to trust them.
//!
//! ```text
//! # quantity: velocity over depth
//! # unit: m/s
//! # kind: measured
//! # confidence: high
//! # uncertainty: 3 % of the surface velocity
//! # source: author, year, figure
//! # licence: own data
//! height [m],velocity [m/s],run
//! 0.001,0.012,a
//! ```
//!
//! All seven keys are required, each once. A column with a unit in brackets holds finite numbers; one without
//! holds labels.

use crate::input::{FieldError, TableRows, is_mark, name_and_unit, plain_lines};
use crate::metric::Confidence;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// No measured number is larger, in whatever unit; squares of such numbers are still finite.
const LARGEST: f64 = 1e30;

/// Origin of a reference value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ReferenceKind {
    /// Exact for the model.
    Analytic,
    /// An independent numerical solution of the same model.
    Computed,
    /// A published fit to experiments or simulations.
    Fit,
    /// Measured values.
    Measured,
    /// A sentence of a paper.
    Statement,
}

/// Header of a reference file.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Metadata {
    /// Quantity of the values.
    pub quantity: String,
    /// Unit of that quantity.
    pub unit: String,
    /// Origin of the values, `kind` in the file.
    #[serde(rename = "kind")]
    pub origin: ReferenceKind,
    /// Confidence in the values; rows may state otherwise in a column `confidence`.
    pub confidence: Confidence,
    /// Uncertainty of the values, in words; figures for each row stand in a column.
    pub uncertainty: String,
    /// Publication, figure, table.
    pub source: String,
    /// Terms of use.
    pub licence: String,
}

/// A column of finite numbers in a unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NumberColumn {
    /// Name without the unit.
    pub name: String,
    /// Unit, from the brackets.
    pub unit: String,
    /// Values, one per row, in that unit.
    pub values: Vec<f64>,
}

/// One column of a reference table.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceColumn {
    /// Finite numbers in a unit.
    Numbers(NumberColumn),
    /// Text.
    Labels {
        /// Name.
        name: String,
        /// One label a row.
        values: Vec<String>,
    },
}

impl ReferenceColumn {
    /// Name without the unit.
    pub fn name(&self) -> &str {
        match self {
            Self::Numbers(NumberColumn { name, .. }) | Self::Labels { name, .. } => name,
        }
    }
}

/// A reference table with its provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredData {
    /// File as the caller named it.
    pub file: PathBuf,
    /// Header of the file.
    pub metadata: Metadata,
    /// Columns in the order of the file.
    pub columns: Vec<ReferenceColumn>,
    /// Length of each.
    rows: usize,
}

impl MeasuredData {
    /// Reads a text; `file` names it in errors.
    ///
    /// # Errors
    /// A header or a table that breaks a rule.
    pub fn parse(file: &Path, text: &str) -> Result<Self, FieldError> {
        let text = &*plain_lines(text);
        let metadata = parse_metadata(text).map_err(|error| error.in_file(file))?;
        let TableRows { heading, rows, .. } = TableRows::of(text, file)?;
        let refuse =
            |field: &str, defect: &str, remedy: &str| Err(FieldError::finding(field, defect, remedy).in_file(file));
        let (line, names) = match (heading, rows.first()) {
            (Some((line, names)), Some((_, first))) if names.len() == first.len() => (line, names),
            (Some((line, _)), Some(_)) => {
                return refuse(
                    &format!("line {line}"),
                    "names of columns and values differ in number",
                    "name each column, and separate names and values by commas",
                );
            }
            _ => return refuse("table", "missing", "write the columns' names and at least one row below the header"),
        };
        let mut columns: Vec<ReferenceColumn> = Vec::with_capacity(names.len());
        for (index, heading) in names.into_iter().enumerate() {
            let column = match name_and_unit(heading) {
                None => {
                    let values = rows.iter().map(|(_, words)| words[index].to_owned()).collect();
                    ReferenceColumn::Labels { name: heading.to_owned(), values }
                }
                Some(named) => {
                    let column = NumberColumn::of(&rows, index, heading, named);
                    ReferenceColumn::Numbers(column.map_err(|error| error.in_file(file))?)
                }
            };
            if columns.iter().any(|other| other.name() == column.name()) {
                return refuse(&format!("line {line}"), &format!("two columns `{}`", column.name()), "rename one");
            }
            columns.push(column);
        }
        Ok(Self { file: file.to_owned(), metadata, columns, rows: rows.len() })
    }

    fn column(&self, name: &str) -> Option<&ReferenceColumn> {
        self.columns.iter().find(|column| column.name() == name)
    }

    /// Values of a number column, by its name without the unit.
    pub fn numbers(&self, name: &str) -> Result<&[f64], FieldError> {
        match self.column(name) {
            Some(ReferenceColumn::Numbers(NumberColumn { values, .. })) => Ok(values),
            _ => Err(self.no_column("numbers", name)),
        }
    }

    /// Points of two number columns.
    pub fn points(&self, x: &str, y: &str) -> Result<Vec<(f64, f64)>, FieldError> {
        Ok(self.numbers(x)?.iter().copied().zip(self.numbers(y)?.iter().copied()).collect())
    }

    /// Values of a label column.
    pub fn labels(&self, name: &str) -> Result<&[String], FieldError> {
        match self.column(name) {
            Some(ReferenceColumn::Labels { values, .. }) => Ok(values),
            _ => Err(self.no_column("labels", name)),
        }
    }

    /// The row whose label in a column is this one; the first, if there are several.
    pub fn row(&self, column: &str, label: &str) -> Result<usize, FieldError> {
        let labels = self.labels(column)?;
        labels.iter().position(|own| own == label).ok_or_else(|| {
            let remedy = format!("the rows are {}", labels.join(", "));
            FieldError::finding(column, format!("no row `{label}`"), &remedy).in_file(&self.file)
        })
    }

    /// The number of the row that a label names.
    pub fn number_of(&self, column: &str, label: &str, number: &str) -> Result<f64, FieldError> {
        let row = self.row(column, label)?;
        Ok(self.numbers(number)?[row])
    }

    /// Confidence in each row: its word in a column `confidence`, or else the header's.
    pub fn confidences(&self) -> Result<Vec<Confidence>, FieldError> {
        if self.column("confidence").is_none() {
            return Ok(vec![self.metadata.confidence; self.rows]);
        }
        self.labels("confidence")?
            .iter()
            .map(|word| Confidence::stated(word).ok_or_else(|| self.bad_label("confidence", word, Confidence::STATED)))
            .collect()
    }

    /// A label column of upper ends of ranges: numbers, or `open` for infinity.
    pub fn upper_ends(&self, column: &str) -> Result<Vec<f64>, FieldError> {
        let refused = |text: &str| self.bad_label(column, text, "finite numbers and `open`");
        let end = |label: &String| match label.as_str() {
            "open" => Ok(f64::INFINITY),
            text => text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| refused(text)),
        };
        self.labels(column)?.iter().map(end).collect()
    }

    /// Error of a label that is not among those allowed.
    pub fn bad_label(&self, column: &str, label: &str, allowed: &str) -> FieldError {
        FieldError::new(column, format!("\"{label}\""), &format!("one of {allowed}"), "correct the row")
            .in_file(&self.file)
    }

    fn no_column(&self, kind: &str, name: &str) -> FieldError {
        let known: Vec<String> = self.columns.iter().map(|column| format!("`{}`", column.name())).collect();
        let remedy = format!("the columns are {}", known.join(", "));
        FieldError::finding(name, format!("no column of {kind}"), &remedy).in_file(&self.file)
    }
}

impl NumberColumn {
    /// The column at a place of a table, by its heading, with a name and a unit.
    ///
    /// # Errors
    /// A word that is no finite number, or a mark of a missing value.
    pub fn of(
        rows: &[(usize, Vec<&str>)],
        place: usize,
        heading: &str,
        (name, unit): (&str, &str),
    ) -> Result<Self, FieldError> {
        let number = |(line, words): &(usize, Vec<&str>)| {
            let number = words[place].parse::<f64>().ok();
            number.filter(|value| value.abs() <= LARGEST && !is_mark(*value)).ok_or_else(|| {
                let defect = format!("\"{}\" in column {heading} is not a measured value", words[place]);
                let remedy = "write a finite number with a decimal point, or leave the row out";
                FieldError::finding(&format!("line {line}"), defect, remedy)
            })
        };
        let values = rows.iter().map(number).collect::<Result<_, _>>()?;
        Ok(Self { name: name.to_owned(), unit: unit.to_owned(), values })
    }
}

fn parse_metadata(text: &str) -> Result<Metadata, FieldError> {
    let mut fields = toml::Table::new();
    let header = text.lines().take_while(|line| line.starts_with('#') || line.trim().is_empty());
    for (number, line) in (1..).zip(header).filter(|(_, line)| !line.trim().is_empty()) {
        let (key, value) = line.trim_start_matches('#').split_once(':').unwrap_or_default();
        if value.trim().is_empty() || fields.insert(key.trim().to_owned(), value.trim().into()).is_some() {
            let remedy = "write `# key: value`, each key once, and \"none\" for no value";
            return Err(FieldError::finding(&format!("line {number}"), format!("\"{line}\""), remedy));
        }
    }
    let metadata: Metadata = fields.try_into().map_err(|error: toml::de::Error| {
        let remedy = "write `# key: value` above the table for quantity, unit, kind, confidence, uncertainty, source and licence";
        FieldError::finding("header", error.message(), remedy)
    })?;
    if metadata.confidence == Confidence::Exact {
        let rule = format!("one of {}", Confidence::STATED);
        return Err(FieldError::new("# confidence", "exact", &rule, "state the confidence in the values"));
    }
    Ok(metadata)
}

#[cfg(test)]
#[path = "measured_tests.rs"]
mod tests;
