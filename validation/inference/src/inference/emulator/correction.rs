//! Correction of the polynomials by their remainders at the evaluated points, interpolated by distance (kriging).
//!
//! The left-over of each residual counts as a random function of mean 0 whose values at a distance d correlate as
//! (1 + s + s²/3) exp(−s), s = √5 d/ℓ (Matérn, twice differentiable). Length ℓ and the share η of scatter, which no
//! neighbour predicts, are those with which the points predict each other best when each is left out. Where η is small,
//! the emulator passes through its points; far from all of them only the polynomial is left.
//!
//! Source: Rasmussen & Williams, "Gaussian processes for machine learning" (2006), equations 2.25, 4.17 and 5.12.

use nalgebra::{DMatrix, DVector};

/// Lengths ℓ over the root-mean-square distance of the points from the best.
const LENGTHS: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];

/// Shares η of scatter in the variance of what is left over.
const SCATTERS: [f64; 4] = [1e-8, 1e-3, 1e-1, 1.0];

/// Share of the polynomial's error to which it must come down to be worth its coefficients.
const WORTH: f64 = 0.5;

/// Largest number of points; the best ones are used, because more points cost much and add little near the best.
pub(super) const MOST_POINTS: usize = 100;

/// The random functions of all residuals: one row per point, one column per residual.
#[derive(Debug, Clone)]
pub struct KrigingCorrection {
    points: Vec<Vec<f64>>,
    length: f64,
    /// Coefficients of the correlations with each point.
    pub coefficients: DMatrix<f64>,
    /// Mean square of what a point that is left out is missed by, weighted, summed over the residuals.
    error: f64,
}

impl KrigingCorrection {
    /// The correction for what is left over (one row per point, the best first); none where it would not predict a point
    /// better than the polynomial alone, whose error is `error`.
    pub fn fit(points: &[&[f64]], left: &DMatrix<f64>, weights: &[f64], error: f64) -> Option<Self> {
        let count = points.len().min(MOST_POINTS);
        let points: Vec<Vec<f64>> = points[..count].iter().map(|point| point.to_vec()).collect();
        let left = left.rows(0, count).into_owned();
        let spread = points.iter().map(|point| squared_distance(point, &points[0])).sum::<f64>() / count as f64;
        let choices = LENGTHS.iter().flat_map(|length| SCATTERS.iter().map(move |scatter| (*length, *scatter)));
        let tried = choices
            .filter_map(|(length, scatter)| Self::with(&points, &left, weights, length * spread.sqrt(), scatter));
        // the first of equals, so that nothing hangs on rounding
        let best = tried.reduce(|best, other| if other.error < best.error { other } else { best })?;
        (best.error < WORTH * error).then_some(best)
    }

    fn with(points: &[Vec<f64>], left: &DMatrix<f64>, weights: &[f64], length: f64, scatter: f64) -> Option<Self> {
        let count = points.len();
        let matrix = DMatrix::from_fn(count, count, |row, column| {
            let same = if row == column { scatter } else { 0.0 };
            same + correlation(squared_distance(&points[row], &points[column]).sqrt() / length)
        });
        let inverse = matrix.cholesky()?.inverse();
        let coefficients = &inverse * left;
        let (mut sum, mut weight) = (0.0, 0.0);
        for row in 0..count {
            let square = weights[row] * weights[row];
            let variance = inverse[(row, row)] * inverse[(row, row)];
            sum += square * coefficients.row(row).norm_squared() / variance;
            weight += square;
        }
        let error = sum / weight;
        error.is_finite().then(|| Self { points: points.to_vec(), length, coefficients, error })
    }

    /// Number of points that the correction interpolates.
    pub(super) fn len(&self) -> usize {
        self.points.len()
    }

    /// Root-mean-square error of a residual at a point that is left out `[-]`.
    pub(super) fn leave_one_out(&self) -> f64 {
        (self.error / self.coefficients.ncols().max(1) as f64).sqrt()
    }

    /// Correlation with each point.
    pub fn basis(&self, place: &[f64]) -> DVector<f64> {
        let of = |point: &Vec<f64>| correlation(squared_distance(point, place).sqrt() / self.length);
        DVector::from_iterator(self.len(), self.points.iter().map(of))
    }

    /// Derivatives of the basis (rows) by the coordinates (columns).
    pub fn slopes(&self, place: &[f64]) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(self.len(), place.len());
        for (row, point) in self.points.iter().enumerate() {
            let s = (5.0 * squared_distance(point, place)).sqrt() / self.length;
            // d/dx of (1 + s + s²/3) exp(−s) is −(s/3)(1 + s) exp(−s) ds/dx, and s ds/dx = 5 (x − x_i)/ℓ²
            let factor = -5.0 / (3.0 * self.length * self.length) * (1.0 + s) * libm::exp(-s);
            for k in 0..place.len() {
                slopes[(row, k)] = factor * (place[k] - point[k]);
            }
        }
        slopes
    }
}

/// Correlation at a distance over the length.
fn correlation(distance: f64) -> f64 {
    let s = 5.0_f64.sqrt() * distance;
    (1.0 + s + s * s / 3.0) * libm::exp(-s)
}

fn squared_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}
