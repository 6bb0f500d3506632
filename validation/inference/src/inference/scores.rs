//! Ranking of discrete choices, such as drag laws, by how well each agrees with the same data.

use super::chi_squared;
use super::region::CENTRAL;
use crate::sampling::Random;
use crate::statistics::percentile;

/// Score of a choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Name of the choice.
    pub name: String,
    /// Akaike weight of choices without fitted parameters: its share of Σ exp(−χ²/2) `[-]`.
    pub weight: f64,
    /// Share of resampled data for which it is the best `[-]`.
    pub first: f64,
    /// Least and largest rank, from 1, of 95 % of the resampled data.
    pub ranks: [usize; 2],
}

/// Ranks choices, the best first, by name and weighted residuals `[-]`, one a datum in the same order for all, with `repeats`
/// resamplings of the data points; none without choices or data, or where the choices do not have the same data.
pub fn rank(choices: &[(String, Vec<f64>)], repeats: usize, seed: u64) -> Option<Vec<Score>> {
    let data = choices.first()?.1.len();
    if data == 0 || choices.iter().any(|(_, residuals)| residuals.len() != data) {
        return None;
    }
    let misfits: Vec<f64> = choices.iter().map(|(_, residuals)| chi_squared(residuals)).collect();
    let least = misfits.iter().copied().fold(f64::INFINITY, f64::min);
    let likelihoods: Vec<f64> = misfits.iter().map(|misfit| libm::exp(-0.5 * (misfit - least))).collect();
    let sum: f64 = likelihoods.iter().sum();
    // the same data points for all choices, so that what is hard for all does not blur the order
    let mut random = Random::new(seed);
    let mut ranks: Vec<Vec<f64>> = vec![Vec::new(); choices.len()];
    for _ in 0..repeats {
        let drawn: Vec<usize> = (0..data).map(|_| random.index(data)).collect();
        let square = |residuals: &[f64], datum: &usize| residuals[*datum] * residuals[*datum];
        let resampled = choices.iter().map(|(_, residuals)| drawn.iter().map(|datum| square(residuals, datum)).sum());
        for (place, choice) in order(&resampled.collect::<Vec<f64>>()).into_iter().enumerate() {
            ranks[choice].push((place + 1) as f64);
        }
    }
    let score = |k: usize| {
        let mut places = ranks[k].clone();
        places.sort_by(f64::total_cmp);
        Score {
            name: choices[k].0.clone(),
            weight: likelihoods[k] / sum,
            first: places.iter().filter(|place| **place == 1.0).count() as f64 / repeats.max(1) as f64,
            ranks: [percentile(&places, CENTRAL[0]).floor() as usize, percentile(&places, CENTRAL[1]).ceil() as usize],
        }
    };
    Some(order(&misfits).into_iter().map(score).collect())
}

/// Indices of a list by rising value, equal ones in their order.
fn order(values: &[f64]) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..values.len()).collect();
    indices.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    indices
}
