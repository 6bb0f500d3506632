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

#[cfg(test)]
mod tests {
    use super::super::super::stand_in::ExponentialDecay;
    use super::*;
    use crate::sampling::design::full_grid;

    #[test]
    fn the_minimum_of_the_emulator_betters_the_grid() {
        let grid = full_grid(&[4, 4, 4]);
        let budget = Budget { evaluations: 65, ..Budget::default() };
        let found = search_design(&mut ExponentialDecay::new(), &grid, budget).unwrap();
        assert_eq!((found.history.len(), found.stopped), (65, Termination::DesignDone));
        assert_eq!(found.best, found.history[64].point);
        let of_grid = found.history[..64].iter().filter_map(|e| e.chi_squared).fold(f64::INFINITY, f64::min);
        println!("best of grid {of_grid}, of the emulator {}", found.chi_squared);
        assert!(found.chi_squared < 0.2 * of_grid);
    }

    #[test]
    fn a_design_must_have_points() {
        assert!(matches!(
            search_design(&mut ExponentialDecay::new(), &[], Budget::default()),
            Err(SearchError::Setting { field: "start", .. })
        ));
    }
}
