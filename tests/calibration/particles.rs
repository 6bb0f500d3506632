//! A film of particles in the place of its formula: coverage, correlated errors and two valleys again, five searches each.

use super::coverage::{Problem, Tally, normal, usual};
use super::film::correlated_errors;
use bagnold_harness::case::{Limits, Silent};
use bagnold_harness::evaluation::{CaseRequest, evaluate};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_inference::inference::{SearchResult, solve};
use bagnold_validation::REGISTRY;
use std::path::Path;

const WITH: &str = "resolution = 10\njitter = 0.0\nrelaxation_times = 1.0\n\
                    material = { law = \"herschel-bulkley\", yield_stress = 5.1, consistency = 1.1, flow_index = 0.7, regularisation_rate = 0.3 }\n";
/// Height of the film `[m]`.
const HEIGHT: f64 = 0.01;
/// Relative standard uncertainty of a velocity.
const NOISE: f64 = 0.03;
/// Ranges of τ_y `[Pa]`, K `[Pa·sⁿ]` (logarithmic) and n `[-]`, and the truth in the unit cube.
const RANGES: [(f64, f64); 3] = [(1.0, 12.0), (0.3, 4.0), (0.3, 1.5)];
const TRUTH: [f64; 3] = [0.37, 0.5, 0.33];
const START: [f64; 3] = [0.2, 0.7, 0.6];
/// τ_y `[Pa]` of the two valleys; their consistency lies where the velocity of the plug has a least value over n.
const YIELD_STRESS: f64 = 5.1;
const VALLEYS: [(f64, f64); 2] = [(4.0, 14.0), (0.25, 4.0)];

fn linear((lower, upper): (f64, f64), u: f64) -> f64 {
    lower + u * (upper - lower)
}

fn logarithmic((lower, upper): (f64, f64), u: f64) -> f64 {
    lower * (upper / lower).powf(u)
}

/// Velocities `[m/s]` of particles at heights over that of the film; none where the run fails.
fn velocities([yield_stress, consistency, flow_index]: [f64; 3], heights: &[f64]) -> Option<Vec<f64>> {
    let with = toml::from_str(WITH).expect("parameters of the case");
    let request = CaseRequest { case: "film".to_owned(), with, ..CaseRequest::default() };
    let fields = [("yield_stress", yield_stress), ("consistency", consistency), ("flow_index", flow_index)];
    let settings = fields.map(|(name, value)| format!("material.{name}={value}"));
    let prepared = request.prepare(*REGISTRY, Path::new("particles.rs"), &settings, Limits::default()).ok()?;
    let record = evaluate(prepared, &[], &Store::open(StorePolicy::Use), &Silent).expect("threads to run it");
    let table = record.tables.iter().find(|table| table.columns.iter().any(|column| column == "u [m/s]"))?;
    let place = |name: &str| table.columns.iter().position(|column| column == name);
    let (y, u) = (place("y [m]")?, place("u [m/s]")?);
    let at = |height: f64| {
        let above = table.rows.iter().position(|row| row[y] >= height * HEIGHT).unwrap_or(table.rows.len() - 1).max(1);
        let (lower, upper) = (&table.rows[above - 1], &table.rows[above]);
        let share = (height * HEIGHT - lower[y]) / (upper[y] - lower[y]);
        lower[u] + share.min(1.0) * (upper[u] - lower[u])
    };
    record.failure.is_none().then(|| heights.iter().map(|height| at(*height)).collect())
}

/// Velocities at as many heights as there are errors `[-]`.
fn film(errors: &[f64]) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>> + use<>> {
    let heights: Vec<f64> = (0..errors.len()).map(|k| 0.08 + 0.86 * k as f64 / errors.len() as f64).collect();
    let model = move |u: &[f64]| {
        velocities([linear(RANGES[0], u[0]), logarithmic(RANGES[1], u[1]), linear(RANGES[2], u[2])], &heights)
    };
    problem(model, TRUTH.to_vec(), vec![NOISE; errors.len()], errors, vec![(0..errors.len()).collect()])
}

/// The plug's velocity and the consistency by a rheometer; a second velocity, measured badly.
fn two_valleys(errors: &[f64]) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>> + use<>> {
    let model = |u: &[f64]| {
        let consistency = logarithmic(VALLEYS[0], u[0]);
        let found = velocities([YIELD_STRESS, consistency, logarithmic(VALLEYS[1], u[1])], &[0.94, 0.3])?;
        Some(vec![found[0], consistency, found[1]])
    };
    problem(model, vec![0.45, 0.3], vec![0.01, 0.02, 0.3], errors, Vec::new())
}

fn problem<F: Fn(&[f64]) -> Option<Vec<f64>>>(
    model: F,
    truth: Vec<f64>,
    sigma: Vec<f64>,
    errors: &[f64],
    series: Vec<Vec<usize>>,
) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>> + use<F>> {
    let exact = model(&truth).expect("the truth can be simulated");
    let errors = errors.to_vec();
    let residuals = move |u: &[f64]| {
        let found = model(u)?;
        Some((0..found.len()).map(|k| (found[k] / exact[k] - 1.0) / sigma[k] - errors[k]).collect())
    };
    Problem { residuals, truth, series }
}

#[test]
#[ignore = "the full study: films of particles are simulated for a quarter of an hour"]
fn regions_of_films_of_particles_hold_the_truth() {
    let tally = Tally::of(300..305, &START, |seed| film(&normal(seed, 15)));
    tally.print("film of particles, 3 parameters");
    assert!(tally.joint >= 4 && tally.single.iter().all(|one| *one >= 4), "{tally:?}");
    let tally = Tally::of(300..305, &START, |seed| film(&correlated_errors(seed, 40, 0.8)));
    tally.print("film of particles, 40 velocities, correlation 0.8");
    assert!(tally.correlated >= 4 && tally.joint >= 4, "{tally:?}");
}

#[test]
#[ignore = "the full study: films of particles are simulated for some minutes"]
fn the_lower_valley_of_films_of_particles_is_found() {
    let found = (300..305).map(|seed| {
        let mut problem = two_valleys(&normal(seed, 3));
        let answer = solve(&mut problem, &usual(vec![0.2, 0.8])).expect("the model works");
        let SearchResult { best, stopped, minima, history, .. } = answer.search;
        println!("{seed}: {stopped} {minima:?}, {} evaluations", history.len());
        // the law refuses a flow index above 2, where the second valley begins
        usize::from(best[1] < 0.5)
    });
    assert_eq!(found.sum::<usize>(), 5);
}
