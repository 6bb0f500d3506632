//! Evolution of a normal distribution of points (CMA-ES), for a noisy χ² or one with several minima.
//!
//! Each generation is one batch. Only the order of the χ² counts, so noise and outliers do little harm; points at which
//! the model fails come last. Coordinates outside the cube are mirrored at its faces.
//!
//! Source: Hansen, "The CMA evolution strategy: a tutorial", arXiv:1604.00772 (2016); equation numbers below.

use super::nelder_mead::mirrored;
use super::{Budget, Halt, Recorder, Stopped};
use crate::inference::{Evaluate, chi_squared};
use crate::sampling::Random;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// First standard deviation of the points in the unit cube.
const FIRST_DEVIATION: f64 = 0.2;

/// Standard deviation below which points cannot be distinguished.
const LEAST_DEVIATION: f64 = 1e-6;

/// The constants of the strategy, all `[-]`.
struct Rates {
    /// Points of a generation.
    offspring: usize,
    /// Weights of the better half, the best first.
    weights: Vec<f64>,
    /// Effective number of parents.
    mass: f64,
    step: f64,
    damping: f64,
    path: f64,
    rank_one: f64,
    rank_many: f64,
    /// Mean length of a standard normal vector.
    length: f64,
}

impl Rates {
    /// The defaults of the source's table 1 for a number of coordinates.
    fn new(dimensions: usize) -> Self {
        let n = dimensions as f64;
        let offspring = 4 + (3.0 * libm::log(n)) as usize;
        let half = offspring as f64 / 2.0;
        let raw: Vec<f64> = (1..=offspring / 2).map(|i| libm::log(half + 0.5) - libm::log(i as f64)).collect();
        let sum: f64 = raw.iter().sum();
        let weights: Vec<f64> = raw.iter().map(|weight| weight / sum).collect();
        let mass = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        let step = (mass + 2.0) / (n + mass + 5.0);
        let rank_one = 2.0 / ((n + 1.3) * (n + 1.3) + mass);
        Self {
            offspring,
            mass,
            step,
            damping: 1.0 + 2.0 * (((mass - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + step,
            path: (4.0 + mass / n) / (n + 4.0 + 2.0 * mass / n),
            rank_one,
            rank_many: (1.0 - rank_one).min(2.0 * (mass - 1.75 + 1.0 / mass) / ((n + 2.0) * (n + 2.0) + mass)),
            length: n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n)),
            weights,
        }
    }
}

/// Lets generations of points follow one another until all points of one are equally good.
pub(super) fn run<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    start: &[f64],
    budget: &Budget,
) -> Result<Stopped, Halt<M::Error>> {
    let dimensions = start.len();
    let rates = Rates::new(dimensions);
    let mut random = Random::new(budget.seed);
    let mut mean = DVector::from_column_slice(&recorder.working_start(start, budget.seed)?.0);
    let mut deviation = FIRST_DEVIATION;
    let mut covariance = DMatrix::<f64>::identity(dimensions, dimensions);
    let mut step_path = DVector::<f64>::zeros(dimensions);
    let mut shape_path = DVector::<f64>::zeros(dimensions);
    for generation in 1.. {
        let axes = SymmetricEigen::new(covariance.clone());
        let roots = axes.eigenvalues.map(|value| value.max(1e-20).sqrt());
        let spread = &axes.eigenvectors * DMatrix::from_diagonal(&roots);
        let points: Vec<Vec<f64>> = (0..rates.offspring)
            .map(|_| {
                let normal = DVector::from_fn(dimensions, |_, _| random.normal());
                mirrored((&mean + deviation * (&spread * normal)).as_slice())
            })
            .collect();
        let mut ranked: Vec<(f64, usize, Option<Vec<f64>>)> = recorder
            .residuals(&points)?
            .into_iter()
            .enumerate()
            .map(|(k, residuals)| (residuals.as_deref().map_or(f64::INFINITY, chi_squared), k, residuals))
            .collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let (least, most) = (ranked[0].0, ranked[rates.offspring - 1].0);
        let data = ranked[0].2.as_ref().map_or(0, Vec::len);
        if least.is_infinite() {
            // nothing to learn but that the points lie too far apart
            deviation *= 0.5;
            if deviation < LEAST_DEVIATION {
                return Ok(Stopped::Stalled);
            }
            continue;
        }
        if most - least < budget.negligible(least, data) {
            return Ok(Stopped::Converged);
        }

        // steps of the better half in units of the deviation, and their mean: equations 38 to 42
        let steps: Vec<DVector<f64>> = ranked[..rates.weights.len()]
            .iter()
            .map(|(_, k, _)| (DVector::from_column_slice(&points[*k]) - &mean) / deviation)
            .collect();
        let shift = steps.iter().zip(&rates.weights).fold(DVector::zeros(dimensions), |sum, (y, w)| sum + y * *w);
        mean += deviation * &shift;
        // the path of the deviation: 43
        let whitened = &axes.eigenvectors * axes.eigenvectors.tr_mul(&shift).component_div(&roots);
        step_path = (1.0 - rates.step) * &step_path + (rates.step * (2.0 - rates.step) * rates.mass).sqrt() * whitened;
        // the path of the covariance, halted while the deviation grows fast: 45
        let decay = 1.0 - libm::pow(1.0 - rates.step, 2.0 * f64::from(generation));
        let slow = step_path.norm() / decay.sqrt() < (1.4 + 2.0 / (dimensions as f64 + 1.0)) * rates.length;
        let weight = if slow { (rates.path * (2.0 - rates.path) * rates.mass).sqrt() } else { 0.0 };
        shape_path = (1.0 - rates.path) * &shape_path + weight * &shift;
        // 47
        let lost = if slow { 0.0 } else { rates.rank_one * rates.path * (2.0 - rates.path) };
        covariance *= 1.0 + lost - rates.rank_one - rates.rank_many;
        covariance += rates.rank_one * &shape_path * shape_path.transpose();
        for (y, w) in steps.iter().zip(&rates.weights) {
            covariance += rates.rank_many * *w * y * y.transpose();
        }
        // 44; a deviation above the cube's size says nothing more
        deviation *= libm::exp(rates.step / rates.damping * (step_path.norm() / rates.length - 1.0));
        deviation = deviation.min(1.0);
        if deviation * roots.max() < LEAST_DEVIATION {
            return Ok(Stopped::Stalled);
        }
    }
    Ok(Stopped::Stalled)
}

#[cfg(test)]
mod tests {
    use super::super::{Method, search};
    use super::*;
    use std::convert::Infallible;

    /// A bowl with ripples, whose deepest dent lies at (0.7, 0.2).
    struct Ripples;

    impl Evaluate for Ripples {
        type Error = Infallible;
        fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
            let ripple = |x: f64| 1.0 - libm::cos(8.0 * std::f64::consts::TAU * x);
            let one = |u: &Vec<f64>| {
                let (x, y) = (u[0] - 0.7, u[1] - 0.2);
                vec![(400.0 * (x * x + y * y) + 2.0 * (ripple(x) + ripple(y))).sqrt()]
            };
            Ok(points.iter().map(|u| Some(one(u))).collect())
        }
    }

    #[test]
    fn ripples_do_not_hold_it() {
        let mut reached = 0;
        for seed in 0..10 {
            let budget = Budget { evaluations: 400, seed, ..Budget::default() };
            let found = search(&mut Ripples, &[0.2, 0.8], Method::Evolution, budget).unwrap();
            reached += usize::from((found.best[0] - 0.7).abs() < 0.02 && (found.best[1] - 0.2).abs() < 0.02);
        }
        assert!(reached >= 6, "{reached}");
    }

    #[test]
    fn weights_are_a_share_each() {
        for dimensions in 1..8 {
            let rates = Rates::new(dimensions);
            assert!((rates.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            assert!(rates.weights.is_sorted_by(|a, b| a > b) && rates.mass > 1.0);
            assert!(rates.rank_one + rates.rank_many < 1.0 && rates.rank_many >= 0.0);
        }
    }
}
