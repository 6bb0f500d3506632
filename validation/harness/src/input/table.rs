//! Faults in the text of any table: quotes, control characters, separators, decimals.

use super::escape::is_control;
use super::field::FieldError;
use std::borrow::Cow;

/// A table's text without a byte-order mark, which would hide its first comment, and with the line ends of old Macintosh
/// programs as others write them.
pub fn plain_lines(text: &str) -> Cow<'_, str> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.contains('\n') { Cow::Borrowed(text) } else { Cow::Owned(text.replace('\r', "\n")) }
}

/// Whether a number stands for no value, as loggers write it.
pub fn is_mark(value: f64) -> bool {
    [-9999.0, -99999.0].contains(&value)
}

/// Fault in the text of a table, with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TableFault {
    /// Line, from 1.
    pub line: usize,
    /// Column of the table, from 1, as far as commas tell.
    pub column: usize,
    /// Defect of the line.
    defect: String,
    remedy: &'static str,
}

impl TableFault {
    /// As the error of a field of which the line is one.
    pub(crate) fn field_error(&self) -> FieldError {
        FieldError::finding(&format!("line {}", self.line), &self.defect, self.remedy)
    }

    /// Defect and remedy, behind the name of the line.
    pub fn in_words(&self) -> String {
        format!("{}; {}", self.defect, self.remedy)
    }
}

/// The first unclosed quote or control character of a text. A quoted word ends on its line: nothing in a table of numbers
/// goes over several.
pub fn text_fault(text: &str) -> Option<TableFault> {
    text.split('\n').enumerate().find_map(|(index, line)| {
        let fault = |before: &str, defect, remedy| {
            Some(TableFault { line: index + 1, column: before.matches(',').count() + 1, defect, remedy })
        };
        // a byte that is no text, as in files of two bytes a letter
        if let Some(place) = line.find(|letter: char| is_control(letter) && !matches!(letter, '\t' | '\r')) {
            let letter = line[place..].chars().next().map_or(0, u32::from);
            let remedy = "remove it, or write the file as plain text in UTF-8";
            return fault(&line[..place], format!("control character U+{letter:04X}"), remedy);
        }
        let open = if is_comment(line) { None } else { open_quote(line) };
        open.and_then(|place| fault(&line[..place], "unclosed quote".to_owned(), "close the quote, or remove it"))
    })
}

/// Position of the first unclosed quote in a line. Quotes open at the beginning of a word; two in a quoted word are one
/// that is meant.
fn open_quote(line: &str) -> Option<usize> {
    let mut open = None;
    let mut begins = true;
    let mut letters = line.char_indices().peekable();
    while let Some((place, letter)) = letters.next() {
        match (open, letter) {
            (None, '"') if begins => open = Some(place),
            (Some(_), '"') if letters.next_if(|(_, next)| *next == '"').is_none() => open = None,
            _ => {}
        }
        begins = matches!(letter, ',' | ';') || letter.is_whitespace();
    }
    open
}

/// A heading whose columns are parted otherwise than by commas; `line` is its number, from 1.
pub fn comma_fault(heading: &str, line: usize) -> Option<TableFault> {
    const REMEDY: &str = "separate the columns by commas, and write decimals with a point";
    let separator = if heading.contains(',') {
        return None;
    } else if heading.contains(';') {
        "semicolons"
    } else if heading.contains('\t') {
        "tabs"
    } else if heading.matches('[').count() > 1 {
        "blanks"
    } else {
        return None;
    };
    Some(TableFault { line, column: 1, defect: format!("columns separated by {separator}"), remedy: REMEDY })
}

/// Remedy for a word in the place of a number.
pub fn number_remedy(word: &str) -> &'static str {
    let are_numbers = |separator: char| {
        word.contains(separator) && word.split(separator).all(|part| is_number(part) || has_decimal_comma(part))
    };
    if is_missing(word) {
        "leave out rows in which a value is missing"
    } else if are_numbers(';') {
        "several values separated by semicolons: use one separator for all columns, and write decimals with a point"
    } else if are_numbers('\t') || (word.contains(' ') && word.split_whitespace().all(is_number)) {
        "several values separated by blanks or tabs: use one separator for all columns"
    } else if !has_decimal_comma(word) && is_number(&word.replace(',', "")) {
        "write numbers without separators of thousands"
    } else {
        "write decimals with a point"
    }
}

/// Remedy for a row whose number of values differs from the number of columns.
pub fn row_remedy(row: &str, values: usize, columns: usize) -> &'static str {
    if [';', '\t'].iter().any(|separator| row.matches(*separator).count() + 1 == columns) {
        "use one separator for the whole table"
    } else if columns > 0 && values == 2 * columns {
        "write decimals with a point, or complete or shorten the row"
    } else {
        "complete or shorten the row"
    }
}

fn is_number(word: &str) -> bool {
    word.trim().parse::<f64>().is_ok()
}

fn has_decimal_comma(word: &str) -> bool {
    word.matches(',').count() == 1 && is_number(&word.replace(',', "."))
}

/// Whether a word stands for no value.
fn is_missing(word: &str) -> bool {
    ["", "-", "--", "na", "n/a", "null", "none"].contains(&word.to_ascii_lowercase().as_str())
        || word.parse().is_ok_and(is_mark)
}

/// Whether a line is a comment.
pub fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quote_that_is_not_closed_is_named_by_its_line() {
        for sound in
            ["", "a,b\n1,2\n", "\"x, [m]\",u\n1,\"2\"\n", "5\",3\n", "# it is 5\" or \"so\n1\n", "\"a \"\"b\"\"\",1\n"]
        {
            assert_eq!(text_fault(sound), None, "{sound}");
        }
        for (text, line, column) in [
            ("\"x,u\n1,2\n", 1, 1),
            ("x,u\n1,\"2\n3,4\n", 2, 2),
            ("x;u\n1; \"2\n\"3\";4\n", 2, 1),
            ("x,u\n1,2\n3,\"4", 3, 2),
            ("x,u\n1,\"a \"\" b\n", 2, 2),
        ] {
            let fault = text_fault(text).expect(text);
            assert_eq!((fault.line, fault.column), (line, column), "{text}");
            assert_eq!(
                fault.field_error().to_string(),
                format!("`line {line}`: unclosed quote; close the quote, or remove it")
            );
        }
    }

    #[test]
    fn control_characters_are_named_by_their_number() {
        let fault = text_fault("x,u\r\n1\t,\u{1b}[2J2\n").expect("an escape");
        assert_eq!((fault.line, fault.column), (2, 2));
        assert!(fault.in_words().starts_with("control character U+001B; "));
        assert!(text_fault("# source: a\u{202e}b\n").is_some());
        // two bytes a letter
        assert_eq!(text_fault("x\0,\0u\0\n\0").map(|fault| fault.line), Some(1));
    }

    #[test]
    fn other_separators_and_decimals_are_told() {
        assert_eq!(comma_fault("height [m],u [m/s]", 8), None);
        assert_eq!(comma_fault("height [m]", 8), None);
        for (heading, by) in [("y [m];u [m/s]", "semicolons"), ("y [m]\tu [m/s]", "tabs"), ("y [m]  u [m/s]", "blanks")]
        {
            let words = comma_fault(heading, 8).expect("no commas").in_words();
            let expected =
                format!("columns separated by {by}; separate the columns by commas, and write decimals with a point");
            assert_eq!(words, expected);
        }
        assert!(number_remedy("1;2").starts_with("several values separated by semicolons"));
        assert!(number_remedy("1,5;2").starts_with("several values separated by semicolons"));
        assert!(number_remedy("1 2").starts_with("several values separated by blanks or tabs"));
        assert_eq!(number_remedy("1,5"), "write decimals with a point");
        assert_eq!(number_remedy("1,234.5"), "write numbers without separators of thousands");
        assert_eq!(number_remedy("-9999"), "leave out rows in which a value is missing");
        assert_eq!(number_remedy("N/A"), "leave out rows in which a value is missing");
        assert!(row_remedy("1,5,2,5", 4, 2).starts_with("write decimals with a point, or"));
        assert!(row_remedy("1;2", 1, 2).starts_with("use one separator"));
        assert_eq!(row_remedy("1,2,3", 3, 2), "complete or shorten the row");
    }
}
