//! Tables of numbers as programs write them: comma, semicolon, tab or blanks between the columns, comments before.

use super::field::FieldError;
use super::name::{did_you_mean, name_and_unit, nearest, unnumbered};
use super::table::{is_comment, number_remedy, plain_lines, row_remedy, text_fault};
use std::path::Path;

/// A table that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct TextTable {
    /// Headings, or `1`, `2`, … where the file has none.
    pub headings: Vec<String>,
    /// Values, column by column.
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
        let table = TableRows::of(text, file)?;
        let wrong = |line: usize, defect: &str, remedy: &str| {
            FieldError::finding(&format!("line {line}"), defect, remedy).in_file(file)
        };
        let Some((_, first)) = table.rows.first() else {
            return Err(wrong(1, "no table of numbers below it", "give a file with columns of numbers"));
        };
        if let Some(fault) = table.heading.as_ref().and_then(|(line, _)| text_above(*line, first)) {
            return Err(fault.in_file(file));
        }
        let headings: Vec<String> = match table.headings() {
            [] => (1..=first.len()).map(|column| column.to_string()).collect(),
            headings => headings.iter().map(|heading| (*heading).to_owned()).collect(),
        };
        let mut columns = vec![Vec::new(); first.len()];
        for (line, words) in table.rows {
            for ((column, name), word) in columns.iter_mut().zip(&headings).zip(words) {
                let value = word.parse::<f64>().map_err(|_| {
                    let defect = format!("\"{}\" in column {} is not a number", shortened(word), shortened(name));
                    wrong(line, &defect, number_remedy(word))
                })?;
                column.push(value);
            }
        }
        Ok(Self { headings, columns })
    }

    /// A column by its heading; of repeats, which have the same heading but for a number such as `#2`, their mean.
    ///
    /// # Errors
    /// A heading that the file does not have; `field` is where it is asked for.
    pub fn column(&self, heading: &str, field: &str, file: &Path) -> Result<Vec<f64>, FieldError> {
        let is_meant = |own: &str| own == heading || of_repeats(own) == heading;
        let named = self.headings.iter().zip(&self.columns).filter(|(own, _)| is_meant(own));
        let repeats: Vec<&Vec<f64>> = named.map(|(_, column)| column).collect();
        let Some(first) = repeats.first() else {
            let guess = did_you_mean(&nearest(heading, self.headings.iter().map(String::as_str)));
            let defect = format!("no column \"{heading}\" in {}", file.display());
            let headings = shortened(&self.headings.join(", "));
            let remedy = format!("{guess}give one of its headings exactly as written: {headings}");
            return Err(FieldError::finding(field, defect, &remedy));
        };
        let mean = |row: usize| repeats.iter().map(|own| own[row]).sum::<f64>() / repeats.len() as f64;
        Ok((0..first.len()).map(mean).collect())
    }
}

/// A heading without the number of a repeat: `front [cm]` of `front #2 [cm]`.
pub fn of_repeats(heading: &str) -> String {
    name_and_unit(heading)
        .map_or_else(|| unnumbered(heading).to_owned(), |(name, unit)| format!("{} [{unit}]", unnumbered(name)))
}

/// The words of a table, row by row, each row with the number of its line from 1.
pub struct TableRows<'t> {
    /// Names of the columns; none where the first row holds numbers.
    pub heading: Option<(usize, Vec<&'t str>)>,
    /// Words of the last comment above the rows.
    comment: Vec<&'t str>,
    /// Rows, each with its line number and as many words.
    pub rows: Vec<(usize, Vec<&'t str>)>,
}

impl<'t> TableRows<'t> {
    /// A heading for each column, of the first line or of the last comment above the rows; empty where there is none.
    pub fn headings(&self) -> &[&'t str] {
        let headings = self.heading.as_ref().map_or(&self.comment, |(_, words)| words);
        if self.rows.first().is_some_and(|(_, row)| row.len() == headings.len()) { headings } else { &[] }
    }

    /// The words of a text whose first line that is no comment is the heading, unless it holds numbers alone.
    ///
    /// # Errors
    /// A quote that is not closed, control characters, a line with another number of columns.
    pub fn of(text: &'t str, file: &Path) -> Result<Self, FieldError> {
        if let Some(fault) = text_fault(text) {
            return Err(fault.in_file(file));
        }
        let mut table = Self { heading: None, comment: Vec::new(), rows: Vec::new() };
        let mut lines = text.lines().filter(|line| !is_blank(line) && !is_comment(line));
        let separator =
            lines.next().and_then(|line| SEPARATORS.into_iter().find(|separator| line.contains(*separator)));
        // a heading above single words is one name
        let is_list = separator.is_none() && lines.next().is_some_and(|row| words(row, None).len() == 1);
        for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !is_blank(line)) {
            if is_comment(line) {
                let comment = line.trim_start_matches(['#', '%', ' ']);
                table.comment = if table.rows.is_empty() { words(comment, separator) } else { table.comment };
                continue;
            }
            let mut words = words(line, separator);
            let is_first = table.heading.is_none() && table.rows.is_empty();
            // blanks also part the words of a heading
            let known =
                table.heading.as_ref().filter(|_| separator.is_some()).map(|(_, words)| (words.len(), "heading has"));
            let known = known.or_else(|| table.rows.first().map(|(_, words)| (words.len(), "lines before have")));
            // separators behind the last column, as spreadsheets write them
            let least = known.map_or(0, |(columns, _)| columns);
            while separator.is_some() && words.len() > least && words.last().is_some_and(|word| word.is_empty()) {
                words.pop();
            }
            // quotes around nothing
            if words.is_empty() {
                continue;
            }
            if is_first && words.iter().any(|word| word.parse::<f64>().is_err()) {
                table.heading = Some((number, if is_list { vec![line.trim()] } else { words }));
                continue;
            }
            if let Some((columns, whose)) = known.filter(|(columns, _)| *columns != words.len()) {
                let above = table.heading.as_ref().filter(|_| table.rows.is_empty());
                if let Some(fault) = above.and_then(|(line, _)| text_above(*line, &words)) {
                    return Err(fault.in_file(file));
                }
                let defect = format!("{} columns, and the {whose} {columns}", words.len());
                let remedy = row_remedy(line, &words, columns);
                return Err(FieldError::finding(&format!("line {number}"), defect, &remedy).in_file(file));
            }
            table.rows.push((number, words));
        }
        Ok(table)
    }
}

/// Fault of a heading above a row that is another one.
fn text_above(line: usize, row: &[&str]) -> Option<FieldError> {
    let is_name = |word: &&str| word.starts_with(|first: char| first.is_alphabetic() || "[(".contains(first));
    let is_heading = row.iter().all(|word| is_name(word) && word.parse::<f64>().is_err());
    let remedy = "put # before it, and write units into the heading";
    let field = format!("line {line}");
    is_heading.then(|| FieldError::finding(&field, "a line of text above the heading", remedy))
}

/// Whether a line holds nothing, or nothing but separators.
fn is_blank(line: &str) -> bool {
    line.chars().all(|letter| letter.is_whitespace() || SEPARATORS.contains(&letter))
}

fn words(line: &str, separator: Option<char>) -> Vec<&str> {
    match separator {
        // most rows of large files
        Some(separator) if !line.contains('"') => line.split(separator).map(str::trim).collect(),
        None if line.is_ascii() && !line.contains('"') && !line.contains('(') => {
            line.split_ascii_whitespace().collect()
        }
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
        assert_eq!(message(""), "a.csv: `line 1`: no table of numbers below it; give a file with columns of numbers");
        assert_eq!(
            message("x,y\n1,2\n3\n"),
            "a.csv: `line 3`: 1 columns, and the heading has 2; complete or shorten the row"
        );
        assert_eq!(
            message("1,2\n3\n"),
            "a.csv: `line 2`: 1 columns, and the lines before have 2; complete or shorten the row"
        );
        assert_eq!(
            message("x,y\n1,2\n3,b\n"),
            "a.csv: `line 3`: \"b\" in column y is not a number; use a decimal point"
        );
        assert_eq!(
            message("x,y\n1,\n3,2\n"),
            "a.csv: `line 2`: \"\" in column y is not a number; leave out rows with missing values"
        );
        assert_eq!(
            message("x,y,z\n1,2\n"),
            "a.csv: `line 2`: 2 columns, and the heading has 3; complete or shorten the row"
        );
        assert_eq!(
            message("x,y\n\"1,234.5\",2\n"),
            "a.csv: `line 2`: \"1,234.5\" in column x is not a number; write numbers without separators of thousands"
        );
        for text in ["Run 7 of June\nx,y\n1,2\n", "Run 7, sand, June\nx [m],y\n1,2\n", "x,y\n[m],[m]\n1,2\n"] {
            let said = "a.csv: `line 1`: a line of text above the heading; put # before";
            assert!(message(text).starts_with(said), "{}", message(text));
        }
        assert_eq!(message("x,y\n1,2\n\"3,4\n"), "a.csv: `line 3`: unclosed quote; close the quote, or remove it");
        assert!(message("x,y\n1,5,2,5\n").ends_with("write 1.5 for 1,5, or complete or shorten the row"));
        assert!(message("x,y\n1,\u{202e}2\n").contains("U+202E"));
        assert!(message("\t\"\"").contains("no table of numbers"));
        assert_eq!(parse("\u{feff}x,y\n1,2\n").expect("a table").headings, ["x", "y"]);
        let table = parse("x,velocity\n1,2\n").expect("a table");
        assert_eq!(
            table.column("velocty", "columns.vx", Path::new("a.csv")).expect_err("no such column").to_string(),
            "`columns.vx`: no column \"velocty\" in a.csv; did you mean `velocity`? give one of its headings exactly as written: x, velocity"
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
