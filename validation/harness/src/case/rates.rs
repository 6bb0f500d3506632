//! Tables of rates that the inlets of a case file name: their rows are read with the file and are parameters like any others,
//! so that a run is known by them, whatever becomes of their file.

use super::error::ParameterError;
use crate::input::{DOCUMENT, comma_fault, is_comment, number_remedy, read_text, row_remedy, text_fault, unit};
use std::path::Path;
use toml::{Table, Value};

/// Most rows of all tables together.
const MOST_ROWS: usize = 100_000;

/// Adds the rows of the tables that `inlets` name by a path from the case file on. An inlet that has rows keeps them: the name
/// then says where they came from.
pub(super) fn read_beside(fields: &mut Table, path: &Path) -> Result<(), ParameterError> {
    let beside = path.parent().unwrap_or(Path::new(""));
    let mut count = 0;
    let inlets = fields.get_mut("inlets").and_then(Value::as_array_mut);
    for (index, inlet) in inlets.into_iter().flatten().enumerate() {
        let Some(inlet) = inlet.as_table_mut().filter(|inlet| !inlet.contains_key("rates")) else { continue };
        let Some(name) = inlet.get("table").and_then(Value::as_str).filter(|name| !name.is_empty()) else { continue };
        let field = format!("inlets[{index}].table");
        let refused =
            |rule: &str, remedy: &str| ParameterError::field(&field, format!("\"{name}\""), rule, remedy).in_file(path);
        let text = read_text(&beside.join(name), DOCUMENT).map_err(|error| {
            let remedy = "check the path, which begins at this file, and its permissions";
            ParameterError::field(&field, format!("\"{name}\" cannot be read ({error})"), "", remedy).in_file(path)
        })?;
        // an opening in the plane feeds per width
        let rate_unit = if inlet.contains_key("corners") { "kg/s" } else { "kg/(s m)" };
        let rows = rows(&text, rate_unit)
            .map_err(|(line, rule, remedy)| refused(&format!("a table whose line {line} is {rule}"), &remedy))?;
        count += rows.len();
        if count > MOST_ROWS {
            let rule = format!("at most {MOST_ROWS} rows together with the tables before it");
            return Err(refused(&rule, "give fewer times: the rate is linear between them"));
        }
        let row = |(time, rate): (f64, f64)| Value::Array(vec![Value::Float(time), Value::Float(rate)]);
        inlet.insert("rates".to_owned(), rows.into_iter().map(row).collect::<Vec<_>>().into());
    }
    Ok(())
}

/// The rows of a table with a heading, in s and the unit of rates; otherwise the line that is none, the rule and what to do.
fn rows(text: &str, rate_unit: &str) -> Result<Vec<(f64, f64)>, (usize, String, String)> {
    if let Some(fault) = text_fault(text) {
        return Err((fault.line, "plain text".to_owned(), fault.in_words()));
    }
    let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    let mut lines = lines.filter(|(_, line)| !line.is_empty() && !is_comment(line));
    let heading = lines.next();
    if let Some(fault) = heading.and_then(|(line, heading)| comma_fault(heading, line)) {
        return Err((fault.line, "the heading of two columns".to_owned(), fault.in_words()));
    }
    let mut factors = [1.0; 2];
    for ((factor, word), own) in
        factors.iter_mut().zip(heading.map_or("", |(_, words)| words).split(',')).zip(["s", rate_unit])
    {
        let parted = word.trim().trim_matches('"').strip_suffix(']').and_then(|word| word.rsplit_once('['));
        let Some((_, given)) = parted.filter(|(_, given)| *given != own) else { continue };
        *factor = unit::factor(given, own).ok_or_else(|| {
            let rule = format!("a heading with units of the kinds [s] and [{rate_unit}], unlike [{given}]");
            (heading.map_or(1, |(line, _)| line), rule, "convert the column, or mend the heading".to_owned())
        })?;
    }
    let mut rows = Vec::new();
    for (number, line) in lines {
        let words: Vec<&str> = line.split(',').map(|word| word.trim().trim_matches('"')).collect();
        let [time, rate] = words[..] else {
            let rule = "a time [s] and a rate, parted by a comma".to_owned();
            return Err((number, rule, row_remedy(line, words.len(), 2).to_owned()));
        };
        let number_of = |word: &str| word.parse::<f64>().ok().filter(|value| value.is_finite());
        match (number_of(time), number_of(rate)) {
            (Some(time), Some(rate)) => rows.push((time * factors[0], rate * factors[1])),
            (Some(_), None) => return Err((number, "two numbers".to_owned(), number_remedy(rate).to_owned())),
            _ => return Err((number, "two numbers".to_owned(), number_remedy(time).to_owned())),
        }
    }
    if rows.is_empty() {
        return Err((1, "a heading, such as t [s],rate [kg/s], with rows below".to_owned(), "add the rows".to_owned()));
    }
    Ok(rows)
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
    fn lines_that_are_no_rows_are_named() {
        let refused = |text: &str| rows(text, "kg/s").expect_err("refused").0;
        assert_eq!(refused("t,q\n0,1\n1\n"), 3);
        assert_eq!(refused("t,q\n0,1\n1,2,3\n"), 3);
        assert_eq!(refused("t,q\n# a note\n0,one\n"), 3);
        assert_eq!(refused("t;q\n0;1\n"), 1);
        assert_eq!(refused("t,q\n"), 1);
        assert_eq!(refused("t,q\n0,inf\n"), 2);
        assert_eq!(rows("t [s],q [kg/h]\n\n0,3600\n", "kg/s"), Ok(vec![(0.0, 1.0)]));
        let (line, rule, _) = rows("# fed\nt [s],q [kg/(s m)]\n0,1\n", "kg/s").expect_err("per width");
        assert_eq!((line, rule.as_str()), (2, "a heading with units of the kinds [s] and [kg/s], unlike [kg/(s m)]"));
        assert_eq!(refused("t [furlong],q\n0,1\n"), 1);
    }
}
