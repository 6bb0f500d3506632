//! A design: given points, and the minimum of the polynomial through them.

use super::{Budget, Halt, Recorder, SearchError, SearchResult, Termination, check};
use crate::inference::{Emulator, Evaluate};

/// Evaluates the points of a design in one batch, and the model at the minimum of their emulator.
///
/// # Errors
/// No points, one outside the unit cube, or what [`search`](super::search) returns.
pub fn search_design<M: Evaluate>(
    model: &mut M,
    points: &[Vec<f64>],
    budget: Budget,
) -> Result<SearchResult, SearchError<M::Error>> {
    check(points.first().map_or(&[], Vec::as_slice), &budget)?;
    for point in points {
        check(point, &budget)?;
    }
    let mut recorder = Recorder::new(model, budget.evaluations);
    let outcome = run(&mut recorder, points, &budget);
    recorder.finish(outcome, Vec::new(), true)
}

/// Evaluates the design and then the minimum of its emulator, if the points suffice for one.
pub(super) fn run<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    points: &[Vec<f64>],
    budget: &Budget,
) -> Result<Termination, Halt<M::Error>> {
    recorder.residuals(points)?;
    if let Some(emulator) = Emulator::fit(recorder.history(), budget.difference) {
        recorder.residuals_at(&emulator.minimum().point)?;
    }
    Ok(Termination::DesignDone)
}
