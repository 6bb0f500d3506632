//! Names that a user gives, and names that he may have meant, in the words of an error.

use super::escape::is_control;
use super::field::FieldError;
use super::unit;

/// Longest name `[characters]`: files, columns and legends are named after it, and no file system takes more than 255 bytes.
pub(crate) const LONGEST_NAME: usize = 100;

/// Refuses a name that is empty, too long, or holds characters that control a terminal.
///
/// # Errors
/// The field that holds the name.
pub fn check_name(field: &str, name: &str) -> Result<(), FieldError> {
    let refused = |rule: &str, remedy: &str| Err(FieldError::new(field, format!("\"{name}\""), rule, remedy));
    let length = name.chars().count();
    if name.trim().is_empty() {
        return refused("a name of one letter or more", "give a name");
    }
    if length > LONGEST_NAME {
        let defect = format!("a name of {length} characters, above the limit of {LONGEST_NAME}");
        return Err(FieldError::finding(field, defect, "shorten it: files, columns and legends carry it"));
    }
    check_text(field, name)
}

/// Refuses a text with characters that control a terminal, which no picture and no page could show either.
///
/// # Errors
/// The field that holds the text.
pub fn check_text(field: &str, text: &str) -> Result<(), FieldError> {
    if text.chars().any(is_control) {
        let rule = "without control characters";
        let remedy = "remove them: a terminal would interpret them";
        return Err(FieldError::new(field, format!("\"{text}\""), rule, remedy));
    }
    Ok(())
}

/// Name and unit of a heading or label such as `y [m]`; none without a unit.
pub fn name_and_unit(text: &str) -> Option<(&str, &str)> {
    let (name, unit) = text.trim().strip_suffix(']')?.rsplit_once('[')?;
    Some((name.trim(), unit.trim()))
}

/// Name and unit of a heading or label; `-` where there is no unit.
pub fn parted(text: &str) -> (&str, &str) {
    name_and_unit(text).unwrap_or((text.trim(), "-"))
}

/// Words of a heading of standard uncertainties.
const UNCERTAINTY: [&str; 5] = ["uncertainty", "sigma", "σ", "std", "stdev"];

/// Whether a column of this name holds standard uncertainties.
pub fn is_uncertainty(name: &str) -> bool {
    let name = name.to_lowercase();
    name.split(|letter: char| !letter.is_alphanumeric()).any(|word| UNCERTAINTY.contains(&word))
}

/// Name of what was measured, without the number of a repeat: `front #2`.
pub fn unnumbered(name: &str) -> &str {
    let before = name.rsplit_once('#').filter(|(_, number)| number.parse::<u32>().is_ok());
    before.map_or(name, |(name, _)| name.trim_end())
}

/// Equality of two headings by name and by unit, however that is spelt.
pub fn is_same_heading(one: &str, other: &str) -> bool {
    let of_one_unit = |((name, unit), (other, of))| name == other && unit::factor(unit, of) == Some(1.0);
    one == other || name_and_unit(one).zip(name_and_unit(other)).is_some_and(of_one_unit)
}

/// The name that is most like `name`, if any is like it at all or has it for one of its words.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    // Jaro–Winkler forgives a wrong tail and swapped letters; below this a suggestion would be a guess.
    const LEAST: f64 = 0.85;
    let table = name.rfind('.').map_or("", |dot| &name[..=dot]);
    let likeness = |candidate: &str| {
        // names of one table are told by what follows
        let rest = candidate.strip_prefix(table);
        let (name, candidate) = rest.map_or((name, candidate), |rest| (&name[table.len()..], rest));
        let is_word = candidate.split(['_', '-', '.']).any(|word| word == name);
        strsim::jaro_winkler(name, candidate).max(if is_word { LEAST } else { 0.0 })
    };
    known
        .into_iter()
        .map(|candidate| (likeness(candidate), candidate))
        .filter(|(likeness, _)| *likeness >= LEAST)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate.to_owned())
}

/// The question that goes with a suggestion, or nothing.
pub fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |name| format!("did you mean `{name}`? "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_of_a_name_suggests_it() {
        let known = ["incline-collapse", "slope_angle", "film"];
        assert_eq!(nearest("collapse", known), Some("incline-collapse".to_owned()));
        assert_eq!(nearest("angle", known), Some("slope_angle".to_owned()));
        assert_eq!(nearest("zzz", known), None);
    }

    #[test]
    fn a_unit_may_be_spelt_in_two_ways() {
        assert!(is_same_heading("q [kg/(s m)]", "q [kg/(m s)]") && is_same_heading("q [furlong]", "q [furlong]"));
        assert!(!is_same_heading("q [kg/m]", "q [g/m]") && !is_same_heading("q [m]", "p [m]"));
    }

    #[test]
    fn a_name_is_short_and_can_be_printed() {
        for name in ["a", "sand 2 mm", "Größe/µ", &"ä".repeat(LONGEST_NAME)] {
            assert_eq!(check_name("name", name), Ok(()));
        }
        let message = |name: &str| check_name("name", name).expect_err("refused").to_string();
        assert_eq!(message(" "), "`name` is \" \", but must be a name of one letter or more; give a name");
        assert!(message(&"a".repeat(5000)).contains("a name of 5000 characters, above the limit of 100; shorten it"));
        for letter in ['\0', '\u{1b}', '\u{7f}', '\u{9b}', '\u{202e}', '\u{2066}', '\u{200f}', '\n'] {
            let message = message(&format!("a{letter}b"));
            assert!(message.contains("without control characters") && !message.contains(letter), "{message}");
        }
    }
}
