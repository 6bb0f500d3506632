//! Two problems of the cases with two minima each: both are found and listed from wherever the search starts.

use super::coverage::{Problem, usual};
use bagnold_inference::inference::{LocalMinimum, chi_squared, search};
use bagnold_reference::film::{HerschelBulkleyFilm, Incline};
use bagnold_reference::settling::SettlingGrains;
use bagnold_solver::material::drag::DragLaw;

/// Cells of the grid that finds the minima by brute force.
const GRID: usize = 200;

/// The velocity of a plug falls with the flow index and then rises again, so it fits two; a second velocity at half its height,
/// measured worse, prefers one. The edge of the plug fixes the yield stress.
fn film(u: &[f64]) -> Vec<f64> {
    let of = |flow_index, yield_stress| {
        let incline = Incline { layer_height: 0.05, inclination: 0.3, gravity: 9.81, density: 1300.0 };
        let film = HerschelBulkleyFilm { incline, yield_stress, consistency: 78.0, flow_index };
        [film.plug_velocity(), film.velocity(0.017), film.plug_edge()]
    };
    let (model, data) = (of(0.3 * (40.0_f64 / 3.0).powf(u[0]), 20.0 + 100.0 * u[1]), of(0.6, 60.0));
    vec![
        (model[0] / data[0] - 1.0) / 0.005,
        (model[1] / data[1] - 1.0) / 0.1,
        (model[2] - data[2]) / 1e-4,
        // what no parameter explains
        0.5,
    ]
}

/// The flux of grains that sink rises with their fraction and falls again, as they hinder each other; their velocity, measured
/// badly, prefers the thin suspension.
fn suspension(u: &[f64]) -> Vec<f64> {
    let grains = SettlingGrains {
        grain_diameter: 1e-3,
        grain_density: 2600.0,
        fluid_density: 1000.0,
        kinematic_viscosity: 1e-6,
        gravity: 9.81,
    };
    let of = |fraction: f64| {
        let velocity = grains.hindered_velocity(DragLaw::WenYu, fraction).expect("a suspension");
        [fraction * velocity, velocity]
    };
    let (model, data) = (of(0.02 + 0.53 * u[0]), of(0.12));
    vec![(model[0] / data[0] - 1.0) / 0.03, (model[1] / data[1] - 1.0) / 0.4, 0.5]
}

/// Minima along the first coordinate on a grid, the lowest first; a second coordinate is at its best for each.
fn minima_of_grid(dimensions: usize, value: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
    let at_best = |first: f64| {
        if dimensions == 1 {
            return vec![first];
        }
        let (mut lower, mut upper) = (0.0, 1.0);
        for _ in 0..100 {
            let [near, far] = [1.0 / 3.0, 2.0 / 3.0].map(|share| lower + share * (upper - lower));
            if value(&[first, near]) < value(&[first, far]) { upper = far } else { lower = near }
        }
        vec![first, lower]
    };
    let points: Vec<Vec<f64>> = (0..=GRID).map(|cell| at_best(cell as f64 / GRID as f64)).collect();
    let values: Vec<f64> = points.iter().map(|point| value(point)).collect();
    let lowest = |cell: &usize| {
        let around = [cell.wrapping_sub(1), cell + 1];
        around.iter().filter_map(|other| values.get(*other)).all(|other| *other > values[*cell])
    };
    let mut found: Vec<usize> = (0..=GRID).filter(lowest).collect();
    found.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    found.into_iter().map(|cell| points[cell].clone()).collect()
}

/// Both minima of the model, the lower first, from each start.
fn assert_both_are_found(model: fn(&[f64]) -> Vec<f64>, starts: &[Vec<f64>]) {
    let known = minima_of_grid(starts[0].len(), |u| chi_squared(&model(u)));
    assert_eq!(known.len(), 2, "{known:?}");
    for start in starts {
        let mut problem =
            Problem { residuals: |u: &[f64]| Some(model(u)), truth: known[0].clone(), series: Vec::new() };
        let plan = usual(start.clone());
        let found = search(&mut problem, start, plan.method, plan.budget).expect("the model works");
        println!("from {start:.2?}: {} evaluations, {:.3?}", found.history.len(), found.minima);
        assert_eq!(found.minima.len(), 2, "{start:?}");
        for (minimum, exact) in found.minima.iter().zip(&known) {
            let exact = LocalMinimum { point: exact.clone(), chi_squared: 0.0 };
            assert!(minimum.is_at(&exact.point), "from {start:?}: {minimum:?} is not {exact:?}");
        }
    }
}

#[test]
fn both_flow_indices_of_a_film_are_found_from_everywhere() {
    let along = [0.05, 0.3, 0.5, 0.7, 0.95];
    let starts: Vec<Vec<f64>> = along.iter().flat_map(|a| along.iter().map(move |b| vec![*a, *b])).collect();
    assert_both_are_found(film, &starts);
}

#[test]
fn both_fractions_of_a_suspension_are_found_from_everywhere() {
    let starts: Vec<Vec<f64>> = [0.02, 0.2, 0.4, 0.6, 0.8, 0.98].map(|start| vec![start]).to_vec();
    assert_both_are_found(suspension, &starts);
}
