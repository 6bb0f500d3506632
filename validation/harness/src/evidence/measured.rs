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

    /// Values of a number column, by its name without the unit.
    pub fn numbers(&self, name: &str) -> Result<&[f64], ReferenceError> {
        self.columns
            .iter()
            .find_map(|column| match column {
                ReferenceColumn::Numbers { name: own, values, .. } if own == name => Some(values.as_slice()),
                _ => None,
            })
            .ok_or_else(|| self.no_column("number", name))
    }

    /// Values of a label column.
    pub fn labels(&self, name: &str) -> Result<&[String], ReferenceError> {
        self.columns
            .iter()
            .find_map(|column| match column {
                ReferenceColumn::Labels { name: own, values } if own == name => Some(values.as_slice()),
                _ => None,
            })
            .ok_or_else(|| self.no_column("label", name))
    }

    /// The row whose label in a column is this one; the first, if there are several.
    pub fn row(&self, column: &str, label: &str) -> Result<usize, ReferenceError> {
        let labels = self.labels(column)?;
        labels.iter().position(|own| own == label).ok_or_else(|| ReferenceError::NoRow {
            file: self.file.clone(),
            column: column.to_owned(),
            label: label.to_owned(),
            known: labels.join(", "),
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
        if !self.columns.iter().any(|column| column.name() == "confidence") {
            return Ok(vec![self.metadata.confidence; rows]);
        }
        self.labels("confidence")?
            .iter()
            .map(|word| {
                let found = CONFIDENCES.iter().find(|(known, _)| known == word).map(|(_, confidence)| *confidence);
                found.ok_or_else(|| self.bad_label("confidence", word, "high, medium, low, unverified"))
            })
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
    pub fn bad_label(&self, column: &str, label: &str, allowed: &'static str) -> ReferenceError {
        ReferenceError::Label { file: self.file.clone(), column: column.to_owned(), label: label.to_owned(), allowed }
    }

    fn no_column(&self, kind: &'static str, name: &str) -> ReferenceError {
        let known: Vec<String> = self.columns.iter().map(|column| format!("`{}`", column.name())).collect();
        ReferenceError::NoColumn { file: self.file.clone(), kind, name: name.to_owned(), known: known.join(", ") }
    }
}

const CONFIDENCES: [(&str, Confidence); 4] = [
    ("high", Confidence::High),
    ("medium", Confidence::Medium),
    ("low", Confidence::Low),
    ("unverified", Confidence::Unverified),
];

const KEYS: [&str; 7] = ["quantity", "unit", "kind", "confidence", "uncertainty", "source", "licence"];

fn parse_metadata(file: &str, text: &str, header_lines: usize) -> Result<Metadata, ReferenceError> {
    let mut found: [Option<(u64, String)>; 7] = Default::default();
    for (index, line) in text.lines().enumerate().take(header_lines) {
        let number = index as u64 + 1;
        let refuse = |rule: String| {
            Err(ReferenceError::Metadata { file: file.to_owned(), line: number, text: line.to_owned(), rule })
        };
        if line.trim().is_empty() {
            continue;
        }
        let Some((key, value)) = line.trim_start_matches('#').split_once(':') else {
            return refuse("has no colon; write `# key: value`".to_owned());
        };
        let (key, value) = (key.trim(), value.trim());
        let Some(slot) = KEYS.iter().position(|known| *known == key) else {
            return refuse(format!("has an unknown key; the keys are {}", KEYS.join(", ")));
        };
        if value.is_empty() {
            return refuse("has no value; write one, \"none\" if there is none".to_owned());
        }
        if found[slot].replace((number, value.to_owned())).is_some() {
            return refuse("repeats a key; keep one of the lines".to_owned());
        }
    }
    let mut take = |key: &'static str| {
        let slot = KEYS.iter().position(|known| *known == key);
        slot.and_then(|slot| found[slot].take()).ok_or(ReferenceError::MissingMetadata { file: file.to_owned(), key })
    };
    let origins = [
        ("analytic", ReferenceKind::Analytic),
        ("computed", ReferenceKind::Computed),
        ("fit", ReferenceKind::Fit),
        ("measured", ReferenceKind::Measured),
        ("statement", ReferenceKind::Statement),
    ];
    Ok(Metadata {
        quantity: take("quantity")?.1,
        unit: take("unit")?.1,
        origin: choose(file, take("kind")?, &origins)?,
        confidence: choose(file, take("confidence")?, &CONFIDENCES)?,
        uncertainty: take("uncertainty")?.1,
        source: take("source")?.1,
        licence: take("licence")?.1,
    })
}

/// One of a few words.
fn choose<T: Copy>(file: &str, (line, text): (u64, String), choices: &[(&str, T)]) -> Result<T, ReferenceError> {
    choices.iter().find(|(word, _)| *word == text).map(|(_, value)| *value).ok_or_else(|| {
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        ReferenceError::Metadata {
            file: file.to_owned(),
            line,
            text,
            rule: format!("is not one of {}", words.join(", ")),
        }
    })
}

#[cfg(test)]
#[path = "measured_tests.rs"]
mod tests;
