//! Tables of numbers as programs write them: comma, semicolon, tab or blanks between the columns, comments before.

use super::field::FieldError;
use super::name::{did_you_mean, nearest};
use super::table::{is_comment, number_remedy, plain_lines, row_remedy, text_fault};
use std::path::Path;

/// A table that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct TextTable {
    /// Headings, or `1`, `2`, … where the file has none.
    pub headings: Vec<String>,
    /// Column by column.
    pub columns: Vec<Vec<f64>>,
}

/// Separators in the order in which they are tried; blanks are what is left.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

impl TextTable {
    /// Reads a table. Lines that begin with `#` or `%` are comments, the last of which is the heading if it has as many
    /// words as there are columns and no other heading follows.
    ///
    /// # Errors
    /// No numbers, a quote that is not closed, a line with another number of columns, or a word where a number should be.
    pub fn parse(text: &str, file: &Path) -> Result<Self, FieldError> {
        let text = &*plain_lines(text);
        if let Some(fault) = text_fault(text) {
            return Err(fault.field_error().in_file(file));
        }
        let wrong = |line: usize, value: &str, rule: &str, remedy: &str| {
            FieldError::new(&format!("line {}", line + 1), value, rule, remedy).in_file(file)
        };
        let mut comment = "";
        let mut heading: Option<Vec<String>> = None;
        let mut heading_line = 0;
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let separator = text
            .lines()
            .find(|line| !is_blank(line) && !is_comment(line))
            .and_then(|line| SEPARATORS.into_iter().find(|separator| line.contains(*separator)));
        for (number, line) in text.lines().enumerate() {
            if is_blank(line) {
                continue;
            }
            if is_comment(line) {
                comment = line.trim_start_matches(['#', '%', ' ']);
                continue;
            }
            let mut words = words(line, separator);
            // separators behind the last column, as spreadsheets write them
            let known = heading.as_ref().map_or(columns.len(), Vec::len);
            while separator.is_some() && words.len() > known && words.last().is_some_and(|word| word.is_empty()) {
                words.pop();
            }
            if columns.is_empty() {
                let is_name =
                    |word: &&str| word.starts_with(|first: char| first.is_alphabetic() || "[(".contains(first));
                if heading.is_some() && words.iter().all(|word| is_name(word) && word.parse::<f64>().is_err()) {
                    let remedy = "put # before text above the table, and units into its heading";
                    return Err(wrong(heading_line, "text above another line of text", "the heading", remedy));
                }
                if heading.is_none() && words.iter().any(|word| word.parse::<f64>().is_err()) {
                    heading_line = number;
                    heading = Some(words.iter().map(|word| (*word).to_owned()).collect());
                    continue;
                }
                // blanks also part the words of a heading
                if let Some(heading) = heading.as_ref().filter(|own| separator.is_some() && own.len() != words.len()) {
                    let defect = format!("{} columns, and the heading has {}", words.len(), heading.len());
                    return Err(wrong(number, &defect, "", row_remedy(line, words.len(), heading.len())));
                }
                columns = vec![Vec::new(); words.len()];
            }
            if words.len() != columns.len() {
                let defect = format!("{} columns, and the lines before have {}", words.len(), columns.len());
                return Err(wrong(number, &defect, "", row_remedy(line, words.len(), columns.len())));
            }
            for (place, (column, word)) in columns.iter_mut().zip(words).enumerate() {
                let value = word.parse::<f64>().map_err(|_| {
                    let name = heading.as_ref().and_then(|own| own.get(place).cloned());
                    let name = name.unwrap_or_else(|| (place + 1).to_string());
                    let value = format!("\"{}\" in column {}", shortened(word), shortened(&name));
                    wrong(number, &value, "a number", number_remedy(word))
                })?;
                column.push(value);
            }
        }
        if columns.is_empty() {
            return Err(wrong(0, "without numbers", "the first of a table", "give a file with columns of numbers"));
        }
        let headings = heading
            .or_else(|| Some(words(comment, separator).into_iter().map(str::to_owned).collect()))
            .filter(|headings: &Vec<String>| headings.len() == columns.len())
            .unwrap_or_else(|| (1..=columns.len()).map(|column| column.to_string()).collect());
        Ok(Self { headings, columns })
    }

    /// A column by its heading.
    ///
    /// # Errors
    /// A heading that the file does not have; `field` is where it is asked for.
    pub fn column(&self, heading: &str, field: &str, file: &Path) -> Result<&[f64], FieldError> {
        let place = self.headings.iter().position(|own| own == heading);
        place.map(|place| self.columns[place].as_slice()).ok_or_else(|| {
            let guess = did_you_mean(&nearest(heading, self.headings.iter().map(String::as_str)));
            let rule = format!("a column of {}: {}", file.display(), shortened(&self.headings.join(", ")));
            FieldError::new(field, format!("\"{heading}\""), &rule, &format!("{guess}headings are taken as they stand"))
        })
    }
}

/// Whether a line holds nothing, or nothing but separators.
fn is_blank(line: &str) -> bool {
    line.chars().all(|letter| letter.is_whitespace() || SEPARATORS.contains(&letter))
}

fn words(line: &str, separator: Option<char>) -> Vec<&str> {
    match separator {
        Some(separator) => {
            let (mut is_quoted, mut begins) = (false, true);
            let ends_word = |letter: char| {
                is_quoted ^= letter == '"' && (begins || is_quoted);
                let ends = letter == separator && !is_quoted;
                begins = ends || (begins && letter.is_whitespace());
                ends
            };
            line.trim_end_matches(['\r', '\n']).split(ends_word).map(bare).collect()
        }
        // vectors of OpenFOAM stand in parentheses
        None if line.trim_start().starts_with(|first: char| first.is_ascii_digit() || "+-.(".contains(first)) => {
            let is_blank = |letter: char| letter.is_whitespace() || letter == '(' || letter == ')';
            line.split(is_blank).filter(|word| !word.is_empty()).map(bare).collect()
        }
        None => line.split_whitespace().map(bare).collect(),
    }
}

fn bare(word: &str) -> &str {
    word.trim().trim_matches('"')
}

/// Enough of a text to recognise it.
fn shortened(text: &str) -> String {
    const LONGEST: usize = 200;
    if text.chars().count() <= LONGEST { text.to_owned() } else { text.chars().take(LONGEST).chain(['…']).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<TextTable, FieldError> {
        TextTable::parse(text, Path::new("a.csv"))
    }

    #[test]
    fn separators_headings_and_comments_are_told() {
        let expected = [vec![1.0, 3.0], vec![2.0, -4e-3]];
        for text in [
            "x [m],u\n1,2\n3,-4e-3\n",
            "# made by a program\nx [m];u\n1;2\n3;-4e-3",
            "\"x [m]\"\tu\r\n1\t2\r\n\r\n3\t-4e-3\r\n",
            "# by an old program\rx [m],u\r1,2\r3,-4e-3\r",
            "x [m],u,,\n1,2,,\n3,-4e-3\n,,,\n",
        ] {
            let table = parse(text).expect("a table");
            assert_eq!(
                (table.headings.join("|").as_str(), table.columns.as_slice()),
                ("x [m]|u", &expected[..]),
                "{text}"
            );
        }
        let table = parse("# y u\n  1   2\n 3 -4e-3").expect("a table");
        assert_eq!((table.headings.join("|").as_str(), table.columns.as_slice()), ("y|u", &expected[..]));
        assert_eq!(parse("1 2\n3 4").expect("a table").headings, ["1", "2"]);
        // probes of OpenFOAM
        assert_eq!(parse("# Time\n0.1 (1 2 0)\n0.2 (3 4 0)").expect("a table").columns[2], [2.0, 4.0]);
    }

    #[test]
    fn invalid_table_is_refused_by_line() {
        let message = |text: &str| parse(text).expect_err("no table").to_string();
        assert_eq!(
            message(""),
            "a.csv: `line 1` is without numbers, but must be the first of a table; give a file with columns of numbers"
        );
        assert_eq!(
            message("x,y\n1,2\n3\n"),
            "a.csv: `line 3`: 1 columns, and the lines before have 2; complete or shorten the row"
        );
        assert_eq!(
            message("x,y\n1,2\n3,b\n"),
            "a.csv: `line 3` is \"b\" in column y, but must be a number; write decimals with a point"
        );
        assert_eq!(
            message("x,y\n1,\n3,2\n"),
            "a.csv: `line 2` is \"\" in column y, but must be a number; leave out rows in which a value is missing"
        );
        assert_eq!(
            message("x,y,z\n1,2\n"),
            "a.csv: `line 2`: 2 columns, and the heading has 3; complete or shorten the row"
        );
        assert_eq!(
            message("x,y\n\"1,234.5\",2\n"),
            "a.csv: `line 2` is \"1,234.5\" in column x, but must be a number; write numbers without separators of thousands"
        );
        for text in ["Run 7 of June\nx,y\n1,2\n", "Run 7, sand, June\nx [m],y\n1,2\n", "x,y\n[m],[m]\n1,2\n"] {
            let said = "a.csv: `line 1` is text above another line of text, but must be the heading; put # before";
            assert!(message(text).starts_with(said), "{}", message(text));
        }
        assert_eq!(message("x,y\n1,2\n\"3,4\n"), "a.csv: `line 3`: unclosed quote; close the quote, or remove it");
        assert!(message("x,y\n1,5,2,5\n").ends_with("write decimals with a point, or complete or shorten the row"));
        assert!(message("x,y\n1,\u{202e}2\n").contains("U+202E"));
        assert_eq!(parse("\u{feff}x,y\n1,2\n").expect("a table").headings, ["x", "y"]);
        let table = parse("x,velocity\n1,2\n").expect("a table");
        assert_eq!(
            table.column("velocty", "columns.vx", Path::new("a.csv")).expect_err("no such column").to_string(),
            "`columns.vx` is \"velocty\", but must be a column of a.csv: x, velocity; did you mean `velocity`? headings are taken as they stand"
        );
    }

    proptest::proptest! {
        #[test]
        fn any_text_is_a_whole_table_or_refused(text in "[-0-9a-c.,;\\t e#\"\n\r]{0,80}") {
            if let Ok(table) = parse(&text) {
                let rows = table.columns.first().map_or(0, Vec::len);
                proptest::prop_assert!(rows > 0 && table.columns.iter().all(|column| column.len() == rows));
                proptest::prop_assert_eq!(table.headings.len(), table.columns.len());
            }
        }
    }
}
