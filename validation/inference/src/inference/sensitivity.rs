//! Screening by elementary effects: which parameters matter at all.
//!
//! A trajectory starts at a random point of a grid and changes one parameter after the other by Δ; the change of a
//! residual over Δ is an elementary effect. Its size averaged over trajectories ranks the parameters, its scatter shows
//! curvature or interaction.
//!
//! Sources: Morris, Technometrics 33 (1991) 161; Campolongo et al., Environ. Model. Softw. 22 (2007) 1509, for μ*.

use super::Evaluate;
use crate::sampling::Random;

/// Levels of the grid along every axis.
const LEVELS: usize = 4;

/// Change of a parameter, p/(2 (p − 1)) of the range for p levels, so that all levels are equally likely.
const CHANGE: f64 = LEVELS as f64 / (2.0 * (LEVELS as f64 - 1.0));

/// Effect of one parameter on the residuals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effect {
    /// Root mean square over the data of the mean size of its effects (μ*), in standard uncertainties of a datum per
    /// full range `[-]`; not a number without effects.
    pub mean_size: f64,
    /// Root mean square over the data of the standard deviation of its effects (σ), likewise `[-]`; not a number for
    /// fewer than two effects.
    pub deviation: f64,
}

/// The points of all trajectories, one trajectory of `dimensions` + 1 points after the other.
pub fn trajectories(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    let mut points = Vec::new();
    for _ in 0..count {
        let mut point: Vec<f64> = (0..dimensions).map(|_| random.index(LEVELS) as f64 / (LEVELS - 1) as f64).collect();
        let mut order: Vec<usize> = (0..dimensions).collect();
        random.shuffle(&mut order);
        points.push(point.clone());
        for k in order {
            point[k] = if point[k] < 0.5 { (point[k] + CHANGE).min(1.0) } else { (point[k] - CHANGE).max(0.0) };
            points.push(point.clone());
        }
    }
    points
}

/// Evaluates trajectories in one batch and measures the effects, one a parameter, from steps both ends of which worked.
///
/// # Errors
/// An error of the model itself.
pub fn screen<M: Evaluate>(model: &mut M, dimensions: usize, count: usize, seed: u64) -> Result<Vec<Effect>, M::Error> {
    let points = trajectories(count, dimensions, seed);
    let residuals = model.residuals(&points)?;
    let mut effects: Vec<Vec<Vec<f64>>> = vec![Vec::new(); dimensions];
    for (line, values) in points.chunks(dimensions + 1).zip(residuals.chunks(dimensions + 1)) {
        for (ends, results) in line.windows(2).zip(values.windows(2)) {
            let ([from, to], [Some(before), Some(after)]) = (ends, results) else { continue };
            let Some(k) = (0..dimensions).find(|k| from[*k] != to[*k]) else { continue };
            effects[k].push(before.iter().zip(after).map(|(a, b)| (b - a) / (to[k] - from[k])).collect());
        }
    }
    Ok(effects.iter().map(|list| effect(list)).collect())
}

/// Statistics of the effects of one parameter, each a list over the data.
fn effect(list: &[Vec<f64>]) -> Effect {
    let (count, data) = (list.len() as f64, list.first().map_or(0, Vec::len));
    let over_data = |square: &dyn Fn(usize) -> f64| ((0..data).map(square).sum::<f64>() / data as f64).sqrt();
    let mean_size = over_data(&|datum| {
        let mean = list.iter().map(|effect| effect[datum].abs()).sum::<f64>() / count;
        mean * mean
    });
    let deviation = over_data(&|datum| {
        let mean = list.iter().map(|effect| effect[datum]).sum::<f64>() / count;
        list.iter().map(|effect| (effect[datum] - mean) * (effect[datum] - mean)).sum::<f64>() / (count - 1.0)
    });
    Effect { mean_size, deviation }
}
