//! Derivatives of the residuals by differences: on one side, or both ways.

use super::{Budget, Halt, Recorder};
use crate::inference::Evaluate;
use nalgebra::{DMatrix, DVector};

/// A point with its residuals and χ².
#[derive(Clone)]
pub struct Iterate {
    pub(super) point: Vec<f64>,
    pub(super) residuals: DVector<f64>,
    pub(super) chi_squared: f64,
}

impl Iterate {
    /// A point with the residuals there.
    pub fn new(point: Vec<f64>, residuals: Vec<f64>) -> Self {
        let residuals = DVector::from_vec(residuals);
        let chi_squared = residuals.norm_squared();
        Self { point, residuals, chi_squared }
    }
}

/// The Jacobian from one batch of p points: forward, or backward at the upper bound. Where the model fails it is asked
/// on the other side, then at half the step; a coordinate along which all fail counts as without effect.
pub fn differences<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    here: &Iterate,
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

/// The Jacobian from steps both ways, in which the model's curvature cancels, and the place about which it was taken: the
/// lowest point found on the way, if one is lower. Where the model works on one side only, or a bound is there, the
/// difference is one-sided; where on neither, it is the one that was known.
pub(super) fn central_differences<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    mut here: Iterate,
    known: &DMatrix<f64>,
    budget: &Budget,
) -> Result<(DMatrix<f64>, Iterate), Halt<M::Error>> {
    let mut jacobian = known.clone();
    let shifted = |k: usize, step: f64| {
        let mut point = here.point.clone();
        point[k] = (point[k] + step).clamp(0.0, 1.0);
        point
    };
    let points: Vec<Vec<f64>> =
        (0..here.point.len()).flat_map(|k| [shifted(k, budget.difference), shifted(k, -budget.difference)]).collect();
    let results = recorder.residuals(&points)?;
    for k in 0..here.point.len() {
        let ends = [2 * k, 2 * k + 1].map(|place| match &results[place] {
            Some(residuals) => (points[place][k], DVector::from_column_slice(residuals)),
            None => (here.point[k], here.residuals.clone()),
        });
        let [(above, upper), (below, lower)] = ends;
        if above > below {
            jacobian.set_column(k, &((upper - lower) / (above - below)));
        }
    }
    let negligible = budget.negligible(here.chi_squared, here.residuals.len());
    for (point, residuals) in points.into_iter().zip(results) {
        let Some(residuals) = residuals else { continue };
        let there = Iterate::new(point, residuals);
        if here.chi_squared - there.chi_squared > negligible {
            here = there;
        }
    }
    Ok((jacobian, here))
}
