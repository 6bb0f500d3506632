//! Gauss–Newton steps in a trust region inside the unit cube.
//!
//! The model r(u + s) ≈ r + J s is trusted for |s_k| ≤ Δ. With the cube this makes a box, in which |r + J s|² is
//! minimised exactly. J comes from one batch of differences; after every further evaluation it is corrected by
//! Broyden's rank-one update, and taken anew only where its prediction fails.
//!
//! The crate `argmin` has such a method (with Steihaug's steps), but it takes p differences at every accepted point,
//! never stops of itself and knows no bounds: a transformation of the cube makes JᵀJ singular where the minimum lies
//! on a face, the normal case of a parameter that the data do not determine. Measured on fits of three parameters it
//! comes within 0.1 of the least χ² after 9 to 21 evaluations, this after 6 to 21: a third fewer from most starts, a
//! fifth more from one.
//!
//! Source: Nocedal & Wright, "Numerical Optimization", 2nd ed. (2006), chapters 4 and 11 (Broyden's update: 11.17).

use super::{Budget, Halt, Recorder, Stopped};
use crate::inference::box_least_squares::box_least_squares;
use crate::inference::{Emulator, Evaluate, chi_squared};
use nalgebra::{DMatrix, DVector};

/// First Δ, in the unit cube.
const FIRST_RADIUS: f64 = 0.25;

/// Δ below this share of a difference means that χ² does not follow its slope.
const LEAST_RADIUS: f64 = 0.01;

/// Share of the predicted fall of χ² below which the prediction has failed.
const POOR: f64 = 0.25;

/// Share of the predicted fall above which Δ may grow.
const GOOD: f64 = 0.75;

/// Evaluations at the minimum of the emulator, at last.
const MOST_POLISHES: usize = 3;

/// A point with its residuals and χ².
struct Place {
    point: Vec<f64>,
    residuals: DVector<f64>,
    chi_squared: f64,
}

impl Place {
    fn new(point: Vec<f64>, residuals: Vec<f64>) -> Self {
        let residuals = DVector::from_vec(residuals);
        let chi_squared = residuals.norm_squared();
        Self { point, residuals, chi_squared }
    }
}

/// Descends from `start` until no step is worth an evaluation.
pub(super) fn run<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    start: &[f64],
    budget: &Budget,
) -> Result<Stopped, Halt<M::Error>> {
    let (point, residuals) = recorder.working_start(start, budget.seed)?;
    let mut here = Place::new(point, residuals);
    let mut jacobian = differences(recorder, &here, budget.difference)?;
    // where the differences were taken last
    let mut origin = here.point.clone();
    let mut radius = FIRST_RADIUS;
    let mut failures = 0;
    loop {
        let step = box_step(&here, &jacobian, radius);
        let predicted = here.chi_squared - (&here.residuals + &jacobian * &step).norm_squared();
        let negligible = predicted <= budget.negligible(here.chi_squared, here.residuals.len());
        let short = radius < LEAST_RADIUS * budget.difference;
        if negligible || short {
            // differences from nearby, corrected since, will do to confirm a minimum, but not to give one up
            let near = if short { 0.0 } else { budget.difference };
            if distance(&origin, &here.point) > near {
                jacobian = differences(recorder, &here, budget.difference)?;
                origin.clone_from(&here.point);
                radius = radius.max(budget.difference);
                continue;
            }
            return polish(recorder, budget);
        }

        let trial: Vec<f64> = here.point.iter().zip(step.iter()).map(|(u, s)| (u + s).clamp(0.0, 1.0)).collect();
        let length = step.amax();
        let Some(residuals) = recorder.residuals_at(&trial)? else {
            radius = 0.25 * length;
            continue;
        };
        let there = Place::new(trial, residuals);
        let gain = (here.chi_squared - there.chi_squared) / predicted;
        let miss = &there.residuals - &here.residuals - &jacobian * &step;
        jacobian += miss * step.transpose() / step.norm_squared();
        if gain < POOR {
            radius = 0.25 * length;
        } else if gain > GOOD && length > 0.99 * radius {
            radius = (2.0 * radius).min(1.0);
        }
        if gain > 0.0 {
            here = there;
        }
        failures = if gain < POOR { failures + 1 } else { 0 };
        let moved = distance(&origin, &here.point);
        if failures > 0 && (moved > budget.difference || failures > 1 && moved > 0.0) {
            failures = 0;
            jacobian = differences(recorder, &here, budget.difference)?;
            origin.clone_from(&here.point);
        }
    }
}

/// Tries the minimum of the emulator of all evaluations, which knows curvature where differences do not, until that is
/// as good as the best point.
fn polish<M: Evaluate>(recorder: &mut Recorder<'_, M>, budget: &Budget) -> Result<Stopped, Halt<M::Error>> {
    for _ in 0..MOST_POLISHES {
        let (Some(emulator), Some((_, least))) =
            (Emulator::fit(recorder.history(), budget.difference), recorder.best())
        else {
            break;
        };
        let minimum = emulator.minimum();
        let negligible = budget.negligible(least, emulator.data());
        if least - minimum.chi_squared <= negligible {
            return Ok(Stopped::Converged);
        }
        let residuals = recorder.residuals_at(&minimum.point)?;
        if residuals.is_some_and(|residuals| (chi_squared(&residuals) - least).abs() <= negligible) {
            return Ok(Stopped::Converged);
        }
    }
    Ok(Stopped::Stalled)
}

/// The step of least predicted χ² within the radius and the cube.
fn box_step(here: &Place, jacobian: &DMatrix<f64>, radius: f64) -> DVector<f64> {
    let lower: Vec<f64> = here.point.iter().map(|u| (-u).max(-radius)).collect();
    let upper: Vec<f64> = here.point.iter().map(|u| (1.0 - u).min(radius)).collect();
    box_least_squares(jacobian, &-&here.residuals, &lower, &upper)
}

/// Largest difference of a coordinate.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The Jacobian from one batch of p points: forward, or backward at the upper bound. Where the model fails it is asked
/// on the other side, then at half the step; a coordinate along which all fail counts as without effect.
fn differences<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    here: &Place,
    difference: f64,
) -> Result<DMatrix<f64>, Halt<M::Error>> {
    let count = here.point.len();
    let mut jacobian = DMatrix::zeros(here.residuals.len(), count);
    let mut missing: Vec<usize> = (0..count).collect();
    for step in [difference, -difference, 0.5 * difference, -0.5 * difference] {
        let shifted = |k: usize| {
            let mut point = here.point.clone();
            let forward = if difference > 1.0 - point[k] { -step } else { step };
            point[k] += forward;
            point
        };
        let tried: Vec<usize> = missing.iter().copied().filter(|k| (0.0..=1.0).contains(&shifted(*k)[*k])).collect();
        let points: Vec<Vec<f64>> = tried.iter().map(|k| shifted(*k)).collect();
        for ((k, point), residuals) in tried.iter().zip(&points).zip(recorder.residuals(&points)?) {
            if let Some(residuals) = residuals {
                let change = DVector::from_vec(residuals) - &here.residuals;
                jacobian.set_column(*k, &(change / (point[*k] - here.point[*k])));
                missing.retain(|other| other != k);
            }
        }
        if missing.is_empty() {
            break;
        }
    }
    Ok(jacobian)
}

#[cfg(test)]
mod tests {
    use super::super::super::stand_in::{Curve, Failing};
    use super::super::{Method, search};
    use super::*;
    use std::convert::Infallible;

    /// r = u − target, whose target may lie outside the cube.
    struct Linear(Vec<f64>);

    impl Evaluate for Linear {
        type Error = Infallible;
        fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
            let one = |u: &Vec<f64>| u.iter().zip(&self.0).map(|(u, t)| 100.0 * (u - t)).collect();
            Ok(points.iter().map(|u| Some(one(u))).collect())
        }
    }

    #[test]
    fn a_minimum_on_a_face_is_reached() {
        let found = search(&mut Linear(vec![1.3, 0.4]), &[0.5, 0.5], Method::TrustRegion, Budget::default()).unwrap();
        assert_eq!(found.best[0], 1.0);
        assert!((found.best[1] - 0.4).abs() < 1e-12 && found.stopped == Stopped::Converged);
        assert!(found.history.len() <= 12, "{}", found.history.len());
    }

    #[test]
    fn a_linear_model_takes_one_step_once_it_is_in_reach() {
        let found = search(&mut Linear(vec![0.6, 0.4]), &[0.5, 0.5], Method::TrustRegion, Budget::default()).unwrap();
        // the start, two differences, the minimum, and two differences there
        assert!(found.history.len() <= 6 && found.chi_squared < 1e-15, "{found:?}");
    }

    #[test]
    fn differences_stay_inside_the_cube_and_out_of_failures() {
        let mut model = Failing { curve: Curve::new(), beyond: 0.5 };
        let mut recorder = Recorder::new(&mut model, 99);
        let point = vec![0.49, 1.0, 0.0];
        let residuals = recorder.residuals_at(&point).unwrap().unwrap();
        let jacobian = differences(&mut recorder, &Place::new(point, residuals), 0.02).unwrap();
        let asked: Vec<Vec<f64>> = recorder.history().iter().map(|evaluated| evaluated.point.clone()).collect();
        assert_eq!(asked[2], [0.49, 0.98, 0.0]);
        assert_eq!(asked[3], [0.49, 1.0, 0.02]);
        assert_eq!(asked[4], [0.47, 1.0, 0.0]);
        let exact = Curve::new().jacobian(&[0.49, 1.0, 0.0]);
        for k in 0..3 {
            assert!((jacobian.column(k) - exact.column(k)).norm() < 0.05 * exact.column(k).norm(), "{k}");
        }
    }
}
