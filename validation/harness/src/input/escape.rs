//! Characters that control a terminal, written so that they are seen instead.
//!
//! A message may quote what stands in a file. Control characters in it would move the cursor or change colours, and
//! characters that change the direction of writing would show a name other than the one that is there.

use std::borrow::Cow;
use std::path::Path;

/// Whether a terminal obeys a character instead of showing it: control characters, marks and overrides of the direction of
/// writing, separators of lines and paragraphs.
pub fn is_control(letter: char) -> bool {
    let changes_direction =
        matches!(letter, '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    letter.is_control() || changes_direction || matches!(letter, '\u{2028}' | '\u{2029}')
}

/// The text with such characters as in a Rust literal: `\u{1b}`, `\n`.
pub fn escaped(text: &str) -> Cow<'_, str> {
    escaped_where(text, is_control)
}

/// The same for a text of several lines, which stay lines; tabs stay as well.
pub fn escaped_lines(text: &str) -> Cow<'_, str> {
    escaped_where(text, |letter| is_control(letter) && !matches!(letter, '\n' | '\t'))
}

/// A path as a message shows it.
pub fn shown(path: &Path) -> String {
    escaped(&path.display().to_string()).into_owned()
}

fn escaped_where(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_escaped) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for letter in text.chars() {
        if is_escaped(letter) {
            shown.extend(letter.escape_debug());
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped_and_other_text_stays() {
        for plain in ["", "a b-c_1", "μ(I) 20 … 25°, Größe 砂", "it's \"quoted\" \\"] {
            assert_eq!(escaped(plain), plain);
        }
        assert_eq!(escaped("a\u{1b}[31mb\u{0}\r\u{7f}\u{9b}"), r"a\u{1b}[31mb\0\r\u{7f}\u{9b}");
        assert_eq!(escaped("gnp\u{202e}.exe\u{2066}\u{200f}"), r"gnp\u{202e}.exe\u{2066}\u{200f}");
        assert_eq!(escaped("a\nb\tc\u{2028}"), r"a\nb\tc\u{2028}");
        assert_eq!(shown(Path::new("a\nb")), r"a\nb");
        assert_eq!(escaped_lines("a\nb\tc\u{1b}"), "a\nb\tc\\u{1b}");
    }
}
