//! Tables as CSV.

use serde::{Deserialize, Serialize};
use std::io;
use std::path::Path;

/// A table that becomes one CSV file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// File name without ending, kebab-case.
    pub name: String,
    /// Column headings with units in brackets, such as `y [m]`.
    pub columns: Vec<String>,
    /// Rows of the same length as `columns`.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// Writes the table as `<name>.csv` into a folder, every number with all its digits.
    ///
    /// # Errors
    /// A file that cannot be written, or a row that is not as long as the heading.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        let mut writer = csv::Writer::from_path(folder.join(format!("{}.csv", self.name)))?;
        writer.write_record(&self.columns)?;
        for row in &self.rows {
            writer.serialize(row)?;
        }
        writer.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(text, "y [m],u [m/s]\n0.0,0.30000000000000004\n1e-20,NaN\n");
    }
}
