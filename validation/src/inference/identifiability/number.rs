//! Numbers in sentences.

/// The value with a number of significant digits, without trailing zeros; powers of ten where it is very large or
/// small.
pub(super) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return value.to_string();
    }
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..6).contains(&exponent) {
        let decimals = usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0);
        return trimmed(&format!("{value:.decimals$}")).to_owned();
    }
    format!("{}e{exponent}", trimmed(mantissa))
}

/// Without zeros that end a fraction.
fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let text = |value| significant(value, 3);
        assert_eq!([text(0.7), text(2.0), text(0.123_456), text(1234.5)], ["0.7", "2", "0.123", "1234"]);
        assert_eq!([text(1.5e-7), text(-3.0e8), text(0.0), text(999.6)], ["1.5e-7", "-3e8", "0", "1000"]);
    }
}
