//! Rows of the tables in `reference-data` that this package is compiled or tested with.

use std::collections::BTreeMap;

/// A row: the texts by the names of their columns, units included.
pub(crate) type TableRow = BTreeMap<String, String>;

/// The rows below the `#` lines.
pub(crate) fn rows(text: &str) -> Vec<TableRow> {
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    reader.deserialize().collect::<Result<_, _>>().unwrap_or_else(|error| panic!("a table of this package: {error}"))
}

/// The number `[unit of the column]` in a column of a row.
pub(crate) fn number(row: &TableRow, column: &str) -> f64 {
    let text = row.get(column).unwrap_or_else(|| panic!("a table of this package: no column `{column}`"));
    text.parse().unwrap_or_else(|error| panic!("a table of this package: `{text}` in `{column}`: {error}"))
}
