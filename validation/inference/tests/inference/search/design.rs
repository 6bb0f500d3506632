//! Search by a design.

use crate::stand_in::ExponentialDecay;
use bagnold_inference::inference::{Budget, SearchError, Termination, search_design};
use bagnold_inference::sampling::design::full_grid;

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
