//! Runs that scatter: every evaluation is repeated with several seeds; the mean counts, and its variance enters χ².
//!
//! The variance of a prediction's mean is that over the seeds, divided by their number. Of three seeds it is itself hardly
//! known, so it is not taken point by point, where a search would be drawn to points at which it happens to be large: the
//! first search uses the mean over all data at the start, the second the mean over all points about the region, datum by
//! datum. Between the two nothing is simulated twice.

use super::error::CalibrationError;
use super::objective::{Objective, Question};
use super::plan::{Choice, Plan};
use super::target::{Datum, Target};
use crate::evaluation::{Paths, Record};
use crate::inference::Answer;
use crate::input::FieldError;

/// Points about the minimum whose scatter is averaged: those whose χ² rises by no more than this many times the threshold.
const ABOUT: f64 = 25.0;

/// More repeats than this cost more than they tell.
const MOST_REPEATS: usize = 100;

/// How often every evaluation is repeated.
#[derive(Debug, Clone, PartialEq)]
pub struct Repeats {
    /// Seeds: 1, 2, … up to this.
    pub count: usize,
    /// Where a case has its seed.
    pub path: Paths,
}

impl Repeats {
    /// What a plan says about it.
    ///
    /// # Errors
    /// A number out of range, repeats beside choices, a path without repeats.
    pub(super) fn checked(count: Option<usize>, path: Option<Paths>, choices: &[Choice]) -> Result<Self, FieldError> {
        let count = count.unwrap_or(1);
        if !(1..=MOST_REPEATS).contains(&count) {
            let remedy = "3 to 5 seeds tell the scatter of runs";
            return Err(FieldError::new("repeats", count, &format!("between 1 and {MOST_REPEATS}"), remedy));
        }
        if count > 1 && !choices.is_empty() {
            return Err(FieldError::new("repeats", count, "1 beside `choices`", "choices are tried once"));
        }
        if count == 1 && path.is_some() {
            return Err(FieldError::new("seed_path", "given", "absent without `repeats`", "say `repeats = 3`"));
        }
        Ok(Self { count, path: path.unwrap_or_else(|| Paths::Everywhere("seed".to_owned())) })
    }

    /// Where a case has its seed, if evaluations are repeated.
    pub(super) fn path_in(&self, case: &str) -> Option<&str> {
        self.path.in_case(case).filter(|_| self.count > 1)
    }

    /// The words for a case that has no seed there.
    pub(super) fn seedless(&self, case: &str, path: &str) -> FieldError {
        let remedy = format!(
            "`bagnold show {case}` prints its fields; where only some cases have seeds, say which: \
             seed_path = {{ column-planar = \"seed\" }}"
        );
        FieldError::new("seed_path", path, &format!("the path of a seed in `{case}`"), &remedy)
    }

    /// The question with every seed; once as it is where there is nothing to repeat.
    pub(super) fn of(&self, plan: &Plan, question: &Question) -> Vec<Question> {
        let case = &plan.blocks[question.block].request.case;
        match self.path_in(case) {
            None => vec![question.clone()],
            Some(path) => (1..=self.count)
                .map(|seed| {
                    let mut settings = question.settings.clone();
                    settings.push(format!("{path}={seed}"));
                    Question { block: question.block, settings }
                })
                .collect(),
        }
    }
}

/// What one question was answered with every seed.
#[derive(Debug, Clone)]
pub(super) struct Repeated(Vec<Record>);

impl Repeated {
    /// The answers of all seeds, the first seed's first.
    pub(super) const fn new(records: Vec<Record>) -> Self {
        Self(records)
    }

    /// Why a run failed, if one did.
    pub(super) fn failure(&self) -> Option<&str> {
        self.0.iter().find_map(|record| record.failure.as_deref())
    }

    /// With one seed; a case without seeds gives the same with all.
    pub(super) fn with_seed(&self, place: usize) -> Option<&Record> {
        self.0.get(place).or_else(|| self.0.first())
    }

    /// The mean over the seeds of what their records say, with its unit.
    ///
    /// # Errors
    /// The words for what a record does not have.
    pub(super) fn predicted(&self, target: &Target) -> Result<(f64, String), String> {
        let mut sum = 0.0;
        let mut unit = String::new();
        for record in &self.0 {
            let value;
            (value, unit) = target.predicted(record)?;
            sum += value;
        }
        Ok((sum / self.0.len() as f64, unit))
    }
}

impl Objective<'_> {
    /// Variance of every fitted prediction's mean over that of its datum `[-]`, averaged over points of physical values at
    /// which all runs succeed; zeros without repeats.
    fn variances(&self, points: &[Vec<f64>]) -> Result<Vec<f64>, CalibrationError> {
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
    fn of_every_seed(&self, values: &[f64]) -> Result<Option<Vec<Vec<f64>>>, CalibrationError> {
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

    /// What the scatter at the start says, before anything is known: one variance for all data.
    pub(super) fn first_variances(&self) -> Result<Vec<f64>, CalibrationError> {
        let own = self.variances(&[self.plan.values(&self.plan.start())])?;
        let mean = own.iter().sum::<f64>() / own.len().max(1) as f64;
        Ok(vec![mean; own.len()])
    }

    /// What it is about the minimum, datum by datum.
    pub(super) fn variances_about(&self, answer: &Answer) -> Result<Vec<f64>, CalibrationError> {
        let threshold = answer.explored.as_ref().map_or(0.0, |explored| explored.region.threshold);
        let limit = answer.search.chi_squared + ABOUT * threshold;
        let near =
            answer.search.history.iter().filter(|evaluated| evaluated.chi_squared.is_some_and(|chi| chi <= limit));
        self.variances(&near.map(|evaluated| self.plan.values(&evaluated.point)).collect::<Vec<_>>())
    }
}
