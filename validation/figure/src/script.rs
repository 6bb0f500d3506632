//! Indices and exponents in labels: u_* → u with an index, h_{stop}, r0 and (τ − 0.05)^1.5.

/// Size of a raised or lowered letter over that of its base `[-]`.
pub(super) const SMALLER: f64 = 0.72;

/// A part of a text on one line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Run<'t> {
    pub(super) text: &'t str,
    /// Height above the base line over the size of the base's letters `[-]`; 0 for the base itself.
    pub(super) rise: f64,
}

const LOWERED: f64 = -0.2;
const RAISED: f64 = 0.36;

/// The parts of a text, from left to right.
///
/// An index belongs to a single letter, so that a name such as `run_out` stays whole: `_` and what follows, or `0` and `∞`
/// straight after the letter. An exponent is a number after `^`.
pub(super) fn runs(text: &str) -> Vec<Run<'_>> {
    let mut runs = Vec::new();
    let mut rest = text;
    while let Some(Script { place, mark, length, rise }) = first(rest) {
        let end = place + mark + length;
        runs.push(Run { text: &rest[..place], rise: 0.0 });
        runs.push(Run { text: rest[place + mark..end].trim_matches(['{', '}']), rise });
        rest = &rest[end..];
    }
    runs.push(Run { text: rest, rise: 0.0 });
    runs.retain(|run| !run.text.is_empty());
    runs
}

/// Place of a raised or lowered part in a text, with the lengths of its mark and of itself in bytes.
struct Script {
    place: usize,
    mark: usize,
    length: usize,
    rise: f64,
}

fn first(text: &str) -> Option<Script> {
    let (mut base, mut before_base) = (' ', ' ');
    for (place, letter) in text.char_indices() {
        let is_symbol = base.is_alphabetic() && !is_of_name(before_base);
        let rest = &text[place + letter.len_utf8()..];
        let (mark, length, rise) = match letter {
            '_' if is_symbol => (1, index_length(rest), LOWERED),
            '0' | '∞' if is_symbol && !rest.starts_with(is_of_name) => (0, letter.len_utf8(), LOWERED),
            '^' => (1, rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len()), RAISED),
            _ => (0, 0, 0.0),
        };
        if length > 0 {
            return Some(Script { place, mark, length, rise });
        }
        (base, before_base) = (letter, base);
    }
    None
}

fn is_of_name(letter: char) -> bool {
    letter.is_alphanumeric() || letter == '_'
}

/// A star, a word or number, or what stands in braces.
fn index_length(text: &str) -> usize {
    match text.chars().next() {
        Some('*') => 1,
        Some('{') => text.find('}').map_or(0, |end| end + 1),
        _ => text.find(|c: char| !c.is_alphanumeric() && c != '∞').unwrap_or(text.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The runs with indices in brackets and exponents in angles.
    fn set(text: &str) -> String {
        let mark = |run: &Run<'_>| match run.rise {
            rise if rise < 0.0 => format!("[{}]", run.text),
            rise if rise > 0.0 => format!("<{}>", run.text),
            _ => run.text.to_owned(),
        };
        runs(text).iter().map(mark).collect()
    }

    #[test]
    fn symbols_have_indices_and_names_have_none() {
        for (text, expected) in [
            ("u_f/u_* ", "u[f]/u[*] "),
            ("run-out (r∞ − r0)/r0 ", "run-out (r[∞] − r[0])/r[0] "),
            ("t/√(h0/g)", "t/√(h[0]/g)"),
            ("h/h_stop(θ)", "h/h[stop](θ)"),
            ("tanθ = μ_s", "tanθ = μ[s]"),
            ("f_{x y} z", "f[x y] z"),
            ("3.97 (τ* − 0.0495)^1.5", "3.97 (τ* − 0.0495)<1.5>"),
            ("run_out at 0.05_r0, a10 20 x^y", "run_out at 0.05_r0, a10 20 x^y"),
        ] {
            assert_eq!(set(text), expected);
        }
    }
}
