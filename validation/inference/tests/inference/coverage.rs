//! Repeated synthetic experiments: do the regions contain the truth as often as they claim?

use crate::inference::bootstrap::bootstrap;
use crate::stand_in::{RANGES, Slopes, TRUTH};
use bagnold_inference::inference::{
    Budget, Emulator, Evaluate, Method, Region, SearchResult, Termination, Uncertainties, explore, search,
};
use bagnold_inference::sampling::Random;
use rayon::prelude::*;
use std::convert::Infallible;

const BUDGET: Budget = Budget { evaluations: 25, seed: 1, difference: 0.02, tolerance: 0.01, starts: 0 };

/// Starts 27 to 39 per cent of a range away from the truth, (0.8, 0.304, 0.573).
const STARTS: [[f64; 3]; 3] = [[0.5, 0.5, 0.5], [0.45, 0.6, 0.3], [0.55, 0.1, 0.85]];

fn calibrate(seed: u64) -> (SearchResult, Emulator) {
    let mut model = Slopes::new(seed);
    let found = search(&mut model, &STARTS[seed as usize % 3], Method::TrustRegion, BUDGET).unwrap();
    let further = Budget { evaluations: 12, ..BUDGET };
    let explored = explore(&mut model, found.history.clone(), Uncertainties::STATED, &further).unwrap().unwrap();
    (found, explored.emulator)
}

#[test]
fn twenty_experiments_find_the_truth() {
    let truth = Slopes::truth();
    let (mut contained, mut most, mut worst) = (0, 0, [0.0_f64; 3]);
    for seed in 0..20 {
        let (found, emulator) = calibrate(seed);
        let region = Region::new(&emulator, Uncertainties::STATED);
        most = most.max(found.history.len());
        contained += usize::from(region.contains(&truth));
        let minimum = emulator.minimum();
        for k in 0..3 {
            for point in [&found.best, &minimum.point] {
                worst[k] = worst[k].max((Slopes::physical(k, point[k]) / TRUTH[k] - 1.0).abs());
            }
        }
        let width = |k: usize| {
            let [from, to] = region.profiles[k].interval;
            100.0 * (Slopes::physical(k, to) - Slopes::physical(k, from)) / TRUTH[k]
        };
        println!(
            "seed {seed}: {} evaluations, χ² {:.3} (emulator {:.3}), {:?}, leave-one-out {:.2?}, widths \
             {:.3} {:.2} {:.2} %, {}",
            found.history.len(),
            found.chi_squared,
            minimum.chi_squared,
            emulator.degree,
            emulator.leave_one_out,
            width(0),
            width(1),
            width(2),
            found.stopped
        );
    }
    println!("most evaluations {most}, contained {contained} of 20, worst relative errors {worst:?}");
    assert!(most <= 25 && contained >= 17);
    assert!(worst.iter().all(|error| *error < 0.02), "{worst:?}");
}

/// Experiments of so many whose joint region, and whose interval of each parameter, hold the truth.
fn held(experiments: u64) -> [usize; 4] {
    let truth = Slopes::truth();
    // an experiment each, on all threads: the counts do not depend on their order
    let experiment = |seed: u64| {
        let (_, emulator) = calibrate(seed);
        let region = Region::new(&emulator, Uncertainties::STATED);
        let single = |k: usize| {
            let [from, to] = region.profiles[k].interval;
            usize::from((from..=to).contains(&truth[k]))
        };
        [usize::from(region.contains(&truth)), single(0), single(1), single(2)]
    };
    let add = |a: [usize; 4], b: [usize; 4]| [0, 1, 2, 3].map(|k: usize| a[k] + b[k]);
    let held = (100..100 + experiments).into_par_iter().map(experiment).reduce(|| [0; 4], add);
    println!("of {experiments}: joint region and intervals {held:?}");
    held
}

/// 95 %, or 57 of 60, less three standard deviations of a binomial count (1.7 each), and never all.
#[test]
fn the_joint_region_has_its_nominal_coverage() {
    let held = held(60);
    assert!(held.iter().all(|count| (52..=59).contains(count)), "{held:?} of 60");
}

#[test]
#[ignore = "the full study: a minute, for a change of intervals"]
fn the_joint_region_has_its_nominal_coverage_in_many_experiments() {
    let held = held(500);
    assert!(held.iter().all(|count| (460..=490).contains(count)), "{held:?} of 500");
}

/// The exact information of the stand-in, by central differences.
#[test]
fn the_covariance_is_that_of_the_exact_derivatives() {
    let (_, emulator) = calibrate(3);
    let region = Region::new(&emulator, Uncertainties::STATED);
    let model = Slopes::new(3);
    let (truth, step) = (Slopes::truth(), 1e-5);
    let jacobian = nalgebra::DMatrix::from_fn(100, 3, |row, k| {
        let at = |change: f64| {
            let mut u = truth.clone();
            u[k] += change;
            model.at(&u)[row]
        };
        (at(step) - at(-step)) / (2.0 * step)
    });
    let exact = jacobian.tr_mul(&jacobian).try_inverse().unwrap();
    for k in 0..3 {
        let (found, exact) = (region.covariance[(k, k)].sqrt(), exact[(k, k)].sqrt());
        println!("parameter {k} of {:?}: standard error {found:.5} of the range, exactly {exact:.5}", RANGES[k]);
        assert!((found / exact - 1.0).abs() < 0.25);
    }
    println!("correlation {}", region.correlation);
}

#[test]
fn bootstrap_and_profile_agree() {
    let (_, emulator) = calibrate(4);
    let region = Region::new(&emulator, Uncertainties::STATED);
    let repeated = bootstrap(&emulator, 400, 7);
    for k in 0..3 {
        let ([a, b], [c, d]) = (region.profiles[k].interval, repeated.intervals[k]);
        println!("parameter {k}: profile {a:.4} to {b:.4}, bootstrap {c:.4} to {d:.4}");
        assert!((a - c).abs() < 0.15 * (b - a) && (b - d).abs() < 0.15 * (b - a));
    }
}

/// A model whose residuals wobble from point to point, as those of particles do.
struct Rough {
    slopes: Slopes,
    /// Standard deviation of the wobble, in standard uncertainties of a datum.
    wobble: f64,
}

impl Evaluate for Rough {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let one = |u: &Vec<f64>| {
            let seed = u.iter().fold(7_u64, |seed, u| seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ u.to_bits());
            let mut random = Random::new(seed);
            // one wobble a slope, which all of its depths share
            let wobbles: Vec<f64> = (0..5).map(|_| self.wobble * random.normal()).collect();
            self.slopes.at(u).iter().enumerate().map(|(k, residual)| residual + wobbles[k / 20]).collect()
        };
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

#[test]
fn a_rough_model_is_fitted_all_the_same() {
    let truth = Slopes::truth();
    for wobble in [0.02, 0.05] {
        let (mut contained, mut worst, mut evaluations, mut converged) = (0, [0.0_f64; 3], 0, 0);
        for seed in 0..40 {
            let mut model = Rough { slopes: Slopes::new(seed), wobble };
            let found = search(&mut model, &STARTS[seed as usize % 3], Method::TrustRegion, BUDGET).unwrap();
            let emulator = Emulator::fit(&found.history, BUDGET.difference).unwrap();
            let minimum = emulator.minimum();
            for k in 0..3 {
                worst[k] = worst[k].max((Slopes::physical(k, minimum.point[k]) / TRUTH[k] - 1.0).abs());
            }
            contained += usize::from(Region::new(&emulator, Uncertainties::STATED).contains(&truth));
            evaluations += found.history.len();
            converged += usize::from(found.stopped == Termination::Converged);
        }
        println!(
            "wobble {wobble}: {contained} of 40 contain the truth, {converged} converged, {evaluations} evaluations, \
             worst {worst:.3?}"
        );
        assert!(contained >= 32 && worst.iter().all(|error| *error < 0.02), "{contained} {worst:?}");
    }
}
