//! Nelder and Mead's simplex (Comput. J. 7, 308, 1965), mirrored at the faces of the cube.
//!
//! The points of the first simplex are evaluated in one batch, all others one after another. A point at which the model
//! fails counts as infinitely bad. The crate that offers this search brings a second generation of random numbers and an
//! unmaintained macro crate along, and panics where a first evaluation fails.

use super::{Budget, Halt, Recorder, Stopped};
use crate::inference::{Evaluate, chi_squared};

/// Edge of the first simplex in the unit cube.
const FIRST_EDGE: f64 = 0.1;

/// How far the mirror image of the worst corner is moved from the centroid of the others, in units of the worst
/// corner's distance; negative on the worst corner's own side.
const REFLECTION: f64 = 1.0;
const EXPANSION: f64 = 2.0;
const OUTSIDE: f64 = 0.5;
const INSIDE: f64 = -0.5;

/// What remains of every edge when the simplex shrinks towards its best corner.
const SHRINKAGE: f64 = 0.5;

/// A point and its χ².
type Corner = (Vec<f64>, f64);

/// Shrinks a simplex around the minimum until the standard deviation of its χ² is below the tolerance.
pub(super) fn run<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    start: &[f64],
    budget: &Budget,
) -> Result<Stopped, Halt<M::Error>> {
    let (start, _) = recorder.working_start(start, budget.seed)?;
    let mut corners = vec![start.clone()];
    for k in 0..start.len() {
        let mut corner = start.clone();
        corner[k] += if start[k] + FIRST_EDGE <= 1.0 { FIRST_EDGE } else { -FIRST_EDGE };
        corners.push(corner);
    }
    let values = recorder.residuals(&corners)?.into_iter().map(as_cost);
    let mut simplex: Vec<Corner> = corners.iter().cloned().zip(values).collect();
    sort(&mut simplex);
    // points that are mirrored onto known ones cost nothing, so that evaluations alone do not bound the loop
    for _ in 0..20 * budget.evaluations {
        if deviation(&simplex) < budget.tolerance {
            return Ok(Stopped::Converged);
        }
        advance(&mut simplex, |point| Ok(as_cost(recorder.residuals_at(&mirrored(point))?)))?;
        sort(&mut simplex);
    }
    Ok(Stopped::Stalled)
}

/// χ² of some residuals; infinite where the model fails.
fn as_cost(residuals: Option<Vec<f64>>) -> f64 {
    residuals.map_or(f64::INFINITY, |residuals| chi_squared(&residuals))
}

/// The best corner first.
fn sort(simplex: &mut [Corner]) {
    simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
}

/// Replaces the worst corner of a sorted simplex by a better point on the line through it and the centroid of the others,
/// or, where there is none, shrinks the simplex towards its best corner.
fn advance<E>(simplex: &mut [Corner], mut cost: impl FnMut(&[f64]) -> Result<f64, E>) -> Result<(), E> {
    let [others @ .., (worst, worst_cost)] = simplex else { return Ok(()) };
    let (best_cost, second_worst_cost) = (others[0].1, others[others.len() - 1].1);
    let share = 1.0 / others.len() as f64;
    let centroid: Vec<f64> =
        (0..worst.len()).map(|k| others.iter().map(|(point, _)| point[k]).sum::<f64>() * share).collect();
    let mut at = |way: f64| -> Result<Corner, E> {
        let point: Vec<f64> =
            centroid.iter().zip(&*worst).map(|(centre, worst)| centre + way * (centre - worst)).collect();
        let value = cost(&point)?;
        Ok((point, value))
    };

    let reflected = at(REFLECTION)?;
    let better = if reflected.1 < best_cost {
        let expanded = at(EXPANSION)?;
        Some(if expanded.1 < reflected.1 { expanded } else { reflected })
    } else if reflected.1 < second_worst_cost {
        Some(reflected)
    } else if reflected.1 < *worst_cost {
        Some(at(OUTSIDE)?).filter(|contracted| contracted.1 <= reflected.1)
    } else {
        Some(at(INSIDE)?).filter(|contracted| contracted.1 < *worst_cost)
    };
    if let Some(better) = better {
        (*worst, *worst_cost) = better;
        return Ok(());
    }
    let best = others[0].0.clone();
    for (point, value) in &mut simplex[1..] {
        for (u, best) in point.iter_mut().zip(&best) {
            *u = best + SHRINKAGE * (*u - best);
        }
        *value = cost(point)?;
    }
    Ok(())
}

/// Standard deviation of the simplex's χ² as a sample; infinite while a corner fails.
fn deviation(simplex: &[Corner]) -> f64 {
    let count = simplex.len() as f64;
    let mean = simplex.iter().map(|corner| corner.1).sum::<f64>() / count;
    let squares: f64 = simplex.iter().map(|corner| (corner.1 - mean) * (corner.1 - mean)).sum();
    let deviation = (squares / (count - 1.0)).sqrt();
    if deviation.is_finite() { deviation } else { f64::INFINITY }
}

/// The point with every coordinate reflected into the cube.
pub(super) fn mirrored(point: &[f64]) -> Vec<f64> {
    point
        .iter()
        .map(|u| {
            let folded = u.rem_euclid(2.0);
            if folded > 1.0 { 2.0 - folded } else { folded }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::super::stand_in::RosenbrockModel;
    use super::super::{Method, search};
    use super::*;

    #[test]
    fn points_outside_are_reflected() {
        let inside = mirrored(&[-0.25, 0.5, 1.25, 2.25, -1.25]);
        assert_eq!(inside, [0.25, 0.5, 0.75, 0.25, 0.75]);
    }

    #[test]
    fn each_of_its_moves_is_made_where_it_is_due() {
        // the worst corner is (0, 1), the centroid of the others (0.5, 0), the mirror image (1, -1)
        let corners = || vec![(vec![0.0, 0.0], 1.0), (vec![1.0, 0.0], 2.0), (vec![0.0, 1.0], 3.0)];
        let moved = |costs: &[f64]| {
            let (mut simplex, mut costs) = (corners(), costs.iter());
            advance::<()>(&mut simplex, |_| Ok(*costs.next().expect("a cost for every evaluation"))).unwrap();
            assert_eq!(costs.next(), None, "every cost was asked for");
            simplex
        };
        assert_eq!(moved(&[1.5])[2], (vec![1.0, -1.0], 1.5), "reflection");
        assert_eq!(moved(&[0.5, 0.4])[2], (vec![1.5, -2.0], 0.4), "expansion");
        assert_eq!(moved(&[0.5, 0.6])[2], (vec![1.0, -1.0], 0.5), "an expansion too far");
        assert_eq!(moved(&[2.5, 2.4])[2], (vec![0.75, -0.5], 2.4), "contraction outside");
        assert_eq!(moved(&[f64::INFINITY, 2.4])[2], (vec![0.25, 0.5], 2.4), "contraction inside");
        let shrunk = [(vec![0.0, 0.0], 1.0), (vec![0.5, 0.0], 7.0), (vec![0.0, 0.5], 8.0)];
        assert_eq!(moved(&[9.0, 9.0, 7.0, 8.0]), shrunk, "shrinkage");
    }

    #[test]
    fn it_converges_by_itself() {
        let budget = Budget { evaluations: 1000, ..Budget::default() };
        let found = search(&mut RosenbrockModel, &[0.5, 0.5], Method::NelderMead, budget).unwrap();
        assert_eq!(found.stopped, Stopped::Converged);
        assert!(found.chi_squared < 0.02 && found.history.len() < 100, "{}", found.history.len());
    }
}
