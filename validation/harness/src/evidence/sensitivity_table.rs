//! Results of a case at both ends of the ranges of its inputs, `validation/harness/sensitivities/CASE.csv`, which `bagnold-dev sensitivities CASE`
//! computes.

use super::shipped::carried;
use crate::metric::Variant;
use crate::output::csv_text;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::LazyLock;

include!(concat!(env!("OUT_DIR"), "/sensitivities.rs"));

/// Position of an input in its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RangeEnd {
    /// The case's own value.
    Own,
    /// The lower end.
    Low,
    /// The upper end.
    High,
    /// A finer spacing.
    Refined,
}

/// A comparison with an input at an end of its range.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SensitivityRow {
    /// Name of the range; empty where all inputs have their own values.
    pub input: String,
    /// Position of the input in its range.
    pub end: RangeEnd,
    /// Number of the repetition with another seed, from 0 `[-]`.
    pub repeat: usize,
    /// Name of the metric.
    pub quantity: String,
    /// Variant with all inputs at their own values.
    pub variant: Variant,
    /// Value there, in the metric's unit.
    pub value: f64,
    /// The reference's value there, which may depend on inputs as well, in the metric's unit.
    pub reference: f64,
}

/// All tables by case.
static TABLES: LazyLock<BTreeMap<&'static str, Vec<SensitivityRow>>> = LazyLock::new(|| carried(&FILES, ".csv", rows));

fn rows(text: &str) -> Result<Vec<SensitivityRow>, csv::Error> {
    csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes()).deserialize().collect()
}

/// The table of a case; empty where there is none.
///
/// # Panics
/// If the table that the program carries is malformed, which a test would find.
pub fn sensitivity_table(case: &str) -> &'static [SensitivityRow] {
    TABLES.get(case).map_or(&[], Vec::as_slice)
}

/// The text of a table, with the command that makes it.
///
/// # Errors
/// If a row cannot be written.
pub fn sensitivity_text(case: &str, rows: &[SensitivityRow]) -> Result<String, csv::Error> {
    let head = format!(
        "# Comparisons of {case} with each input at both ends of its range (reference-data/{case}/uncertainty.toml), quick tier.\n\
         # cargo run -p bagnold-dev -- sensitivities {case} --out validation/harness/sensitivities/{case}.csv\n"
    );
    Ok(head + &csv_text(rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::StatedUncertainty;

    #[test]
    fn a_table_is_read_as_it_was_written() {
        let row = SensitivityRow {
            input: "friction".to_owned(),
            end: RangeEnd::Low,
            repeat: 1,
            quantity: "run_out".to_owned(),
            variant: "material=sand,aspect_ratio=0.7".parse().expect("a variant"),
            value: 0.1 + 0.2,
            reference: 0.84,
        };
        let text = sensitivity_text("column-planar", std::slice::from_ref(&row)).expect("writable");
        assert_eq!(rows(&text).expect("readable"), [row]);
    }

    #[test]
    fn every_range_has_its_runs_and_every_run_its_range() {
        for (case, rows) in TABLES.iter() {
            let stated = StatedUncertainty::of(case).unwrap_or_else(|| panic!("{case} states no ranges"));
            let mut named: Vec<(&str, RangeEnd)> = rows.iter().map(|row| (row.input.as_str(), row.end)).collect();
            named.sort_unstable();
            named.dedup();
            let ranges = stated
                .ranges
                .iter()
                .flat_map(|range| [(range.name.as_str(), RangeEnd::Low), (range.name.as_str(), RangeEnd::High)]);
            let spacings = stated.spacings.iter().map(|spacing| (spacing.name.as_str(), RangeEnd::Refined));
            let mut expected: Vec<(&str, RangeEnd)> = ranges.chain(spacings).chain([("", RangeEnd::Own)]).collect();
            expected.sort_unstable();
            assert_eq!(named, expected, "{case}: run `cargo run -p bagnold-dev -- sensitivities {case}` again");
        }
    }
}
