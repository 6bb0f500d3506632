//! Runs that scatter: every evaluation is repeated with several seeds; the mean counts, and its variance enters χ².
//!
//! The variance of a prediction's mean is that over the seeds, divided by their number. Of three seeds it is itself hardly
//! known, so it is not taken point by point, where a search would be drawn to points at which it happens to be large: the
//! first search uses the mean over all data at the start, the second the mean over all points about the region, datum by
//! datum. Between the two nothing is simulated twice.

use super::objective::Objective;
use super::repeated::Repeated;
use super::target::Target;
use crate::ToolError;
use crate::inference::Answer;
use crate::statistics::mean_and_variance;

/// Points about the minimum whose scatter is averaged: those whose χ² rises by no more than this many times the threshold.
const ABOUT: f64 = 25.0;

impl Objective<'_> {
    /// Variance of every fitted prediction's mean over that of its datum `[-]`, averaged over points of physical values at
    /// which the runs of all seeds succeed.
    fn variances(&self, points: &[Vec<f64>]) -> Result<Vec<f64>, ToolError> {
        let count = self.plan.repeats.count;
        let fitted: Vec<usize> = (0..self.plan.blocks.len()).filter(|&k| !self.plan.blocks[k].held_out).collect();
        let (mut sums, mut used) = (vec![0.0; self.data_of(false).count()], 0.0);
        for values in points {
            let answers = self.ask_at(&fitted, std::slice::from_ref(values))?;
            let with_seed = |seed: usize| {
                let value = |own: &Repeated, target: &Target| Some(target.predicted(own.with_seed(seed)?).ok()?.0);
                self.residuals_of(&fitted, &answers, value)
            };
            let Some(residuals) = (0..count).map(with_seed).collect::<Option<Vec<_>>>() else { continue };
            used += 1.0;
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += mean_and_variance(residuals.iter().map(|list| list[k])).1 / count as f64;
            }
        }
        Ok(sums.into_iter().map(|sum| if used > 0.0 { sum / used } else { 0.0 }).collect())
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
