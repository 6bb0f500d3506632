//! Mass per time that an inlet feeds, and its integral: a table that is linear between its rows.

use crate::parameter::ParameterProblem;

/// A rate over time: linear between the rows of a table, of which two may have one time; before the first and after the last it is
/// constant, or none.
#[derive(Debug, Clone, PartialEq)]
pub struct FeedRate {
    times: Vec<f64>,
    rates: Vec<f64>,
    /// Integral from the first time to each of them `[kg]`.
    masses: Vec<f64>,
    /// The first and the last rate go on beyond the table.
    is_held: bool,
}

impl FeedRate {
    /// One rate for all times `[kg/s]`, in the plane `[kg/(m s)]`.
    ///
    /// # Errors
    /// A rate that is negative or not finite.
    pub fn constant(rate: f64) -> Result<Self, ParameterProblem> {
        Self::table(&[(0.0, rate)])
    }

    /// Nothing at any time.
    #[must_use]
    pub fn closed() -> Self {
        Self { times: vec![0.0], rates: vec![0.0], masses: vec![0.0], is_held: true }
    }

    /// Rows of a time `[s]` and a rate `[kg/s]`, in the plane `[kg/(m s)]`; two of one time are a jump.
    ///
    /// # Errors
    /// A table that is empty or begins before 0, times that fall or stand three times, rates that are negative or not finite: the
    /// field is the row, `[2]` for the third.
    pub fn table(rows: &[(f64, f64)]) -> Result<Self, ParameterProblem> {
        let refused = |row: usize, rule: &str, remedy: &str| {
            let value = rows.get(row).map_or_else(|| "absent".to_owned(), |(time, rate)| format!("({time}, {rate})"));
            Err(ParameterProblem::new(&format!("[{row}]"), value, rule, remedy))
        };
        if rows.first().is_none_or(|(time, _)| *time < 0.0) {
            return refused(0, "a rate at 0 s or later", "begin with the rate at 0 s");
        }
        for (row, (time, rate)) in rows.iter().enumerate() {
            if !(*rate >= 0.0 && rate.is_finite()) {
                return refused(
                    row,
                    "a time with a rate of 0 or more",
                    "give a positive rate; for outflow, open a side of the domain",
                );
            }
            if !time.is_finite() || row > 0 && *time < rows[row - 1].0 {
                let rule = format!("at {} s or later, the time of the row above", rows[row.max(1) - 1].0);
                return refused(row, &rule, "sort the rows by their times");
            }
            if row > 1 && *time == rows[row - 2].0 {
                let remedy = "keep two rows at this time, with the rates before and after the jump";
                return Err(ParameterProblem::new(&format!("[{row}]"), format!("third row at {time} s"), "", remedy));
            }
        }
        let (times, rates): (Vec<f64>, Vec<f64>) = rows.iter().copied().unzip();
        let mut masses = vec![0.0];
        for row in 1..times.len() {
            let mean = 0.5 * (rates[row] + rates[row - 1]);
            masses.push(masses[row - 1] + mean * (times[row] - times[row - 1]));
        }
        Ok(Self { times, rates, masses, is_held: true })
    }

    /// The same without anything before the first and after the last row.
    #[must_use]
    pub fn closed_beyond(self) -> Self {
        Self { is_held: false, ..self }
    }

    /// First and last time of the table `[s]`.
    fn ends(&self) -> (f64, f64) {
        (self.times[0], self.times[self.times.len() - 1])
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
        let (first, last) = self.ends();
        if !self.is_held && (time < first || time >= last) {
            return 0.0;
        }
        let (row, time) = (self.row(time), time.max(first));
        self.rates[row] + self.slope(row) * (time - self.times[row])
    }

    /// Integral from time 0 on `[kg]`, without an error that grows.
    #[must_use]
    pub fn mass(&self, time: f64) -> f64 {
        let (first, last) = self.ends();
        let inside = if self.is_held { time.max(first) } else { time.clamp(first, last) };
        let before = if self.is_held { self.rates[0] * time.min(first) } else { 0.0 };
        let row = self.row(inside);
        let elapsed = inside - self.times[row];
        before + self.masses[row] + (self.rates[row] + 0.5 * self.slope(row) * elapsed) * elapsed
    }

    /// The largest rate of all times `[kg/s]`.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.rates.iter().fold(0.0, |most, &rate| most.max(rate))
    }

    /// Whether nothing is fed after a time `[s]`.
    #[must_use]
    pub fn is_over(&self, time: f64) -> bool {
        let is_beyond = !self.is_held && time >= self.ends().1;
        is_beyond || self.at(time) == 0.0 && self.rates[self.row(time)..].iter().skip(1).all(|&rate| rate == 0.0)
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
    fn a_jump_is_two_rows_of_one_time_and_a_table_ends_in_its_last_rate_or_in_none() {
        let held = FeedRate::table(&[(1.0, 2.0), (2.0, 2.0), (2.0, 6.0), (4.0, 6.0)]).expect("a table");
        let closed = held.clone().closed_beyond();
        for (time, rates, masses) in [
            (0.5, [2.0, 0.0], [1.0, 0.0]),
            (1.5, [2.0, 2.0], [3.0, 1.0]),
            (2.0, [6.0, 6.0], [4.0, 2.0]),
            (3.0, [6.0, 6.0], [10.0, 8.0]),
            (4.0, [6.0, 0.0], [16.0, 14.0]),
            (5.0, [6.0, 0.0], [22.0, 14.0]),
        ] {
            assert_eq!([held.at(time), closed.at(time)], rates, "{time}");
            assert_eq!([held.mass(time), closed.mass(time)], masses, "{time}");
        }
        assert!(!held.is_over(5.0) && closed.is_over(4.0) && !closed.is_over(3.0) && !closed.is_over(0.5));
    }

    #[test]
    fn tables_rise_and_are_not_negative() {
        let refused = |rows: &[(f64, f64)]| FeedRate::table(rows).expect_err("refused").to_string();
        assert!(refused(&[]).starts_with("`[0]` is absent, but must be a rate at 0 s or later"));
        assert!(refused(&[(-0.5, 1.0)]).starts_with("`[0]` is (-0.5, 1)"));
        assert!(
            refused(&[(0.0, 1.0), (1.0, 2.0), (0.5, 2.0)])
                .contains("must be at 1 s or later, the time of the row above")
        );
        assert!(refused(&[(0.0, 1.0); 3]).starts_with("`[2]`: third row at 0 s; keep two rows at this time"));
        assert!(refused(&[(0.0, 1.0), (1.0, -2.0)]).starts_with("`[1]` is (1, -2)"));
        assert!(FeedRate::constant(f64::NAN).is_err() && FeedRate::constant(-1.0).is_err());
    }
}
