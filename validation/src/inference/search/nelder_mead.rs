//! Nelder and Mead's simplex, by the crate `argmin`, mirrored at the faces of the cube.
//!
//! The points of the first simplex are evaluated in one batch, all others one after another. A point at which the model
//! fails counts as infinitely bad.

use super::{Budget, Halt, Recorder, Stopped};
use crate::inference::{Evaluate, chi_squared};
use argmin::core::{CostFunction, Error, Executor, IterState};
use argmin::solver::neldermead::NelderMead;
use std::cell::RefCell;

/// Edge of the first simplex in the unit cube.
const FIRST_EDGE: f64 = 0.1;

/// The search as `argmin` sees it: it halts by an error, whose cause is kept here.
struct Objective<'a, 'b, M: Evaluate> {
    recorder: &'a RefCell<&'a mut Recorder<'b, M>>,
    halt: &'a RefCell<Option<Halt<M::Error>>>,
}

impl<M: Evaluate> CostFunction for Objective<'_, '_, M> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, point: &Vec<f64>) -> Result<f64, Error> {
        match self.recorder.borrow_mut().residuals_at(&mirrored(point)) {
            Ok(residuals) => Ok(residuals.map_or(f64::INFINITY, |residuals| chi_squared(&residuals))),
            Err(halt) => {
                self.halt.replace(Some(halt));
                Err(Error::msg("halted"))
            }
        }
    }
}

/// Shrinks a simplex around the minimum until the standard deviation of its χ² is below the tolerance.
pub(super) fn run<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    start: &[f64],
    budget: &Budget,
) -> Result<Stopped, Halt<M::Error>> {
    let (start, _) = recorder.working_start(start, budget.seed)?;
    let mut simplex = vec![start.clone()];
    for k in 0..start.len() {
        let mut corner = start.clone();
        corner[k] += if start[k] + FIRST_EDGE <= 1.0 { FIRST_EDGE } else { -FIRST_EDGE };
        simplex.push(corner);
    }
    // `argmin` panics on an error in its first evaluations, so they are made here
    recorder.residuals(&simplex)?;

    let solver = NelderMead::new(simplex).with_sd_tolerance(budget.tolerance);
    let Ok(solver) = solver else { return Ok(Stopped::Stalled) };
    let (recorder, halt) = (RefCell::new(recorder), RefCell::new(None));
    let objective = Objective { recorder: &recorder, halt: &halt };
    let iterations = 20 * budget.evaluations as u64;
    let outcome = Executor::new(objective, solver)
        .configure(|state: IterState<Vec<f64>, (), (), (), (), f64>| state.max_iters(iterations))
        .ctrlc(false)
        .run()
        .map(|result| result.state.iter < iterations);
    match (halt.take(), outcome) {
        (Some(halt), _) => Err(halt),
        (None, Ok(true)) => Ok(Stopped::Converged),
        (None, _) => Ok(Stopped::Stalled),
    }
}

/// The point with every coordinate reflected into the cube.
pub(super) fn mirrored(point: &[f64]) -> Vec<f64> {
    point
        .iter()
        .map(|u| {
            let folded = u.rem_euclid(2.0);
            if folded > 1.0 { 2.0 - folded } else { folded }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::stand_in::Valley;
    use super::super::{Method, search};
    use super::*;

    #[test]
    fn points_outside_are_reflected() {
        let inside = mirrored(&[-0.25, 0.5, 1.25, 2.25, -1.25]);
        assert_eq!(inside, [0.25, 0.5, 0.75, 0.25, 0.75]);
    }

    #[test]
    fn it_converges_by_itself() {
        let budget = Budget { evaluations: 1000, ..Budget::default() };
        let found = search(&mut Valley, &[0.5, 0.5], Method::NelderMead, budget).unwrap();
        assert_eq!(found.stopped, Stopped::Converged);
        assert!(found.chi_squared < 0.02 && found.history.len() < 100, "{}", found.history.len());
    }
}
