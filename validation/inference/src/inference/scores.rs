//! Ranking of discrete choices, such as drag laws, by how well each agrees with the same data.

use super::chi_squared;
use super::posterior::percentile;
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

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(name: &str, residuals: Vec<f64>) -> FittedChoice {
        FittedChoice { name: name.to_owned(), residuals, parameters: 0 }
    }

    #[test]
    fn a_clear_winner_always_wins() {
        let choices = [choice("poor", vec![3.0; 20]), choice("good", vec![0.5; 20]), choice("fair", vec![1.0; 20])];
        let scores = rank(&choices, 500, 1).unwrap();
        let names: Vec<&str> = scores.iter().map(|score| score.name.as_str()).collect();
        assert_eq!(names, ["good", "fair", "poor"]);
        assert_eq!((scores[0].first, scores[0].ranks, scores[2].ranks), (1.0, [1, 1], [3, 3]));
        assert!((scores[0].chi_squared - 5.0).abs() < 1e-12 && scores[0].reduced_chi_squared == Some(0.25));
        // Δχ² = 15 and 175
        assert!((scores[1].weight / scores[0].weight - libm::exp(-7.5)).abs() < 1e-12);
        assert!((scores.iter().map(|score| score.weight).sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn equals_share_the_first_place() {
        let mut random = Random::new(3);
        let mut noise = |name| choice(name, (0..40).map(|_| random.normal()).collect());
        let choices = [noise("one"), noise("two")];
        let scores = rank(&choices, 2000, 1).unwrap();
        assert!(scores[0].first > 0.3 && scores[0].first < 1.0 && scores[0].ranks == [1, 2]);
        assert!((scores[0].first + scores[1].first - 1.0).abs() < 1e-12);
        assert_eq!(scores, rank(&choices, 2000, 1).unwrap());
    }

    #[test]
    fn a_parameter_must_earn_its_keep() {
        let fitted = FittedChoice { parameters: 1, ..choice("fitted", vec![0.9; 10]) };
        let scores = rank(&[fitted, choice("plain", vec![0.95; 10])], 100, 1).unwrap();
        assert_eq!(scores[0].name, "plain");
    }

    #[test]
    fn choices_must_share_their_data() {
        assert_eq!(rank(&[], 10, 1), None);
        assert_eq!(rank(&[choice("a", vec![1.0]), choice("b", vec![1.0, 2.0])], 10, 1), None);
    }
}
