//! The exact film of a Herschel–Bulkley fluid: τ_y, K and n from velocities at fifteen heights with 3 % of noise.

use super::coverage::{Problem, Tally, normal, usual};
use bagnold_inference::inference::{Evaluate, chi_squared, solve};
use bagnold_reference::film::{HerschelBulkleyFilm, Incline};
use std::fmt::Write;

const INCLINE: Incline = Incline { layer_height: 0.05, inclination: 0.3, gravity: 9.81, density: 1300.0 };
const HEIGHTS: usize = 15;
/// Relative standard uncertainty of a velocity.
const NOISE: f64 = 0.03;
/// Ranges of τ_y `[Pa]`, K `[Pa·sⁿ]` (logarithmic) and n `[-]`.
const RANGES: [(f64, f64); 3] = [(1.0, 150.0), (0.2, 80.0), (0.2, 1.5)];
const TRUTH: [f64; 3] = [60.0, 4.0, 0.6];
pub(crate) const START: [f64; 3] = [0.3, 0.6, 0.6];

/// τ_y, K and n at a point.
fn physical(u: &[f64]) -> [f64; 3] {
    let linear = |k: usize| RANGES[k].0 + u[k] * (RANGES[k].1 - RANGES[k].0);
    [linear(0), (RANGES[1].1 / RANGES[1].0).powf(u[1]) * RANGES[1].0, linear(2)]
}

fn truth() -> Vec<f64> {
    let linear = |k: usize| (TRUTH[k] - RANGES[k].0) / (RANGES[k].1 - RANGES[k].0);
    vec![linear(0), (TRUTH[1] / RANGES[1].0).ln() / (RANGES[1].1 / RANGES[1].0).ln(), linear(2)]
}

/// Velocities `[m/s]` at the heights.
fn velocities([yield_stress, consistency, flow_index]: [f64; 3], heights: usize) -> Vec<f64> {
    let film = HerschelBulkleyFilm { incline: INCLINE, yield_stress, consistency, flow_index };
    (0..heights).map(|k| film.velocity(INCLINE.layer_height * (k as f64 + 1.0) / heights as f64)).collect()
}

/// Data with these errors in standard uncertainties.
fn data(errors: &[f64]) -> Vec<f64> {
    velocities(TRUTH, errors.len()).iter().zip(errors).map(|(u, z)| u * (1.0 + NOISE * z)).collect()
}

pub(crate) fn film(seed: u64) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>>> {
    film_with(&normal(seed, HEIGHTS))
}

fn film_with(errors: &[f64]) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>> + use<>> {
    let heights = errors.len();
    let (data, exact) = (data(errors), velocities(TRUTH, heights));
    let residuals = move |u: &[f64]| {
        let model = velocities(physical(u), heights);
        Some((0..heights).map(|k| (model[k] - data[k]) / (NOISE * exact[k])).collect())
    };
    Problem { residuals, truth: truth(), series: vec![(0..heights).collect()] }
}

/// Errors of an autoregressive process of first order and unit variance.
pub(crate) fn correlated_errors(seed: u64, count: usize, coefficient: f64) -> Vec<f64> {
    let mut errors = normal(seed, count);
    for k in 1..count {
        errors[k] = coefficient * errors[k - 1] + (1.0 - coefficient * coefficient).sqrt() * errors[k];
    }
    errors
}

#[test]
#[ignore = "the full study: some minutes"]
fn correlated_errors_are_named_and_their_regions_hold_the_truth() {
    for (count, coefficient) in [(40, 0.5), (40, 0.8), (20, 0.8), (80, 0.5)] {
        let tally = Tally::of(200..240, &START, |seed| film_with(&correlated_errors(seed, count, coefficient)));
        tally.print(&format!("film of {count} velocities, correlation {coefficient}"));
        assert!(count != 40 || tally.correlated >= 32, "{tally:?}");
        assert!(count != 40 || tally.joint >= 34 && tally.single.iter().all(|one| *one >= 34), "{tally:?}");
    }
}

#[test]
fn regions_of_the_film_hold_the_truth() {
    let tally = Tally::of(0..10, &START, film);
    tally.print("Herschel–Bulkley film, 3 parameters");
    assert!(tally.joint >= 8 && tally.single.iter().all(|count| *count >= 8), "{tally:?}");
    assert!(tally.settled >= 9 && tally.raised <= 1, "{tally:?}");
}

#[test]
#[ignore = "the full study: a minute or two"]
fn regions_of_forty_films_hold_the_truth() {
    let tally = Tally::of(100..140, &START, film);
    tally.print("Herschel–Bulkley film, 3 parameters");
    assert!(tally.joint >= 34 && tally.single.iter().all(|count| *count >= 34), "{tally:?}");
    assert!(tally.raised <= 4, "{tally:?}");
}

/// χ² at the ends that are given is that of the model, within a tenth of its limit.
#[test]
fn ends_of_intervals_lie_at_the_limit() {
    let mut problem = film(3);
    let answer = solve(&mut problem, &usual(START.to_vec())).expect("the film works");
    let explored = answer.explored.expect("points enough");
    for end in explored.ends.iter().flatten().filter(|end| !end.open) {
        let residuals = problem.residuals(std::slice::from_ref(&end.point)).expect("it works").pop().flatten();
        let rise = chi_squared(&residuals.expect("it works")) - answer.search.chi_squared;
        assert!((rise / explored.region.limit - 1.0).abs() <= 0.1, "{rise}");
    }
}

/// Prints data and intervals of eight seeds as JSON for `profile.py`.
#[test]
#[ignore = "input of profile.py"]
fn intervals_for_comparison() {
    let mut text = String::new();
    for seed in 0..8 {
        let answer = solve(&mut film(seed), &usual(START.to_vec())).expect("the film works");
        let explored = answer.explored.expect("points enough");
        let intervals: Vec<[f64; 2]> = explored.region.profiles.iter().map(|profile| profile.interval).collect();
        let (data, least) = (data(&normal(seed, HEIGHTS)), answer.search.chi_squared);
        writeln!(
            text,
            "{{\"seed\": {seed}, \"data\": {data:?}, \"intervals\": {intervals:?}, \"chi_squared\": {least}}}"
        )
        .expect("a string");
    }
    println!("{text}");
}
