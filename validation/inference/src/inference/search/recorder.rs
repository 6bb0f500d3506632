//! Record of the evaluations: each distinct point once, never more than the budget.

use super::{Evaluated, LocalMinimum, SearchError, SearchResult, Termination, lowest};
use crate::inference::Evaluate;
use crate::sampling::design;
use std::collections::BTreeMap;

/// Reason for the halt of a method.
#[derive(Debug)]
pub enum Halt<E> {
    /// A new point would exceed the budget.
    BudgetSpent,
    /// No point tried so far works, and none else is to be tried.
    NothingWorked,
    /// The model has an error.
    Model(E),
    /// Numbers of residuals that differ: expected and found.
    Residuals(usize, usize),
}

/// The model with a memory and a budget.
pub struct Recorder<'a, M> {
    model: &'a mut M,
    budget: usize,
    history: Vec<Evaluated>,
    /// Position in the history by the bits of the coordinates.
    known: BTreeMap<Vec<u64>, usize>,
    /// Number of residuals of the first success.
    data: Option<usize>,
}

/// A point and the residuals there.
type EvaluatedStart = (Vec<f64>, Vec<f64>);

/// Points of one batch while none has worked yet.
const RESCUE_BATCH: usize = 4;

impl<'a, M: Evaluate> Recorder<'a, M> {
    /// Recorder without evaluated points.
    pub fn new(model: &'a mut M, budget: usize) -> Self {
        Self::with(model, Vec::new(), budget)
    }

    /// A recorder with known points, which count in the budget.
    pub(in crate::inference) fn with(model: &'a mut M, history: Vec<Evaluated>, budget: usize) -> Self {
        let known = history.iter().enumerate().map(|(place, evaluated)| (bits(&evaluated.point), place)).collect();
        let data = history.iter().find_map(|evaluated| evaluated.residuals.as_ref().map(Vec::len));
        Self { model, budget, history, known, data }
    }

    /// Allows a number of further points.
    pub(in crate::inference) fn allow(&mut self, evaluations: usize) {
        self.budget = self.history.len() + evaluations;
    }

    /// Every distinct point so far.
    pub fn history(&self) -> &[Evaluated] {
        &self.history
    }

    /// The residuals at each point, new ones in one batch. Points beyond the budget are not evaluated, the
    /// points before them are.
    pub fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Halt<M::Error>> {
        let mut fresh: Vec<Vec<f64>> = Vec::new();
        for point in points {
            let next = self.history.len() + fresh.len();
            let key = bits(point);
            if self.known.contains_key(&key) || next >= self.budget {
                continue;
            }
            self.known.insert(key, next);
            fresh.push(point.clone());
        }
        if !fresh.is_empty() {
            let results = self.model.residuals(&fresh).map_err(Halt::Model)?;
            for (point, residuals) in fresh.into_iter().zip(results) {
                let evaluated = Evaluated::new(point, residuals);
                if let Some(list) = &evaluated.residuals {
                    let expected = *self.data.get_or_insert(list.len());
                    if expected != list.len() {
                        return Err(Halt::Residuals(expected, list.len()));
                    }
                }
                self.history.push(evaluated);
            }
        }
        points
            .iter()
            .map(|point| {
                let position = self.known.get(&bits(point)).ok_or(Halt::BudgetSpent)?;
                Ok(self.history.get(*position).and_then(|evaluated| evaluated.residuals.clone()))
            })
            .collect()
    }

    /// The residuals at one point.
    pub fn residuals_at(&mut self, point: &[f64]) -> Result<Option<Vec<f64>>, Halt<M::Error>> {
        Ok(self.residuals(&[point.to_vec()])?.pop().flatten())
    }

    /// The start, or where the model fails there, the best of the first few points spread over the cube that work.
    pub fn working_start(&mut self, start: &[f64], seed: u64) -> Result<EvaluatedStart, Halt<M::Error>> {
        if let Some(residuals) = self.residuals_at(start)? {
            return Ok((start.to_vec(), residuals));
        }
        for batch in design::sobol(self.budget, start.len(), seed).chunks(RESCUE_BATCH) {
            let outcome = self.residuals(batch);
            if let Some(best) = lowest(&self.history) {
                let residuals = self.residuals_at(&best.point)?.unwrap_or_default();
                return Ok((best.point, residuals));
            }
            outcome?;
        }
        Err(Halt::NothingWorked)
    }

    /// The result of a method that has ended.
    pub(in crate::inference) fn finish(
        self,
        outcome: Result<Termination, Halt<M::Error>>,
        mut minima: Vec<LocalMinimum>,
        every_start: bool,
    ) -> Result<SearchResult, SearchError<M::Error>> {
        let stopped = match outcome {
            Ok(stopped) => stopped,
            Err(Halt::BudgetSpent | Halt::NothingWorked) => Termination::BudgetSpent,
            Err(Halt::Model(error)) => return Err(SearchError::Model(error)),
            Err(Halt::Residuals(expected, found)) => return Err(SearchError::Residuals { expected, found }),
        };
        match lowest(&self.history) {
            Some(LocalMinimum { point: best, chi_squared }) => {
                minima.sort_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared));
                Ok(SearchResult { best, chi_squared, history: self.history, stopped, minima, every_start })
            }
            None => Err(SearchError::NothingWorked(self.history.len())),
        }
    }
}

/// The coordinates as bits; both zeros are one.
fn bits(point: &[f64]) -> Vec<u64> {
    point.iter().map(|u| (u + 0.0).to_bits()).collect()
}
