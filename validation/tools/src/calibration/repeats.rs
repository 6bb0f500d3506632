//! Runs that scatter: every evaluation is repeated with several seeds; the mean counts, and its variance enters χ².
//!
//! The variance of a prediction's mean is that over the seeds, divided by their number. Of three seeds it is itself hardly
//! known, so it is not taken point by point, where a search would be drawn to points at which it happens to be large: the
//! first search uses the mean over all data at the start, the second the mean over all points about the region, datum by
//! datum. Between the two nothing is simulated twice.

use super::objective::{Objective, Question};
use super::target::Datum;
use crate::ToolError;
use crate::inference::Answer;

/// Points about the minimum whose scatter is averaged: those whose χ² rises by no more than this many times the threshold.
const ABOUT: f64 = 25.0;

impl Objective<'_> {
    /// Variance of every fitted prediction's mean over that of its datum `[-]`, averaged over points of physical values at
    /// which all runs succeed; zeros without repeats.
    fn variances(&self, points: &[Vec<f64>]) -> Result<Vec<f64>, ToolError> {
        let count = self.plan.repeats.count;
        let data: Vec<_> = self.data_of(false).collect();
        let (mut sums, mut used) = (vec![0.0; data.len()], 0.0);
        for values in points.iter().filter(|_| count > 1) {
            let Some(residuals) = self.of_every_seed(values)? else { continue };
            used += 1.0;
            for (k, sum) in sums.iter_mut().enumerate() {
                let mean = residuals.iter().map(|list| list[k]).sum::<f64>() / count as f64;
                let squares: f64 = residuals.iter().map(|list| (list[k] - mean) * (list[k] - mean)).sum();
                *sum += squares / (count - 1) as f64 / count as f64;
            }
        }
        Ok(sums.into_iter().map(|sum| if used > 0.0 { sum / used } else { 0.0 }).collect())
    }

    /// Weighted residuals of all fitted data with every seed; none where a run fails or lacks a datum's counterpart.
    fn of_every_seed(&self, values: &[f64]) -> Result<Option<Vec<Vec<f64>>>, ToolError> {
        let fitted: Vec<usize> = (0..self.plan.blocks.len()).filter(|&k| !self.plan.blocks[k].held_out).collect();
        let questions: Vec<Question> = fitted.iter().map(|&block| self.question(block, values)).collect();
        let answers = self.ask(&questions)?;
        if answers.iter().any(|answer| answer.failure().is_some()) {
            return Ok(None);
        }
        let with_seed = |seed: usize| {
            let of_datum = |datum: &Datum| {
                let place = fitted.iter().position(|&block| block == datum.block)?;
                let (value, _) = datum.target.predicted(answers[place].with_seed(seed)?).ok()?;
                Some(datum.residual(value)).filter(|residual| residual.is_finite())
            };
            self.data_of(false).map(of_datum).collect::<Option<Vec<f64>>>()
        };
        Ok((0..self.plan.repeats.count).map(with_seed).collect())
    }

    /// Variances from the scatter at the start, before the first search: one value for all data.
    pub(super) fn first_variances(&self) -> Result<Vec<f64>, ToolError> {
        let own = self.variances(&[self.plan.values(&self.plan.start())])?;
        let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
        Ok(vec![mean; own.len()])
    }

    /// Variances about the minimum, datum by datum.
    pub(super) fn variances_about(&self, answer: &Answer) -> Result<Vec<f64>, ToolError> {
        let threshold = answer.explored.as_ref().map_or(0.0, |explored| explored.region.threshold);
        let limit = answer.search.chi_squared + ABOUT * threshold;
        let near =
            answer.search.history.iter().filter(|evaluated| evaluated.chi_squared.is_some_and(|chi| chi <= limit));
        self.variances(&near.map(|evaluated| self.plan.values(&evaluated.point)).collect::<Vec<_>>())
    }
}
