//! Tables as CSV.

use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;

/// Stands in a table for a value that does not exist, such as the velocity at a place where nothing is.
///
/// A file has an empty cell for it, JSON null and a figure a gap; no mean and no gate counts it.
pub const ABSENT: f64 = f64::NAN;

/// A table that becomes one CSV file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// File name without ending, kebab-case.
    pub name: String,
    /// Column headings with units in brackets, such as `y [m]`.
    pub columns: Vec<String>,
    /// Rows of the same length as `columns`; [`ABSENT`] where there is no value.
    pub rows: Vec<Vec<f64>>,
}

/// Rows as CSV: lists of cells, or structs, which get a heading.
///
/// # Errors
/// Lists of different lengths.
pub fn csv_text<Row: Serialize>(rows: impl IntoIterator<Item = Row>) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    rows.into_iter().try_for_each(|row| writer.serialize(row))?;
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

impl Table {
    /// A table from its rows.
    pub fn of_rows(name: String, columns: &[&str], rows: impl IntoIterator<Item = Vec<f64>>) -> Self {
        let columns = columns.iter().map(|&column| column.to_owned()).collect();
        Self { name, columns, rows: rows.into_iter().collect() }
    }

    /// A table from arrays of the same length, each under its heading.
    pub fn of_columns(name: String, columns: &[(&str, &[f64])]) -> Self {
        let rows = columns.iter().map(|(_, array)| array.len()).min().unwrap_or(0);
        let headings: Vec<&str> = columns.iter().map(|(heading, _)| *heading).collect();
        Self::of_rows(name, &headings, (0..rows).map(|row| columns.iter().map(|(_, array)| array[row]).collect()))
    }

    /// Writes the table as `<name>.csv` into a folder, every number with all its digits, [`ABSENT`] as an empty cell.
    ///
    /// # Errors
    /// A file that cannot be written, or a row that is not as long as the heading.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let mut writer = csv::Writer::from_path(folder.join(format!("{}.csv", self.name)))?;
        writer.write_record(&self.columns)?;
        for row in &self.rows {
            writer
                .serialize(row.iter().map(|value| Some(value).filter(|value| !value.is_nan())).collect::<Vec<_>>())?;
        }
        writer.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_become_columns() {
        let table = Table::of_columns("series".to_owned(), &[("t [s]", &[0.0, 1.0]), ("u [m/s]", &[2.0, 3.0])]);
        assert_eq!(table.columns, ["t [s]", "u [m/s]"]);
        assert_eq!(table.rows, [[0.0, 2.0], [1.0, 3.0]]);
    }

    #[test]
    fn a_table_is_written_with_its_heading_and_every_digit() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let table = Table {
            name: "profile".to_owned(),
            columns: vec!["y [m]".to_owned(), "u [m/s]".to_owned()],
            rows: vec![vec![0.0, 0.1 + 0.2], vec![1e-20, f64::NAN]],
        };
        table.write(folder.path()).expect("writable");
        let text = std::fs::read_to_string(folder.path().join("profile.csv")).expect("written");
        assert_eq!(text, "y [m],u [m/s]\n0.0,0.30000000000000004\n1e-20,\n");
    }
}
