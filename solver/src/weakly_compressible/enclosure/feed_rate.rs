//! Mass per time that an inlet feeds, and its integral: a table that is linear between its rows.

use crate::parameter::ParameterProblem;

/// A rate over time: linear between the rows of a table, and constant before its first and behind its last.
#[derive(Debug, Clone, PartialEq)]
pub struct FeedRate {
    times: Vec<f64>,
    rates: Vec<f64>,
    /// Integral from time 0 to each of the times `[kg]`.
    masses: Vec<f64>,
}

impl FeedRate {
    /// One rate for all times `[kg/s]`, in the plane `[kg/(s m)]`.
    ///
    /// # Errors
    /// A rate that is negative or not finite.
    pub fn constant(rate: f64) -> Result<Self, ParameterProblem> {
        Self::table(&[(0.0, rate)])
    }

    /// Nothing at any time.
    #[must_use]
    pub fn closed() -> Self {
        Self { times: vec![0.0], rates: vec![0.0], masses: vec![0.0] }
    }

    /// Rows of a time `[s]` and a rate `[kg/s]`, in the plane `[kg/(s m)]`; the first is that of time 0.
    ///
    /// # Errors
    /// A table that is empty or does not begin at 0, times that do not rise, rates that are negative or not finite: the field
    /// is the row, `[2]` for the third.
    pub fn table(rows: &[(f64, f64)]) -> Result<Self, ParameterProblem> {
        let refused = |row: usize, rule: &str, remedy: &str| {
            let value = rows.get(row).map_or_else(|| "absent".to_owned(), |(time, rate)| format!("({time}, {rate})"));
            Err(ParameterProblem::new(&format!("[{row}]"), value, rule, remedy))
        };
        if rows.first().is_none_or(|(time, _)| *time != 0.0) {
            return refused(0, "a row for the time 0", "say at which rate the run begins; 0 is none");
        }
        for (row, (time, rate)) in rows.iter().enumerate() {
            if !(*rate >= 0.0 && rate.is_finite()) {
                return refused(
                    row,
                    "a time with a rate that is not negative",
                    "what flows out leaves by an open side",
                );
            }
            if !time.is_finite() || row > 0 && *time <= rows[row - 1].0 {
                let rule = format!("later than the row before it, {} s", rows[row.max(1) - 1].0);
                return refused(row, &rule, "sort the rows by their times");
            }
        }
        let (times, rates): (Vec<f64>, Vec<f64>) = rows.iter().copied().unzip();
        let mut masses = vec![0.0];
        for row in 1..times.len() {
            let mean = 0.5 * (rates[row] + rates[row - 1]);
            masses.push(masses[row - 1] + mean * (times[row] - times[row - 1]));
        }
        Ok(Self { times, rates, masses })
    }

    /// The last row at or before a time.
    fn row(&self, time: f64) -> usize {
        self.times.partition_point(|&t| t <= time).max(1) - 1
    }

    /// Change of the rate per time behind a row `[kg/s²]`.
    fn slope(&self, row: usize) -> f64 {
        match (self.times.get(row + 1), self.rates.get(row + 1)) {
            (Some(time), Some(rate)) => (rate - self.rates[row]) / (time - self.times[row]),
            _ => 0.0,
        }
    }

    /// The rate at a time `[kg/s]`.
    #[must_use]
    pub fn at(&self, time: f64) -> f64 {
        let row = self.row(time);
        self.rates[row] + self.slope(row) * (time - self.times[row])
    }

    /// Its integral from time 0 on `[kg]`, without an error that grows.
    #[must_use]
    pub fn mass(&self, time: f64) -> f64 {
        let row = self.row(time);
        let elapsed = time - self.times[row];
        self.masses[row] + (self.rates[row] + 0.5 * self.slope(row) * elapsed) * elapsed
    }

    /// The largest rate of all times `[kg/s]`.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.rates.iter().fold(0.0, |most, &rate| most.max(rate))
    }

    /// Whether nothing is fed after a time `[s]`.
    #[must_use]
    pub fn is_over(&self, time: f64) -> bool {
        self.at(time) == 0.0 && self.rates[self.row(time)..].iter().skip(1).all(|&rate| rate == 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_is_that_of_a_line_between_the_rows() {
        let rate = FeedRate::table(&[(0.0, 2.0), (1.0, 4.0), (3.0, 0.0), (4.0, 0.0)]).expect("a table");
        for (time, now, mass) in
            [(0.0, 2.0, 0.0), (0.5, 3.0, 1.25), (1.0, 4.0, 3.0), (2.0, 2.0, 6.0), (3.5, 0.0, 7.0), (9.0, 0.0, 7.0)]
        {
            assert!((rate.at(time) - now).abs() < 1e-14 && (rate.mass(time) - mass).abs() < 1e-14, "{time}");
        }
        assert!(rate.largest() == 4.0 && rate.is_over(3.0) && !rate.is_over(2.9));
        let constant = FeedRate::constant(0.5).expect("a rate");
        assert!(constant.mass(8.0) == 4.0 && !constant.is_over(8.0) && FeedRate::closed().is_over(0.0));
    }

    #[test]
    fn tables_begin_at_zero_rise_and_are_not_negative() {
        let refused = |rows: &[(f64, f64)]| FeedRate::table(rows).expect_err("refused").to_string();
        assert!(refused(&[]).starts_with("`[0]` is absent, but must be a row for the time 0"));
        assert!(refused(&[(0.5, 1.0)]).starts_with("`[0]` is (0.5, 1)"));
        assert!(refused(&[(0.0, 1.0), (0.0, 2.0)]).contains("must be later than the row before it, 0 s"));
        assert!(refused(&[(0.0, 1.0), (1.0, -2.0)]).starts_with("`[1]` is (1, -2)"));
        assert!(FeedRate::constant(f64::NAN).is_err() && FeedRate::constant(-1.0).is_err());
    }
}
