//! Limits of gates beside the scatter of codes of one law.

use super::League;
use crate::metric::Limit;
use crate::number::{four_digits, two_digits};

/// Headings of [`widths`].
pub const HEADINGS: [&str; 8] =
    ["case", "metric", "run", "limit", "width of the limit", "standard deviation", "width over deviation", "reason"];
/// Width over standard deviation from which a limit is wide `[-]`.
const WIDE: f64 = 2.0;

/// A row for each gated quantity of at least three codes of one law. The width is half that of an interval, and for a bound its
/// distance from the mean of the codes. The reason of the gate stands beside a width that is not one to two deviations.
pub fn widths(league: &League) -> Vec<[String; 8]> {
    let row = |row: &super::LeagueRow| {
        let (gate, (mean, deviation)) = (row.own.gate.as_ref()?, row.of_one_law()?);
        let width = match gate.limit {
            Limit::Within(lower, upper) => 0.5 * (upper - lower),
            Limit::AtMost(bound) | Limit::AtLeast(bound) => (bound - mean).abs(),
        };
        let ratio = width / deviation;
        let reason = match ratio {
            ..1.0 => format!("narrow: {}", gate.reason),
            WIDE.. => format!("wide: {}", gate.reason),
            _ => String::new(),
        };
        Some([
            row.case.clone(),
            format!("{} [{}]", row.own.name, row.own.unit),
            row.variant().to_string(),
            gate.limit.in_words(four_digits),
            two_digits(width),
            two_digits(deviation),
            two_digits(ratio),
            reason,
        ])
    };
    league.rows.iter().filter_map(row).collect()
}
