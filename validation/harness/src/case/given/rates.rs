//! Tables of rates that the inlets of a case file name: their rows are read with the file and are parameters like any others,
//! so that a run is known by them, whatever becomes of their file.

use super::error::ParameterError;
use crate::input::{DOCUMENT, FieldError, TextTable, name_and_unit, read_text, unit};
use std::path::Path;
use toml::{Table, Value};

/// Most rows of all tables together.
const MOST_ROWS: usize = 100_000;

/// Adds the rows of the tables that `inlets` name by a path from the case file on. An inlet that has rows keeps them: the name
/// then says where they came from.
pub(in crate::case) fn read_beside(fields: &mut Table, path: &Path) -> Result<(), ParameterError> {
    let beside = path.parent().unwrap_or(Path::new(""));
    let mut count = 0;
    let inlets = fields.get_mut("inlets").and_then(Value::as_array_mut);
    for (index, inlet) in inlets.into_iter().flatten().enumerate() {
        let Some(inlet) = inlet.as_table_mut().filter(|inlet| !inlet.contains_key("rates")) else { continue };
        let Some(name) = inlet.get("table").and_then(Value::as_str).filter(|name| !name.is_empty()) else { continue };
        let field = format!("inlets[{index}].table");
        let refused = |defect: &str, remedy: &str| {
            ParameterError::field(&field, format!("\"{name}\" {defect}"), "", remedy).in_file(path)
        };
        let text = read_text(&beside.join(name), DOCUMENT).map_err(|error| {
            let remedy = "check the path, which is relative to this file, and its permissions";
            refused(&format!("cannot be read ({error})"), remedy)
        })?;
        // an opening in the plane feeds per width
        let rate_unit = if inlet.contains_key("corners") { "kg/s" } else { "kg/(m s)" };
        let rows = rows(&text, &beside.join(name), rate_unit)?;
        count += rows.len();
        if count > MOST_ROWS {
            let defect = format!("has, with the tables before it, more than {MOST_ROWS} rows");
            return Err(refused(&defect, "give fewer times; the rate is linear between them"));
        }
        let row = |(time, rate): (f64, f64)| Value::Array(vec![Value::Float(time), Value::Float(rate)]);
        inlet.insert("rates".to_owned(), rows.into_iter().map(row).collect::<Vec<_>>().into());
    }
    Ok(())
}

/// The rows of a table, in s and the unit of rates.
fn rows(text: &str, file: &Path, rate_unit: &str) -> Result<Vec<(f64, f64)>, FieldError> {
    let TextTable { headings, columns } = TextTable::parse(text, file)?;
    let [times, rates] = &columns[..] else {
        let defect = format!("{} columns instead of 2", columns.len());
        return Err(FieldError::finding("table", defect, "give a time and a rate in each row").in_file(file));
    };
    let in_unit = |place: usize, values: &[f64], own| in_unit(&headings[place], values, own, file);
    let (times, rates) = (in_unit(0, times, "s")?, in_unit(1, rates, rate_unit)?);
    Ok(times.into_iter().zip(rates).collect())
}

/// The values of a column in a unit, in which they are taken to be where the heading has none.
pub(super) fn in_unit(heading: &str, values: &[f64], own: &str, file: &Path) -> Result<Vec<f64>, FieldError> {
    let refused = |value: String, rule: &str, remedy| Err(FieldError::new(heading, value, rule, remedy).in_file(file));
    if let Some(row) = values.iter().position(|value| !value.is_finite()) {
        let value = format!("{} in row {}", values[row], row + 1);
        return refused(value, "a finite number", "correct the row, or leave it out");
    }
    let given = name_and_unit(heading).map_or(own, |(_, unit)| unit);
    match unit::factor(given, own) {
        Some(factor) => Ok(values.iter().map(|value| value * factor).collect()),
        None => refused(format!("[{given}]"), &format!("a unit that converts to [{own}]"), "correct the unit"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_with_the_file_that_names_them() {
        let folder = tempfile::tempdir().expect("temporary folder");
        std::fs::write(folder.path().join("feed.csv"), "# measured\nt [ms],rate [g/(s cm)]\n0,15\n2500, 0\n")
            .expect("writable");
        let path = folder.path().join("case.toml");
        let mut fields: Table =
            toml::from_str("[[inlets]]\ntable = \"feed.csv\"\n[[inlets]]\nrate = 2.0").expect("TOML");
        read_beside(&mut fields, &path).expect("read");
        let expected = "[[inlets]]\ntable = \"feed.csv\"\nrates = [[0.0, 1.5], [2.5, 0.0]]\n[[inlets]]\nrate = 2.0";
        assert_eq!(fields, toml::from_str(expected).expect("TOML"));
        let mut own: Table = toml::from_str("[[inlets]]\ntable = \"gone.csv\"\nrates = [[0.0, 1.0]]").expect("TOML");
        assert!(read_beside(&mut own, &path).is_ok(), "an inlet that has rows needs no file");
    }

    #[test]
    fn invalid_tables_are_named_by_line_and_units_are_converted() {
        let read = |text: &str| rows(text, Path::new("a.csv"), "kg/s").map_err(|error| error.to_string());
        for (text, said) in [
            ("t,q\n0,1\n1\n", "a.csv: `line 3`: 1 columns"),
            ("t,q\n# a note\n0,one\n", "a.csv: `line 3`: \"one\" in column q"),
            ("t\n0\n", "a.csv: `table`: 1 columns instead of 2; give"),
            ("t,q\n", "a.csv: `line 1`: no table of numbers"),
            ("t,q\n0,inf\n", "a.csv: `q` is inf in row 1, but must be a finite number"),
            ("t [furlong],q\n0,1\n", "a.csv: `t [furlong]` is [furlong], but must be a unit that converts to [s]"),
            (
                "t,q [kg/(m s)]\n0,1\n",
                "a.csv: `q [kg/(m s)]` is [kg/(m s)], but must be a unit that converts to [kg/s]",
            ),
        ] {
            assert!(read(text).is_err_and(|message| message.starts_with(said)), "{said}");
        }
        assert_eq!(read("t [s];q [kg/h]\r\r0;3600\r"), Ok(vec![(0.0, 1.0)]));
    }
}
