//! The region of a search's points and, where it is wider than they reach, of further ones.
//!
//! A search that converges fast leaves its points close to the minimum. If the data determine a parameter badly, the
//! region lies far beyond them, where their polynomial is a guess. The model is then evaluated at the ends of the
//! intervals and at points spread between them, and the polynomials are fitted over the whole of the region, until it
//! no longer grows.

use super::emulator::{Degree, Emulator};
use super::region::{Region, Uncertainties};
use super::{Budget, Evaluate, Evaluated};
use crate::sampling::design::sobol;
use nalgebra::SymmetricEigen;

/// Rounds of further points.
const MOST_ROUNDS: usize = 4;

/// Rise of χ² over the region's threshold up to which points count as near a narrow region.
const NEARBY: f64 = 4.0;

/// An end of an interval is trusted with a point nearer than this share of its distance from the minimum.
const NEAR: f64 = 0.25;

/// The region, and what it rests on.
#[derive(Debug, Clone)]
pub struct Explored {
    /// The emulator of all points.
    pub emulator: Emulator,
    /// Its region.
    pub region: Region,
    /// Every point of the search and the further ones.
    pub history: Vec<Evaluated>,
    /// Whether every end of an interval lies near an evaluated point; if not, the budget or four rounds did not
    /// suffice.
    pub settled: bool,
}

/// Maps the region, evaluating at most `budget.evaluations` points that are not in the history; none without points
/// enough for an emulator.
///
/// # Errors
/// An error of the model itself.
pub fn explore<M: Evaluate>(
    model: &mut M,
    mut history: Vec<Evaluated>,
    uncertainties: Uncertainties,
    budget: &Budget,
) -> Result<Option<Explored>, M::Error> {
    let most = history.len() + budget.evaluations;
    let mut resolution = budget.difference;
    for round in 0.. {
        let Some(emulator) = Emulator::fit(&history, resolution) else { return Ok(None) };
        let region = Region::new(&emulator, uncertainties);
        if extent(&region) <= budget.difference {
            return refine(model, history, (emulator, region), uncertainties, most).map(Some);
        }
        let mut points = wanted(&region, &history, budget);
        let settled = points.is_empty();
        points.truncate(most - history.len());
        if points.is_empty() || round == MOST_ROUNDS {
            return Ok(Some(Explored { emulator, region, history, settled }));
        }
        evaluate(model, &mut history, points)?;
        resolution = budget.difference.max(extent(&region));
    }
    Ok(None)
}

/// A region that is narrower than the steps of the search: the model at both ends of its principal axes, and an emulator of
/// the points in and near it alone. Slopes over longer steps would turn a narrow valley out of its direction.
fn refine<M: Evaluate>(
    model: &mut M,
    mut history: Vec<Evaluated>,
    (emulator, region): (Emulator, Region),
    uncertainties: Uncertainties,
    most: usize,
) -> Result<Explored, M::Error> {
    let mut points = axes(&region);
    points.truncate(most - history.len());
    evaluate(model, &mut history, points)?;
    let near: Vec<Evaluated> = history
        .iter()
        .filter(|evaluated| {
            emulator.chi_squared(&evaluated.point) - region.minimum.chi_squared <= NEARBY * region.threshold
        })
        .cloned()
        .collect();
    let enough = near.len() > 2 * region.profiles.len();
    let local = if enough { Emulator::fit(&near, 0.5 * extent(&region)) } else { None };
    Ok(match local {
        Some(local) => {
            let region = Region::new(&local, uncertainties);
            Explored { emulator: local, region, history, settled: true }
        }
        None => Explored { emulator, region, history, settled: true },
    })
}

/// Adds the model at some points to the history.
fn evaluate<M: Evaluate>(model: &mut M, history: &mut Vec<Evaluated>, points: Vec<Vec<f64>>) -> Result<(), M::Error> {
    let results = model.residuals(&points)?;
    history.extend(points.into_iter().zip(results).map(|(point, residuals)| Evaluated::new(point, residuals)));
    Ok(())
}

/// Both ends of the principal axes of the joint region, within the cube.
fn axes(region: &Region) -> Vec<Vec<f64>> {
    let factors = SymmetricEigen::new(region.covariance.clone());
    let radius = region.threshold.sqrt() / region.inflation;
    let end = |axis: usize, sign: f64| {
        let step = sign * radius * factors.eigenvalues[axis].max(0.0).sqrt();
        let moved = |(k, u): (usize, &f64)| (u + step * factors.eigenvectors[(k, axis)]).clamp(0.0, 1.0);
        region.minimum.point.iter().enumerate().map(moved).collect()
    };
    (0..region.profiles.len()).flat_map(|axis| [end(axis, -1.0), end(axis, 1.0)]).collect()
}

/// The points that the region still lacks: ends of intervals, and as many between them as a quadratic needs.
fn wanted(region: &Region, history: &[Evaluated], budget: &Budget) -> Vec<Vec<f64>> {
    let mut points: Vec<Vec<f64>> = Vec::new();
    for end in region.profiles.iter().flat_map(|profile| &profile.ends) {
        let near = budget.difference.max(NEAR * distance(end, &region.minimum.point));
        let known = |point: &[f64]| distance(point, end) <= near;
        if !history.iter().any(|evaluated| known(&evaluated.point)) && !points.iter().any(|point| known(point)) {
            points.push(end.clone());
        }
    }
    let dimensions = region.profiles.len();
    let inside = |point: &[f64]| (0..dimensions).all(|k| within(point[k], region.profiles[k].interval));
    let present = history.iter().filter(|evaluated| inside(&evaluated.point)).count() + points.len();
    let lacking = Degree::Quadratic.points(dimensions).saturating_sub(present);
    // each round continues the sequence where the points so far would end it
    for point in sobol(present + lacking, dimensions, budget.seed).iter().skip(present) {
        let place = |k: usize| {
            let [from, to] = region.profiles[k].interval;
            from + point[k] * (to - from)
        };
        points.push((0..dimensions).map(place).collect());
    }
    points.retain(|point| !history.iter().any(|evaluated| evaluated.point == *point));
    points
}

fn within(value: f64, interval: [f64; 2]) -> bool {
    (interval[0]..=interval[1]).contains(&value)
}

/// Largest distance of an end of an interval from the minimum.
fn extent(region: &Region) -> f64 {
    let ends = region.profiles.iter().flat_map(|profile| &profile.ends);
    ends.map(|end| distance(end, &region.minimum.point)).fold(0.0, f64::max)
}

/// Euclidean distance.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::descent::{Smooth, descend};
    use super::super::search::{Method, search};
    use super::super::stand_in::{Curve, Slopes};
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use std::convert::Infallible;

    /// The curve from data that say less.
    struct Vague {
        curve: Curve,
        /// Standard uncertainty over that of the curve.
        vagueness: f64,
    }

    impl Evaluate for Vague {
        type Error = Infallible;
        fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
            Ok(points.iter().map(|u| Some(Smooth::residuals(self, u).as_slice().to_vec())).collect())
        }
    }

    impl Smooth for Vague {
        fn residuals(&self, point: &[f64]) -> DVector<f64> {
            DVector::from_vec(self.curve.at(point)) / self.vagueness
        }
        fn jacobian(&self, point: &[f64]) -> DMatrix<f64> {
            self.curve.jacobian(point) / self.vagueness
        }
    }

    /// The end of the interval of the model itself.
    fn exact(model: &Vague, k: usize, bound: f64) -> f64 {
        let rise = |value: f64| {
            let (mut lower, mut upper) = (vec![0.0; 3], vec![1.0; 3]);
            (lower[k], upper[k]) = (value, value);
            descend(model, &model.curve.truth, &lower, &upper).chi_squared
        };
        if rise(bound) <= 3.841_459 {
            return bound;
        }
        let (mut inside, mut outside) = (model.curve.truth[k], bound);
        for _ in 0..40 {
            let middle = 0.5 * (inside + outside);
            if rise(middle) > 3.841_459 { outside = middle } else { inside = middle }
        }
        inside
    }

    #[test]
    fn wide_intervals_are_those_of_the_model_itself() {
        for vagueness in [2.0, 4.0, 8.0] {
            let mut model = Vague { curve: Curve::new(), vagueness };
            let budget = Budget::default();
            let found = search(&mut model, &[0.5; 3], Method::TrustRegion, budget).unwrap();
            let first = Emulator::fit(&found.history, budget.difference).unwrap();
            let before = Region::new(&first, Uncertainties::AsStated);
            let searched = found.history.len();
            let explored = explore(&mut model, found.history, Uncertainties::AsStated, &budget).unwrap().unwrap();
            println!(
                "vagueness {vagueness}: {searched} + {} points, settled {}, leave-one-out {:.3?}",
                explored.history.len() - searched,
                explored.settled,
                explored.emulator.leave_one_out()
            );
            for k in 0..3 {
                let ends = [exact(&model, k, 0.0), exact(&model, k, 1.0)];
                let profile = &explored.region.profiles[k];
                println!("  {:.3?} then {:.3?}, exactly {ends:.3?}", before.profiles[k].interval, profile.interval);
                for (found, exact) in profile.interval.iter().zip(ends) {
                    assert!((found - exact).abs() < 0.15 * (ends[1] - ends[0]), "{found} is not {exact}");
                }
            }
        }
    }

    #[test]
    fn a_region_within_reach_needs_the_ends_of_its_axes_only() {
        let mut model = Slopes::new(3);
        let budget = Budget::default();
        let found = search(&mut model, &[0.5; 3], Method::TrustRegion, budget).unwrap();
        let count = found.history.len();
        let explored = explore(&mut model, found.history, Uncertainties::AsStated, &budget).unwrap().unwrap();
        assert!(explored.settled && explored.history.len() == count + 2 * explored.region.profiles.len());
    }

    #[test]
    fn the_budget_is_kept() {
        for evaluations in 0..6 {
            let mut model = Vague { curve: Curve::new(), vagueness: 8.0 };
            let found = search(&mut model, &[0.5; 3], Method::TrustRegion, Budget::default()).unwrap();
            let count = found.history.len();
            let budget = Budget { evaluations, ..Budget::default() };
            let explored = explore(&mut model, found.history, Uncertainties::AsStated, &budget).unwrap().unwrap();
            assert!(!explored.settled && explored.history.len() == count + evaluations);
        }
    }
}
