//! Samples of the posterior on the emulator, by an ensemble of walkers that stretch towards each other.
//!
//! The density is exp(−χ²/2 s²) within the unit cube, with the factor s on the stated uncertainties: a prior that is flat over
//! the range of a parameter, or of its logarithm where its scale is logarithmic. A walker x moves along the line to another one
//! x', to x' + z (x − x') with z of density 1/√z on [1/2, 2], and accepts with probability z^(p − 1) π(new)/π(old): the method
//! is the same in any linear map of the parameters, so a narrow valley costs no more than a ball.
//!
//! Source: Goodman & Weare, Communications in Applied Mathematics and Computational Science 5 (2010) 65.

use super::emulator::Emulator;
use super::region::{CENTRAL, Region};
use crate::sampling::Random;
use crate::statistics::percentile;
use nalgebra::DVector;

/// Walkers, an even number.
const WALKERS: usize = 32;

/// Moves of every walker before the first sample, and moves after it.
const BURN_IN: usize = 300;
const MOVES: usize = 1500;

/// Moves between samples that are kept.
const THINNING: usize = 10;

/// Samples of the parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Posterior {
    /// Points of the unit cube.
    pub samples: Vec<Vec<f64>>,
    /// Interval of every parameter that holds 95 % of them, as many left out below as above.
    pub intervals: Vec<[f64; 2]>,
    /// Share of moves that were accepted `[-]`.
    pub acceptance: f64,
    /// Moves over which the mean of the walkers forgets, the longest of all parameters.
    pub correlation_moves: f64,
}

/// Samples the posterior of a region's emulator.
pub fn sample(region: &Region, seed: u64) -> Posterior {
    let emulator = &region.emulator;
    let mut random = Random::new(seed);
    let squared = region.inflation * region.inflation;
    let cost = |point: &[f64]| -> f64 {
        if point.iter().all(|u| (0.0..=1.0).contains(u)) {
            emulator.chi_squared(point) / squared
        } else {
            f64::INFINITY
        }
    };
    let mut walkers: Vec<Vec<f64>> = (0..WALKERS).map(|_| first(region, &mut random)).collect();
    let mut costs: Vec<f64> = walkers.iter().map(|walker| cost(walker)).collect();
    let dimensions = region.profiles.len();
    let (mut samples, mut means, mut accepted) = (Vec::new(), vec![Vec::new(); dimensions], 0);
    for step in 0..BURN_IN + MOVES {
        for place in 0..WALKERS {
            // of the other half, so that the whole is a Markov chain
            let half = WALKERS / 2;
            let other = random.index(half) + if place < half { half } else { 0 };
            let root = 0.5_f64.sqrt() + random.uniform() * (2.0_f64.sqrt() - 0.5_f64.sqrt());
            let stretch = root * root;
            let moved: Vec<f64> =
                walkers[place].iter().zip(&walkers[other]).map(|(x, o)| o + stretch * (x - o)).collect();
            let there = cost(&moved);
            let chance = libm::pow(stretch, dimensions as f64 - 1.0) * libm::exp(0.5 * (costs[place] - there));
            if random.uniform() < chance {
                (walkers[place], costs[place]) = (moved, there);
                accepted += usize::from(step >= BURN_IN);
            }
        }
        if step < BURN_IN {
            continue;
        }
        for (k, means) in means.iter_mut().enumerate() {
            means.push(walkers.iter().map(|walker| walker[k]).sum::<f64>() / WALKERS as f64);
        }
        if (step - BURN_IN).is_multiple_of(THINNING) {
            samples.extend(walkers.iter().cloned());
        }
    }
    Posterior {
        intervals: middles(&samples, dimensions),
        acceptance: accepted as f64 / (MOVES * WALKERS) as f64,
        correlation_moves: means.iter().map(|means| correlation_length(means)).fold(0.0, f64::max),
        samples,
    }
}

/// Start of a walker: near the best point, within the cube.
fn first(region: &Region, random: &mut Random) -> Vec<f64> {
    let spread = |k: usize| 0.2 * (region.profiles[k].interval[1] - region.profiles[k].interval[0]).max(1e-6);
    let one = |(k, u): (usize, &f64)| {
        let moved = u + spread(k) * random.normal();
        // mirrored at the faces
        let folded = moved.rem_euclid(2.0);
        if folded > 1.0 { 2.0 - folded } else { folded }
    };
    region.minimum.point.iter().enumerate().map(one).collect()
}

/// Integrated autocorrelation of a series, in its steps, over a window of five times itself.
fn correlation_length(series: &[f64]) -> f64 {
    let count = series.len();
    let mean = series.iter().sum::<f64>() / count as f64;
    let off = DVector::from_iterator(count, series.iter().map(|value| value - mean));
    let covariance = |lag: usize| off.rows(0, count - lag).dot(&off.rows(lag, count - lag)) / count as f64;
    let variance = covariance(0);
    let mut length = 1.0;
    for lag in 1..count / 2 {
        length += 2.0 * covariance(lag) / variance;
        if lag as f64 >= 5.0 * length {
            break;
        }
    }
    if length.is_finite() { length.max(1.0) } else { 1.0 }
}

/// Quantiles of the model's weighted residuals over the samples `[-]`: the band of 95 % that the posterior predicts for each
/// datum, as residuals at both ends.
pub fn predictive(emulator: &Emulator, posterior: &Posterior) -> Vec<[f64; 2]> {
    let thinned = posterior.samples.iter().step_by((posterior.samples.len() / 400).max(1));
    let predicted: Vec<Vec<f64>> = thinned.map(|sample| emulator.predict(sample)).collect();
    middles(&predicted, emulator.data())
}

/// Intervals that hold 95 % of each coordinate of some points, as many left out below as above.
pub fn middles(points: &[Vec<f64>], coordinates: usize) -> Vec<[f64; 2]> {
    let middle = |k: usize| {
        let mut values: Vec<f64> = points.iter().map(|point| point[k]).collect();
        values.sort_by(f64::total_cmp);
        CENTRAL.map(|share| percentile(&values, share))
    };
    (0..coordinates).map(middle).collect()
}
