//! The rate of an inlet, as a case file gives it.

use crate::case::ParameterError;
use bagnold_number::four_digits;
use bagnold_solver::weakly_compressible::enclosure::FeedRate;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Rate of an inlet before the first and after the last row of its table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum TableEnds {
    /// The rate of that row.
    Hold,
    /// No inflow outside the table.
    Zero,
    /// An error: the table must begin at the time 0 and last as long as the run.
    Error,
}

/// A rate as a case file gives it: one for all times, or rows of time `[s]` and rate, which a file may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenRate<'a> {
    /// One rate for all times; 0 where there is none.
    pub rate: f64,
    /// Rows of a table.
    pub rates: &'a [(f64, f64)],
    /// The file that the rows came from; empty without one.
    pub table: &'a str,
    /// Rate beyond the rows; where it is absent, the first row must be that of the time 0, and the last goes on.
    pub ends: Option<TableEnds>,
}

impl GivenRate<'_> {
    /// The field that gives it.
    pub(super) fn field(&self) -> &'static str {
        match (self.rates, self.table) {
            ([], _) => "rate",
            (_, "") => "rates",
            _ => "table",
        }
    }

    /// The rate of the solver.
    ///
    /// # Errors
    /// Neither a rate nor rows, or both, rows that have not been read, those that are no table, and those that end within a run of a
    /// duration `[s]` where they must not.
    pub(super) fn checked(&self, duration: f64) -> Result<FeedRate, ParameterError> {
        let refused = |field: &str, value: String, rule: &str, remedy: &str| {
            Err(ParameterError::field(field, value, rule, remedy))
        };
        if !self.table.is_empty() && self.rates.is_empty() {
            let defect = format!("\"{}\" has not been read", self.table);
            return refused("table", defect, "", "name it in a case file, or give `rates`");
        }
        let (Some(first), Some(last)) = (self.rates.first(), self.rates.last()) else {
            if self.ends.is_some() {
                return refused("ends", "given without a table of rates".to_owned(), "", "leave it out");
            }
            if self.rate == 0.0 {
                let remedy = "give `rate`, `rates` (rows of time and rate) or `table` (a CSV file)";
                return refused("rate", "missing, or 0".to_owned(), "", remedy);
            }
            return FeedRate::constant(self.rate).map_err(|_| {
                ParameterError::field("rate", self.rate, "positive", "for outflow, open a side of the domain")
            });
        };
        if self.rate != 0.0 {
            return refused("rate", "given together with a table".to_owned(), "", "leave one of the two out");
        }
        let table = FeedRate::table(self.rates).map_err(|mut problem| {
            problem.field = format!("{}{}", self.field(), problem.field);
            problem
        })?;
        let remedy = "add a row, or give `ends = \"hold\"` or `ends = \"zero\"`";
        if first.0 > 0.0 && !matches!(self.ends, Some(TableEnds::Hold | TableEnds::Zero)) {
            let (field, value) = (format!("{}[0]", self.field()), format!("({}, {})", first.0, first.1));
            return refused(&field, value, "a row at 0 s", remedy);
        }
        if last.0 < duration && self.ends == Some(TableEnds::Error) {
            let defect = format!("the table ends at {} s, before the run at {duration} s", last.0);
            return refused(self.field(), defect, "", remedy);
        }
        Ok(if self.ends == Some(TableEnds::Zero) { table.closed_beyond() } else { table })
    }

    /// Words for the inflow of a named inlet beyond its rows, where a run of a duration `[s]` goes there; in the unit of rates.
    pub(super) fn beyond(&self, name: &str, duration: f64, unit: &str) -> String {
        let told = |(time, rate): &(f64, f64), when: &str| {
            let rate = if self.ends == Some(TableEnds::Zero) { 0.0 } else { *rate };
            format!("; inlet `{name}` feeds {} {unit} {when} {} s", four_digits(rate), four_digits(*time))
        };
        let before = self.rates.first().filter(|row| row.0 > 0.0).map(|row| told(row, "before"));
        let after = self.rates.last().filter(|row| row.0 < duration).map(|row| told(row, "after"));
        before.into_iter().chain(after).collect()
    }
}
