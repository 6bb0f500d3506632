//! A polynomial for every residual through the evaluated points, most faithful at the best of them, corrected for what it
//! misses at each.
//!
//! With t = (u − u_best)/δ a residual is c_0 + Σ c_k t_k, and with points enough + Σ_{k ≤ l} c_kl t_k t_l. What a
//! polynomial of degree m leaves out grows as |t|^(m + 1), so the points are weighted by 1/(1 + |t|^(m + 1)): those
//! within δ, the distance of just enough neighbours, count almost fully, and the first guesses of a search hardly at
//! all; large residuals need to be right in proportion only. What is left over at the points is carried between them by a
//! correction, where that predicts them better.

pub(crate) mod correction;
mod polynomial;

use super::box_least_squares::least_squares;
use super::descent::{LocalMinimum, Smooth, descend};
use super::search::Evaluated;
use correction::KrigingCorrection;
use nalgebra::{DMatrix, DVector};
use polynomial::{basis, local};

pub use polynomial::Degree;

/// Residuals above this need only be right in proportion.
const ROUGH: f64 = 10.0;

/// Mean square of the residuals above which a point is too far from all data to tell anything.
const HOPELESS: f64 = 1e6;

/// Other starts of the descent to the minimum, the best evaluated points.
const STARTS: usize = 8;

/// The polynomials.
#[derive(Debug, Clone)]
pub struct Emulator {
    /// The degree of the polynomials.
    pub degree: Degree,
    /// The best evaluated point.
    centre: Vec<f64>,
    /// δ in the unit cube.
    scale: f64,
    /// Correction for the remainder of the polynomials.
    correction: Option<KrigingCorrection>,
    /// One row a residual, one column a coefficient, those of the correction last.
    coefficients: DMatrix<f64>,
    /// The same χ² with as many rows as columns at most.
    compact: DMatrix<f64>,
    /// All evaluated points, the best first.
    points: Vec<Vec<f64>>,
    /// Root-mean-square error `[-]`, in standard uncertainties of a datum, with which the emulator predicts a point
    /// that it has not seen, weighted as the points are; none where there is no point to spare.
    pub leave_one_out: Option<f64>,
}

impl Emulator {
    /// The emulator of the points at which the model worked; none where they are fewer than the coordinates + 1.
    /// Differences of the model over less than `resolution` of the unit cube are not trusted.
    pub fn fit(history: &[Evaluated], resolution: f64) -> Option<Self> {
        let mut points: Vec<(&[f64], &[f64], f64)> = history
            .iter()
            .filter_map(|evaluated| Some((&*evaluated.point, evaluated.residuals.as_deref()?, evaluated.chi_squared?)))
            .collect();
        points.sort_by(|a, b| a.2.total_cmp(&b.2));
        let least = points.first()?.2;
        points.retain(|(_, residuals, chi_squared)| *chi_squared <= least + HOPELESS * residuals.len() as f64);
        let dimensions = points.first()?.0.len();
        if points.len() < Degree::Linear.points(dimensions) {
            return None;
        }
        let quadratic = points.len() >= Degree::Quadratic.points(dimensions);
        let degree = if quadratic { Degree::Quadratic } else { Degree::Linear };
        Some(Self::with_degree(&points, degree, resolution))
    }

    /// The emulator of a degree; the points are sorted, the best first.
    fn with_degree(points: &[(&[f64], &[f64], f64)], degree: Degree, resolution: f64) -> Self {
        let centre = points[0].0.to_vec();
        let distances: Vec<f64> = points.iter().map(|(point, _, _)| distance(point, &centre)).collect();
        let mut sorted = distances.clone();
        sorted.sort_by(f64::total_cmp);
        let scale = sorted[(degree.coefficients(centre.len()) - 1).min(sorted.len() - 1)].max(resolution);
        let data = points[0].1.len().max(1) as f64;
        let weight = |(d, (_, _, chi_squared)): (&f64, &(&[f64], &[f64], f64))| {
            1.0 / (1.0 + degree.remainder(d / scale)) / (1.0 + (chi_squared / data).sqrt() / ROUGH)
        };
        let weights: Vec<f64> = distances.iter().zip(points).map(weight).collect();

        let columns = degree.coefficients(centre.len());
        let mut matrix = DMatrix::zeros(points.len(), columns);
        let mut right = DMatrix::zeros(points.len(), points[0].1.len());
        for (row, ((point, residuals, _), weight)) in points.iter().zip(&weights).enumerate() {
            matrix.set_row(row, &(basis(degree, &local(point, &centre, scale)) * *weight).transpose());
            right.set_row(row, &(DVector::from_column_slice(residuals) * *weight).transpose());
        }
        let solution = least_squares(matrix.clone(), &right);
        let leave_one_out = leave_one_out(&matrix, &right, &solution, &weights);
        let mut left = right - matrix * &solution;
        for (row, weight) in weights.iter().enumerate() {
            left.row_mut(row).unscale_mut(*weight);
        }
        let places: Vec<&[f64]> = points.iter().map(|(point, _, _)| *point).collect();
        let data = left.ncols() as f64;
        // without a point to spare the polynomial passes through all of them
        let correction =
            leave_one_out.and_then(|error| KrigingCorrection::fit(&places, &left, &weights, data * error * error));
        let known = correction.as_ref().map_or(0, KrigingCorrection::len);
        let mut coefficients = solution.transpose().resize_horizontally(columns + known, 0.0);
        if let Some(correction) = &correction {
            coefficients.columns_mut(columns, known).copy_from(&correction.coefficients.transpose());
        }
        let compact = compact(&coefficients);
        let leave_one_out = correction.as_ref().map_or(leave_one_out, |correction| Some(correction.leave_one_out()));
        let points = points.iter().map(|(point, _, _)| point.to_vec()).collect();
        Self { degree, centre, scale, correction, coefficients, compact, points, leave_one_out }
    }

    /// Emulator without interpolation of residuals, for runs that scatter randomly.
    pub fn polynomials(mut self) -> Self {
        let known = self.degree.coefficients(self.dimensions());
        self.coefficients = self.coefficients.columns(0, known).into_owned();
        self.compact = compact(&self.coefficients);
        self.correction = None;
        self
    }

    /// Number of parameters.
    pub fn dimensions(&self) -> usize {
        self.centre.len()
    }

    /// Number of residuals.
    pub fn data(&self) -> usize {
        self.coefficients.nrows()
    }

    /// Weighted residuals `[-]` at a point.
    pub fn predict(&self, point: &[f64]) -> Vec<f64> {
        (&self.coefficients * self.basis(point)).as_slice().to_vec()
    }

    /// χ² at a point `[-]`.
    pub fn chi_squared(&self, point: &[f64]) -> f64 {
        Smooth::residuals(self, point).norm_squared()
    }

    /// Derivatives of the weighted residuals (rows) by the coordinates (columns).
    pub fn jacobian(&self, point: &[f64]) -> DMatrix<f64> {
        &self.coefficients * self.slopes(point)
    }

    /// The least χ² in the cube: downhill from the best point, or from another of the best evaluated points if what
    /// lies below it is lower still and supported by a point nearby.
    pub fn minimum(&self) -> LocalMinimum {
        let mut best = self.minimum_near(&self.centre);
        for start in self.points.iter().take(STARTS) {
            let other = self.minimum_near(start);
            if self.supports(&other.point) && other.chi_squared < best.chi_squared - 1e-9 * (1.0 + best.chi_squared) {
                best = other;
            }
        }
        best
    }

    /// Evaluated points whose χ² on the emulator is at most a value, the best first.
    pub fn below(&self, chi_squared: f64) -> Vec<Vec<f64>> {
        self.points.iter().filter(|point| self.chi_squared(point) <= chi_squared).cloned().collect()
    }

    /// The minimum downhill of a point.
    pub fn minimum_near(&self, start: &[f64]) -> LocalMinimum {
        descend(self, start, &vec![0.0; self.dimensions()], &vec![1.0; self.dimensions()])
    }

    /// Whether a point at which the model worked lies near, no farther than the scale of the emulator.
    pub fn supports(&self, point: &[f64]) -> bool {
        self.points.iter().any(|evaluated| distance(evaluated, point) <= self.scale)
    }

    fn basis(&self, point: &[f64]) -> DVector<f64> {
        let polynomial = basis(self.degree, &local(point, &self.centre, self.scale));
        let Some(correction) = &self.correction else { return polynomial };
        let mut both = polynomial.clone().resize_vertically(self.coefficients.ncols(), 0.0);
        both.rows_mut(polynomial.len(), correction.len()).copy_from(&correction.basis(point));
        both
    }

    /// Derivatives of the basis (rows) by the coordinates (columns).
    fn slopes(&self, point: &[f64]) -> DMatrix<f64> {
        let t = local(point, &self.centre, self.scale);
        let mut slopes = DMatrix::zeros(self.coefficients.ncols(), t.len());
        for k in 0..t.len() {
            slopes[(1 + k, k)] = 1.0;
        }
        if self.degree == Degree::Quadratic {
            let mut row = 1 + t.len();
            for k in 0..t.len() {
                for l in k..t.len() {
                    slopes[(row, k)] += t[l];
                    slopes[(row, l)] += t[k];
                    row += 1;
                }
            }
        }
        slopes /= self.scale;
        if let Some(correction) = &self.correction {
            let first = self.coefficients.ncols() - correction.len();
            slopes.rows_mut(first, correction.len()).copy_from(&correction.slopes(point));
        }
        slopes
    }
}

/// Rows of the same norm at every point, as many as columns at most.
fn compact(coefficients: &DMatrix<f64>) -> DMatrix<f64> {
    let many = coefficients.nrows() > coefficients.ncols();
    if many { coefficients.clone().qr().r() } else { coefficients.clone() }
}

impl Smooth for Emulator {
    fn residuals(&self, point: &[f64]) -> DVector<f64> {
        &self.compact * self.basis(point)
    }

    fn jacobian(&self, point: &[f64]) -> DMatrix<f64> {
        &self.compact * self.slopes(point)
    }
}

/// Euclidean distance.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The weighted error of each point as predicted by the others, from the leverages of the one fit.
fn leave_one_out(matrix: &DMatrix<f64>, right: &DMatrix<f64>, solution: &DMatrix<f64>, weights: &[f64]) -> Option<f64> {
    let inverse = matrix.clone().pseudo_inverse(1e-10 * matrix.norm()).ok()?;
    let left = right - matrix * solution;
    let (mut sum, mut weight) = (0.0, 0.0);
    for row in 0..matrix.nrows() {
        let freedom = 1.0 - (matrix.row(row) * inverse.column(row))[0];
        // a point that alone determines a coefficient cannot be predicted by the others
        if freedom > 1e-6 {
            sum += left.row(row).norm_squared() / (freedom * freedom);
            weight += weights[row] * weights[row];
        }
    }
    (weight > 0.0).then(|| (sum / weight / right.ncols() as f64).sqrt())
}
