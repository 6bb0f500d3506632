//! The rate of an inlet, as a case file gives it.

use crate::case::ParameterError;
use bagnold_solver::weakly_compressible::enclosure::FeedRate;

/// A rate as a case file gives it: one for all times, or rows of time `[s]` and rate, which a file may hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenRate<'a> {
    /// One rate for all times; 0 where there is none.
    pub rate: f64,
    /// Rows of a table.
    pub rates: &'a [(f64, f64)],
    /// The file that the rows came from; empty without one.
    pub table: &'a str,
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
    /// Neither a rate nor rows, or both, rows that have not been read, and those that are no table.
    pub(super) fn checked(&self) -> Result<FeedRate, ParameterError> {
        let refused = |field: &str, value: String, rule: &str, remedy: &str| {
            Err(ParameterError::field(field, value, rule, remedy))
        };
        if !self.table.is_empty() && self.rates.is_empty() {
            let rule = "read with the case file that names it";
            return refused("table", format!("\"{}\"", self.table), rule, "name it in a case file, or give `rates`");
        }
        if self.rates.is_empty() {
            if self.rate == 0.0 {
                let remedy = "give `rate`, `rates` (rows of time and rate) or `table` (a CSV file)";
                return refused("rate", "missing, or 0".to_owned(), "", remedy);
            }
            return FeedRate::constant(self.rate).map_err(|_| {
                ParameterError::field("rate", self.rate, "positive", "what flows out leaves by an open side")
            });
        }
        if self.rate != 0.0 {
            return refused("rate", self.rate.to_string(), "absent beside a table", "give one of the two");
        }
        FeedRate::table(self.rates).map_err(|mut problem| {
            problem.field = format!("{}{}", self.field(), problem.field);
            problem.into()
        })
    }
}
