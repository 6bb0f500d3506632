//! Numbers as a reader wants them: a few significant digits, powers of ten only where they help; one rounding for
//! pages, terminals and sentences.

/// `value` with four significant digits, shorter where it is exact, such as `0.7`, `12.35` or `1.235×10⁻⁵`.
pub fn four_digits(value: f64) -> String {
    significant(value, 4, &TYPESET)
}

/// `value` with two significant digits, for changes and margins.
pub fn two_digits(value: f64) -> String {
    significant(value, 2, &TYPESET)
}

/// Two values with as many significant digits, four at least, as show their difference to a tenth of it; equal ones have four.
pub fn distinct_digits(value: f64, other: f64) -> (String, String) {
    const FEWEST: usize = 4;
    // more do not tell two numbers of double precision apart
    const MOST: usize = 17;
    let rounded = |number: f64, digits: usize| format!("{number:.*e}", digits - 1).parse::<f64>().unwrap_or(number);
    let difference = value - other;
    let shows = |digits: &usize| {
        let shown = rounded(value, *digits) - rounded(other, *digits);
        (shown - difference).abs() <= 0.1 * difference.abs()
    };
    let digits = if difference.is_finite() { (FEWEST..MOST).find(shows).unwrap_or(MOST) } else { FEWEST };
    (significant(value, digits, &TYPESET), significant(other, digits, &TYPESET))
}

/// A value with its unit: `0.56 %`, `0.1 m/s`; the unit `-` is not written.
pub fn with_unit(value: f64, unit: &str) -> String {
    in_unit(&four_digits(value), unit)
}

/// Digits with their unit; the unit `-`, and that of a missing value, are not written.
pub fn in_unit(digits: &str, unit: &str) -> String {
    let is_bare = matches!(unit, "" | "-") || digits == "no value";
    if is_bare { digits.to_owned() } else { format!("{digits}\u{202f}{unit}") }
}

/// A count in groups of three digits.
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3 * 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// Digits of a terminal's column: zeros are kept and exponents written as `1.000e-9`, so that numbers line up.
pub fn aligned_digits(value: f64) -> String {
    significant(value, 4, &Style { plain: -3..5, zeros: Zeros::Kept, typeset: false })
}

/// Digits of a sentence: no zeros at the end, exponents written as `1.5e-7`.
pub fn short_digits(value: f64, digits: usize) -> String {
    significant(value, digits, &Style { plain: -4..6, zeros: Zeros::Dropped, typeset: false })
}

/// An integer in superscript digits.
pub fn superscript(number: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    number
        .to_string()
        .chars()
        .map(|character| character.to_digit(10).map_or('⁻', |digit| DIGITS[digit as usize]))
        .collect()
}

/// Format of a number's digits.
struct Style {
    /// Powers of ten that are written out.
    plain: std::ops::Range<i32>,
    zeros: Zeros,
    /// Signs and exponents as in print, for pages.
    typeset: bool,
}

/// Treatment of zeros that end a fraction.
enum Zeros {
    Kept,
    Dropped,
    /// Dropped of a number that was exact: `0.5` is a limit, `0.5000` a measurement.
    DroppedIfExact,
}

/// The page's style.
const TYPESET: Style = Style { plain: -3..6, zeros: Zeros::DroppedIfExact, typeset: true };

fn significant(value: f64, digits: usize, style: &Style) -> String {
    if !value.is_finite() {
        return match value {
            _ if !style.typeset => value.to_string(),
            value if value.is_nan() => "no value".to_owned(),
            value if value > 0.0 => "∞".to_owned(),
            _ => "−∞".to_owned(),
        };
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = value.abs();
    // The standard formatter rounds; the exponent is read afterwards because 9.9999 becomes 1.000e1.
    let scientific = format!("{size:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if style.plain.contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        style.zeros.of(&format!("{size:.decimals$}"), size)
    } else {
        let mantissa = style.zeros.of(mantissa, size / 10f64.powi(exponent));
        if style.typeset {
            format!("{mantissa}×10{}", superscript(exponent))
        } else {
            format!("{mantissa}e{exponent}")
        }
    };
    match (value < 0.0, style.typeset) {
        (false, _) => text,
        (true, true) => format!("−{text}"),
        (true, false) => format!("-{text}"),
    }
}

impl Zeros {
    /// The text of the `exact` number with the zeros that it keeps.
    fn of(&self, text: &str, exact: f64) -> String {
        let is_exact = || text.parse::<f64>().is_ok_and(|read| (read - exact).abs() <= 1e-12 * exact.abs());
        let drops = match self {
            Self::Kept => false,
            Self::Dropped => true,
            Self::DroppedIfExact => is_exact(),
        };
        if drops && text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text.to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        for (value, text) in [
            (0.0, "0"),
            (0.7, "0.7"),
            (0.1 + 0.2, "0.3"),
            (0.500_03, "0.5000"),
            (0.005_612_34, "0.005612"),
            (0.000_056_123, "5.612×10⁻⁵"),
            (-12.3456, "−12.35"),
            (9.999_96, "10.00"),
            (12_345.6, "12346"),
            (1_234_567.0, "1.235×10⁶"),
            (1e-4, "1×10⁻⁴"),
            (2e9, "2×10⁹"),
            (f64::NAN, "no value"),
            (f64::NEG_INFINITY, "−∞"),
        ] {
            assert_eq!(four_digits(value), text, "{value:e}");
        }
        assert_eq!(two_digits(0.012_34), "0.012");
        assert_eq!(with_unit(0.56, "%"), "0.56\u{202f}%");
        assert_eq!(with_unit(0.56, "-"), "0.56");
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(count(999), "999");
    }

    #[test]
    fn two_values_have_the_digits_that_show_their_difference() {
        for (value, other, texts) in [
            (10.2, 10.0, ("10.2", "10")),
            (0.123_449, 0.123_451, ("0.123449", "0.123451")),
            (1.234_561e-7, 1.234_562e-7, ("1.234561×10⁻⁷", "1.234562×10⁻⁷")),
            // four digits differ, but by a whole last digit in place of a tenth of it
            (1.000_51, 1.000_49, ("1.00051", "1.00049")),
            (-3.0, 3.0, ("−3", "3")),
            (0.0, 1e-12, ("0", "1×10⁻¹²")),
            (0.123_456_7, 0.123_456_7, ("0.1235", "0.1235")),
            (f64::NAN, 1.0, ("no value", "1")),
            (f64::INFINITY, f64::INFINITY, ("∞", "∞")),
        ] {
            assert_eq!(distinct_digits(value, other), (texts.0.to_owned(), texts.1.to_owned()), "{value:e}, {other:e}");
        }
        // neighbours in double precision
        let (value, other) = distinct_digits(1.0, 1.0 + f64::EPSILON);
        assert_ne!(value, other);
    }

    #[test]
    fn columns_of_a_terminal_keep_their_zeros() {
        for (value, text) in [
            (0.0, "0"),
            (0.012_345, "0.01235"),
            (-1.0, "-1.000"),
            (9.999_96, "10.00"),
            (98_765.4, "98765"),
            (1e-9, "1.000e-9"),
            (1_234_567.0, "1.235e6"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(aligned_digits(value), text);
        }
    }

    #[test]
    fn numbers_in_sentences_are_short() {
        let text = |value| short_digits(value, 3);
        assert_eq!([text(0.7), text(2.0), text(0.123_456), text(1234.5)], ["0.7", "2", "0.123", "1234"]);
        assert_eq!([text(1.5e-7), text(-3.0e8), text(0.0), text(999.6)], ["1.5e-7", "-3e8", "0", "1000"]);
    }
}
