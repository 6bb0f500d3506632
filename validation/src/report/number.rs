//! Numbers as a reader wants them: four significant digits, powers of ten only where they help.

use crate::figure::superscript;

/// `value` with four significant digits, shorter where it is exact, such as `0.7`, `12.35` or `1.235×10⁻⁵`.
#[must_use]
pub fn four_digits(value: f64) -> String {
    significant(value, 4)
}

/// `value` with two significant digits, for changes and margins.
#[must_use]
pub fn two_digits(value: f64) -> String {
    significant(value, 2)
}

/// A value with its unit: `0.56 %`, `0.1 m/s`; the unit `-` is not written.
#[must_use]
pub fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "" | "-" => four_digits(value),
        _ => format!("{}\u{202f}{unit}", four_digits(value)),
    }
}

/// A count in groups of three digits.
#[must_use]
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

fn significant(value: f64, digits: usize) -> String {
    if value.is_nan() {
        return "not a number".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "−∞" }.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // The standard formatter rounds; the exponent is read afterwards because 9.9999 becomes 1.000e1.
    let scientific = format!("{:.*e}", digits.saturating_sub(1), value.abs());
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-3..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        shortest_if_exact(&format!("{:.decimals$}", value.abs()), value.abs())
    } else {
        format!("{}×10{}", shortest_if_exact(mantissa, value.abs() / 10f64.powi(exponent)), superscript(exponent))
    };
    if value < 0.0 { format!("−{text}") } else { text }
}

/// Drops trailing zeros, but only of a number that was exact: `0.5` is a limit, `0.5000` a measurement.
fn shortest_if_exact(text: &str, exact: f64) -> String {
    let is_exact = text.parse::<f64>().is_ok_and(|read| (read - exact).abs() <= 1e-12 * exact.abs());
    if is_exact && text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
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
            (f64::NAN, "not a number"),
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
}
