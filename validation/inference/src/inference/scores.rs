//! Ranking of discrete choices, such as drag laws, by how well each agrees with the same data.

use super::chi_squared;
use super::percentile::percentile;
use super::region::CENTRAL;
use crate::sampling::Random;

/// A choice with the weighted residuals of its best parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedChoice {
    /// Name of the choice.
    pub name: String,
    /// Weighted residuals `[-]`, one a datum in the same order for all choices.
    pub residuals: Vec<f64>,
    /// Parameters that were fitted for it.
    pub parameters: usize,
}

/// Score of a choice.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// Name of the choice.
    pub name: String,
    /// χ² `[-]`.
    pub chi_squared: f64,
    /// χ² over the number of data less that of fitted parameters `[-]`; none unless there are more data.
    pub reduced_chi_squared: Option<f64>,
    /// Akaike weight: its share of Σ exp(−AIC/2) with AIC = χ² + 2 parameters `[-]`.
    pub weight: f64,
    /// Share of resampled data for which it is the best `[-]`.
    pub first: f64,
    /// Least and largest rank, from 1, of 95 % of the resampled data.
    pub ranks: [usize; 2],
}

/// Ranks choices, the best first, with `repeats` resamplings of the data points; none without choices or data, or where
/// the choices do not have the same data.
#[must_use]
pub fn rank(choices: &[FittedChoice], repeats: usize, seed: u64) -> Option<Vec<Score>> {
    let data = choices.first()?.residuals.len();
    if data == 0 || choices.iter().any(|choice| choice.residuals.len() != data) {
        return None;
    }
    let criteria: Vec<f64> =
        choices.iter().map(|choice| chi_squared(&choice.residuals) + 2.0 * choice.parameters as f64).collect();
    let least = criteria.iter().copied().fold(f64::INFINITY, f64::min);
    let likelihoods: Vec<f64> = criteria.iter().map(|criterion| libm::exp(-0.5 * (criterion - least))).collect();
    let sum: f64 = likelihoods.iter().sum();

    // the same data points for all choices, so that what is hard for all does not blur the order
    let mut random = Random::new(seed);
    let mut ranks: Vec<Vec<f64>> = vec![Vec::new(); choices.len()];
    for _ in 0..repeats {
        let drawn: Vec<usize> = (0..data).map(|_| random.index(data)).collect();
        let resampled = choices.iter().map(|choice| {
            let sum: f64 = drawn.iter().map(|datum| choice.residuals[*datum] * choice.residuals[*datum]).sum();
            sum + 2.0 * choice.parameters as f64
        });
        for (place, choice) in order(&resampled.collect::<Vec<f64>>()).into_iter().enumerate() {
            ranks[choice].push((place + 1) as f64);
        }
    }

    let score = |k: usize| {
        let choice = &choices[k];
        let mut places = ranks[k].clone();
        places.sort_by(f64::total_cmp);
        let chi_squared = chi_squared(&choice.residuals);
        let freedom = data.checked_sub(choice.parameters).filter(|freedom| *freedom > 0);
        Score {
            name: choice.name.clone(),
            chi_squared,
            reduced_chi_squared: freedom.map(|freedom| chi_squared / freedom as f64),
            weight: likelihoods[k] / sum,
            first: places.iter().filter(|place| **place == 1.0).count() as f64 / repeats.max(1) as f64,
            ranks: [percentile(&places, CENTRAL[0]).floor() as usize, percentile(&places, CENTRAL[1]).ceil() as usize],
        }
    };
    Some(order(&criteria).into_iter().map(score).collect())
}

/// Indices of a list by rising value, equal ones in their order.
fn order(values: &[f64]) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..values.len()).collect();
    indices.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    indices
}
