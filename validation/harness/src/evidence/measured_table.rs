//! The table of a reference file: CSV text → columns, with the place of everything that is wrong.

use super::ReferenceError;
use crate::input::{comma_fault, is_mark, row_remedy, text_fault};

/// No measured number is larger, in whatever unit; squares of such numbers are still finite.
const LARGEST: f64 = 1e30;

const NO_NUMBER: &str = "not a finite measured value; write one with a decimal point, or drop the row";

/// One column of a reference table.
#[derive(Clone, Debug, PartialEq)]
pub enum ReferenceColumn {
    /// Finite numbers in a unit.
    Numbers {
        /// Name without the unit.
        name: String,
        /// Unit, from the brackets.
        unit: String,
        /// One value a row, in that unit.
        values: Vec<f64>,
    },
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
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Numbers { name, .. } | Self::Labels { name, .. } => name,
        }
    }
}

/// Columns of the table that follows `header_lines` lines of a text.
pub(super) fn parse_table(file: &str, text: &str, header_lines: usize) -> Result<Vec<ReferenceColumn>, ReferenceError> {
    let table: String = text.lines().skip(header_lines).flat_map(|line| [line, "\n"]).collect();
    let offset = header_lines as u64;
    let refuse = |line: u64, column: usize, rule: String| {
        ReferenceError::at(&format!("{file}, line {}, column {column}", line + offset), rule)
    };
    // of the whole text, whose lines it counts
    if let Some(fault) = text_fault(text) {
        let place = format!("{file}, line {}, column {}", fault.line, fault.column);
        return Err(ReferenceError::at(&place, fault.in_words()));
    }
    if let Some(fault) = table.lines().next().and_then(|heading| comma_fault(heading, 1)) {
        return Err(refuse(1, fault.column, fault.in_words()));
    }
    let mut reader = csv::ReaderBuilder::new().flexible(true).trim(csv::Trim::All).from_reader(table.as_bytes());
    let names = reader.headers().map_err(|error| refuse(1, 1, error.to_string()))?.clone();
    if names.is_empty() {
        return Err(refuse(1, 1, "there is no table; write the columns' names and at least one row".to_owned()));
    }
    let mut columns: Vec<ReferenceColumn> = Vec::with_capacity(names.len());
    for (index, name) in names.iter().enumerate() {
        let column = parse_name(name).map_err(|rule| refuse(1, index + 1, rule))?;
        if columns.iter().any(|other| other.name() == column.name()) {
            return Err(refuse(1, index + 1, format!("the name `{}` is used twice; rename one", column.name())));
        }
        columns.push(column);
    }
    let mut rows = 0;
    for record in reader.records() {
        let record =
            record.map_err(|error| refuse(error.position().map_or(1, csv::Position::line), 1, error.to_string()))?;
        let line = record.position().map_or(1, csv::Position::line);
        if record.len() != columns.len() {
            let row = table.lines().nth(usize::try_from(line).unwrap_or(1).saturating_sub(1)).unwrap_or_default();
            let (fields, known) = (record.len(), columns.len());
            let rule = format!("{fields} fields in a table of {known} columns; {}", row_remedy(row, fields, known));
            return Err(refuse(line, record.len().min(columns.len()), rule));
        }
        for (index, (column, text)) in columns.iter_mut().zip(&record).enumerate() {
            match column {
                ReferenceColumn::Labels { values, .. } => values.push(text.to_owned()),
                ReferenceColumn::Numbers { name, values, .. } => match text.parse::<f64>() {
                    Ok(value) if value.abs() <= LARGEST && !is_mark(value) => values.push(value),
                    _ => {
                        let place = format!("{file}, line {}, column {} (`{name}`)", line + offset, index + 1);
                        return Err(ReferenceError::at(&place, format!("`{text}` is {NO_NUMBER}")));
                    }
                },
            }
        }
        rows += 1;
    }
    if rows == 0 {
        return Err(refuse(1, 1, "the table has no rows; add at least one".to_owned()));
    }
    Ok(columns)
}

/// An empty column of a name such as `height [m]`.
fn parse_name(text: &str) -> Result<ReferenceColumn, String> {
    let column = match text.split_once('[') {
        None => ReferenceColumn::Labels { name: text.to_owned(), values: Vec::new() },
        Some((name, rest)) => {
            let unit = rest
                .strip_suffix(']')
                .ok_or_else(|| format!("`{text}` does not end with its unit's bracket; write `name [unit]`"))?;
            if unit.trim().is_empty() {
                return Err(format!("`{text}` has an empty unit; write `[-]` for a pure number"));
            }
            ReferenceColumn::Numbers { name: name.trim().to_owned(), unit: unit.trim().to_owned(), values: Vec::new() }
        }
    };
    if column.name().is_empty() {
        return Err("the column has no name; write `name [unit]`".to_owned());
    }
    Ok(column)
}
