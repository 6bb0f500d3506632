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

use super::ReferenceError;
use super::measured_table::{ReferenceColumn, parse_table};
use crate::input::{DOCUMENT, plain_lines, read_text, shown};
use crate::metric::{Confidence, MetricKind};
use std::collections::BTreeMap;
use std::path::Path;

/// Origin of a reference value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

impl ReferenceKind {
    /// All, each with its word in a file.
    const ALL: [(&'static str, Self); 5] = [
        ("analytic", Self::Analytic),
        ("computed", Self::Computed),
        ("fit", Self::Fit),
        ("measured", Self::Measured),
        ("statement", Self::Statement),
    ];

    /// Kind of verdict that such a reference value supports.
    #[must_use]
    pub fn kind(self) -> MetricKind {
        match self {
            Self::Analytic | Self::Computed => MetricKind::Verification,
            Self::Fit | Self::Measured | Self::Statement => MetricKind::Validation,
        }
    }
}

/// Header of a reference file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Metadata {
    /// Quantity of the values.
    pub quantity: String,
    /// Unit of that quantity.
    pub unit: String,
    /// Origin of the values, `kind` in the file.
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

/// A reference table with its provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredData {
    /// File as the caller named it.
    pub file: String,
    /// Header of the file.
    pub metadata: Metadata,
    /// Columns in the order of the file, all of the same length.
    pub columns: Vec<ReferenceColumn>,
}

impl MeasuredData {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, ReferenceError> {
        let file = shown(path);
        let text =
            read_text(path, DOCUMENT).map_err(|source| ReferenceError::Unreadable { file: file.clone(), source })?;
        Self::parse(&file, &text)
    }

    /// Reads a text; `file` names it in errors.
    pub fn parse(file: &str, text: &str) -> Result<Self, ReferenceError> {
        let text = &*plain_lines(text);
        let header_lines = text.lines().take_while(|line| line.starts_with('#') || line.trim().is_empty()).count();
        let metadata = parse_metadata(file, text, header_lines)?;
        let columns = parse_table(file, text, header_lines)?;
        Ok(Self { file: file.to_owned(), metadata, columns })
    }

    fn column(&self, name: &str) -> Option<&ReferenceColumn> {
        self.columns.iter().find(|column| column.name() == name)
    }

    /// Values of a number column, by its name without the unit.
    pub fn numbers(&self, name: &str) -> Result<&[f64], ReferenceError> {
        match self.column(name) {
            Some(ReferenceColumn::Numbers { values, .. }) => Ok(values),
            _ => Err(self.no_column("number", name)),
        }
    }

    /// Values of a label column.
    pub fn labels(&self, name: &str) -> Result<&[String], ReferenceError> {
        match self.column(name) {
            Some(ReferenceColumn::Labels { values, .. }) => Ok(values),
            _ => Err(self.no_column("label", name)),
        }
    }

    /// The row whose label in a column is this one; the first, if there are several.
    pub fn row(&self, column: &str, label: &str) -> Result<usize, ReferenceError> {
        let labels = self.labels(column)?;
        labels.iter().position(|own| own == label).ok_or_else(|| {
            let known = labels.join(", ");
            self.error(format!("no row has `{label}` in the column `{column}`; there are {known}"))
        })
    }

    /// The number of the row that a label names.
    pub fn number_of(&self, column: &str, label: &str, number: &str) -> Result<f64, ReferenceError> {
        let row = self.row(column, label)?;
        Ok(self.numbers(number)?[row])
    }

    /// Confidence in each row: its word in a column `confidence`, or else the header's.
    pub fn confidences(&self) -> Result<Vec<Confidence>, ReferenceError> {
        let rows = match self.columns.first() {
            Some(ReferenceColumn::Numbers { values, .. }) => values.len(),
            Some(ReferenceColumn::Labels { values, .. }) => values.len(),
            None => 0,
        };
        if self.column("confidence").is_none() {
            return Ok(vec![self.metadata.confidence; rows]);
        }
        self.labels("confidence")?
            .iter()
            .map(|word| Confidence::stated(word).ok_or_else(|| self.bad_label("confidence", word, Confidence::STATED)))
            .collect()
    }

    /// A label column whose labels are numbers or `open`, which stands for infinity: the upper ends of ranges.
    pub fn upper_ends(&self, column: &str) -> Result<Vec<f64>, ReferenceError> {
        let end = |label: &String| match label.as_str() {
            "open" => Ok(f64::INFINITY),
            text => match text.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(self.bad_label(column, text, "finite numbers and `open`")),
            },
        };
        self.labels(column)?.iter().map(end).collect()
    }

    /// Error of a label that is not among those allowed.
    #[must_use]
    pub fn bad_label(&self, column: &str, label: &str, allowed: &str) -> ReferenceError {
        self.error(format!("`{label}` in the column `{column}` is not one of {allowed}"))
    }

    fn no_column(&self, kind: &str, name: &str) -> ReferenceError {
        let known: Vec<String> = self.columns.iter().map(|column| format!("`{}`", column.name())).collect();
        self.error(format!("there is no {kind} column `{name}`; its columns are {}", known.join(", ")))
    }

    fn error(&self, defect: String) -> ReferenceError {
        ReferenceError::at(&self.file, defect)
    }
}

const KEYS: [&str; 7] = ["quantity", "unit", "kind", "confidence", "uncertainty", "source", "licence"];

fn parse_metadata(file: &str, text: &str, header_lines: usize) -> Result<Metadata, ReferenceError> {
    let mut found = BTreeMap::new();
    for (line, text) in (1..).zip(text.lines()).take(header_lines).filter(|(_, text)| !text.trim().is_empty()) {
        let refuse = |rule: &str| Err(ReferenceError::at(&format!("{file}, line {line}"), format!("`{text}` {rule}")));
        let Some((key, value)) = text.trim_start_matches('#').split_once(':') else {
            return refuse("has no colon; write `# key: value`");
        };
        let (key, value) = (key.trim(), value.trim());
        if !KEYS.contains(&key) {
            return refuse(&format!("has an unknown key; the keys are {}", KEYS.join(", ")));
        }
        if value.is_empty() {
            return refuse("has no value; write one, \"none\" if there is none");
        }
        if found.insert(key, (line, value)).is_some() {
            return refuse("repeats a key; keep one of the lines");
        }
    }
    let value = |key: &str| {
        let missing = || format!("the line `# {key}: …` is missing; add it above the table");
        found.get(key).copied().ok_or_else(|| ReferenceError::at(file, missing()))
    };
    let text = |key: &str| Ok(value(key)?.1.to_owned());
    let not_one_of = |(line, text): (usize, &str), words: &str| {
        ReferenceError::at(&format!("{file}, line {line}"), format!("`{text}` is not one of {words}"))
    };
    let (origin, confidence) = (value("kind")?, value("confidence")?);
    let known = ReferenceKind::ALL.into_iter().find(|(word, _)| *word == origin.1);
    Ok(Metadata {
        quantity: text("quantity")?,
        unit: text("unit")?,
        origin: known.ok_or_else(|| not_one_of(origin, &ReferenceKind::ALL.map(|(word, _)| word).join(", ")))?.1,
        confidence: Confidence::stated(confidence.1).ok_or_else(|| not_one_of(confidence, Confidence::STATED))?,
        uncertainty: text("uncertainty")?,
        source: text("source")?,
        licence: text("licence")?,
    })
}

#[cfg(test)]
#[path = "measured_tests.rs"]
mod tests;
