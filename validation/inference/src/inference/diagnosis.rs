//! Diagnosis of the data, their uncertainties and the model from the residuals at the best point and about it.

use super::Evaluated;
use crate::statistics::percentile;
use nalgebra::DMatrix;

/// Distance from the median in robust standard deviations from which on a residual is an outlier.
const OUTLYING: f64 = 4.0;

/// Data beyond the parameters below which a robust standard deviation means little.
const LEAST_FREEDOM: usize = 5;

/// Change of a residual that a step may hide `[-]`: a tenth of the way to the end of an interval.
const SMALL_STEP: f64 = 0.2;

/// Step of the model between two runs: a datum does not change at all, though by its slope it should.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelStep<'a> {
    /// Place of the datum.
    pub datum: usize,
    /// The runs, in the unit cube.
    pub points: [&'a [f64]; 2],
    /// Change of its residual that the derivatives at the minimum promise `[-]`.
    pub promised: f64,
}

/// The widest step between runs whose χ² is no more than `worst`; none where steps hide little.
pub fn widest_step<'a>(jacobian: &DMatrix<f64>, history: &'a [Evaluated], worst: f64) -> Option<ModelStep<'a>> {
    let is_near = |own: &&Evaluated| own.chi_squared.is_some_and(|chi_squared| chi_squared <= worst);
    let near: Vec<&Evaluated> = history.iter().filter(is_near).collect();
    let pairs =
        near.iter().enumerate().flat_map(|(place, first)| near[..place].iter().map(move |second| (first, second)));
    let steps = pairs.flat_map(|(first, second)| {
        let residuals = first.residuals.iter().flatten().zip(second.residuals.iter().flatten()).enumerate();
        let way = |k: usize| first.point[k] - second.point[k];
        residuals.filter(|(_, (one, other))| one == other).map(move |(datum, _)| ModelStep {
            datum,
            points: [&second.point, &first.point],
            promised: (0..first.point.len()).map(|k| jacobian[(datum, k)] * way(k)).sum::<f64>().abs(),
        })
    });
    steps.filter(|step| step.promised > SMALL_STEP).max_by(|a, b| a.promised.total_cmp(&b.promised))
}

/// Places of residuals farther from their median than four robust standard deviations, with that distance over one of
/// them; none with few data. The robust standard deviation is 1.4826 times the median distance from the median, enlarged
/// by 1 + 4/ν for ν data beyond the parameters: of few data the middle half is often close together by chance.
pub fn outliers(residuals: &[f64], parameters: usize) -> Vec<(usize, f64)> {
    let Some(freedom) = residuals.len().checked_sub(parameters).filter(|freedom| *freedom >= LEAST_FREEDOM) else {
        return Vec::new();
    };
    let centre = median(residuals.to_vec());
    let distances: Vec<f64> = residuals.iter().map(|residual| (residual - centre).abs()).collect();
    // a fit takes parameters' worth of scatter out of the residuals
    let fitted = (residuals.len() as f64 / freedom as f64).sqrt();
    let deviation = 1.4826 * median(distances.clone()) * fitted * (1.0 + 4.0 / freedom as f64);
    let beyond =
        |(place, distance): (usize, &f64)| (*distance > OUTLYING * deviation).then(|| (place, distance / deviation));
    distances.iter().enumerate().filter_map(beyond).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    percentile(&values, 0.5)
}
