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

/// The first unclosed quote or control character of a text. A quoted word ends on its line: nothing in a table of numbers
/// goes over several.
pub fn text_fault(text: &str) -> Option<FieldError> {
    // nearly all files: no letter of any other kind, no quote
    if text.bytes().all(|byte| matches!(byte, b'\t' | b'\n' | b'\r' | b' ' | b'!' | b'#'..=b'~')) {
        return None;
    }
    (1..).zip(text.split('\n')).find_map(|(number, line)| {
        let fault = |defect: &str, remedy| Some(FieldError::finding(&format!("line {number}"), defect, remedy));
        // a byte that is no text, as in files of two bytes a letter
        if let Some(letter) = line.chars().find(|letter| is_control(*letter) && !matches!(letter, '\t' | '\r')) {
            let remedy = "remove it, or write the file as plain text in UTF-8";
            return fault(&format!("control character U+{:04X}", u32::from(letter)), remedy);
        }
        let is_open = !is_comment(line) && has_open_quote(line);
        if is_open { fault("unclosed quote", "close the quote, or remove it") } else { None }
    })
}

/// Whether a quote of a line is not closed. Quotes open at the beginning of a word; two in a quoted word are one that is meant.
fn has_open_quote(line: &str) -> bool {
    let (mut is_open, mut begins) = (false, true);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match (is_open, letter) {
            (false, '"') if begins => is_open = true,
            (true, '"') if letters.next_if(|next| *next == '"').is_none() => is_open = false,
            _ => {}
        }
        begins = matches!(letter, ',' | ';') || letter.is_whitespace();
    }
    is_open
}

/// Remedy for a word in the place of a number.
pub(super) fn number_remedy(word: &str) -> &'static str {
    let is_missing = ["", "-", "--", "na", "n/a", "null", "none"].contains(&word.to_ascii_lowercase().as_str());
    if is_missing || word.parse().is_ok_and(is_mark) {
        "leave out rows with missing values"
    } else if is_number(&word.replace(',', "")) && !is_number(&word.replace(',', ".")) {
        "write numbers without separators of thousands"
    } else if word.contains([';', '\t', ' ']) {
        "use one separator for all columns, and a decimal point"
    } else {
        "use a decimal point"
    }
}

/// Remedy for a row whose number of values differs from the number of columns.
pub(super) fn row_remedy(row: &str, words: &[&str], columns: usize) -> String {
    if [';', '\t'].iter().any(|separator| row.matches(*separator).count() + 1 == columns) {
        return "use one separator for the whole table".to_owned();
    }
    match words {
        [whole, part, ..] if words.len() == 2 * columns => {
            format!("write {whole}.{part} for {whole},{part}, or complete or shorten the row")
        }
        _ if words.len() > columns && row.contains(',') => {
            "write decimal points if commas are decimal; complete or shorten the row".to_owned()
        }
        _ => "complete or shorten the row".to_owned(),
    }
}

fn is_number(word: &str) -> bool {
    word.trim().parse::<f64>().is_ok()
}

/// Whether a line is a comment.
pub(super) fn is_comment(line: &str) -> bool {
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
        for (text, line) in [
            ("\"x,u\n1,2\n", 1),
            ("x,u\n1,\"2\n3,4\n", 2),
            ("x;u\n1; \"2\n\"3\";4\n", 2),
            ("x,u\n1,2\n3,\"4", 3),
            ("x,u\n1,\"a \"\" b\n", 2),
        ] {
            let expected = format!("`line {line}`: unclosed quote; close the quote, or remove it");
            assert_eq!(text_fault(text).expect(text).to_string(), expected);
        }
    }

    #[test]
    fn control_characters_are_named_by_their_number() {
        let fault = text_fault("x,u\r\n1\t,\u{1b}[2J2\n").expect("an escape").to_string();
        assert!(fault.starts_with("`line 2`: control character U+001B; "), "{fault}");
        assert!(text_fault("# source: a\u{202e}b\n").is_some());
        // two bytes a letter
        assert_eq!(text_fault("x\0,\0u\0\n\0").map(|fault| fault.field), Some("line 1".to_owned()));
    }

    #[test]
    fn other_separators_and_decimals_are_told() {
        for word in ["1;2", "1,5;2", "1 2"] {
            assert!(number_remedy(word).starts_with("use one separator for all columns"), "{word}");
        }
        assert_eq!(number_remedy("1,5"), "use a decimal point");
        assert_eq!(number_remedy("1,234.5"), "write numbers without separators of thousands");
        assert_eq!(number_remedy("-9999"), "leave out rows with missing values");
        assert_eq!(number_remedy("N/A"), "leave out rows with missing values");
        assert!(row_remedy("1,5,2,5", &["1", "5", "2", "5"], 2).starts_with("write 1.5 for 1,5, or"));
        assert!(row_remedy("1;2", &["1;2"], 2).starts_with("use one separator"));
        assert!(row_remedy("1,2,3", &["1", "2", "3"], 2).starts_with("write decimal points if commas are decimal"));
    }
}
