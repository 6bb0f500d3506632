//! A polynomial for every residual through the evaluated points, most faithful at the best of them.
//!
//! With t = (u − u_best)/δ a residual is c_0 + Σ c_k t_k, and with points enough + Σ_{k ≤ l} c_kl t_k t_l. What a
//! polynomial of degree m leaves out grows as |t|^(m + 1), so the points are weighted by 1/(1 + |t|^(m + 1)): those
//! within δ, the distance of just enough neighbours, count almost fully, and the first guesses of a search hardly at
//! all.

use super::box_least_squares::least_squares;
use super::descent::{Bottom, Smooth, descend};
use super::search::Evaluated;
use nalgebra::{DMatrix, DVector};

/// Quadratic from this many points per coefficient on.
const POINTS_PER_COEFFICIENT: f64 = 1.5;

/// Other starts of the descent to the minimum, the best evaluated points.
const STARTS: usize = 8;

/// Degree of the polynomials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Degree {
    /// Constant and slopes.
    Linear,
    /// With all squares and products.
    Quadratic,
}

impl Degree {
    /// Coefficients of a polynomial of this degree.
    fn coefficients(self, dimensions: usize) -> usize {
        match self {
            Self::Linear => dimensions + 1,
            Self::Quadratic => (dimensions + 1) * (dimensions + 2) / 2,
        }
    }

    /// Points from which on a polynomial of this degree is fitted.
    pub(super) fn points(self, dimensions: usize) -> usize {
        match self {
            Self::Linear => self.coefficients(dimensions),
            Self::Quadratic => (POINTS_PER_COEFFICIENT * self.coefficients(dimensions) as f64).ceil() as usize,
        }
    }

    /// How the terms that it leaves out grow with |t|.
    fn remainder(self, t: f64) -> f64 {
        match self {
            Self::Linear => t * t,
            Self::Quadratic => t * t * t,
        }
    }
}

/// A minimum of the emulator.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// The point in the unit cube.
    pub point: Vec<f64>,
    /// χ² of the emulator there `[-]`.
    pub chi_squared: f64,
}

/// The polynomials.
#[derive(Debug, Clone)]
pub struct Emulator {
    degree: Degree,
    /// The best evaluated point.
    centre: Vec<f64>,
    /// δ in the unit cube.
    scale: f64,
    /// One row a residual, one column a coefficient.
    coefficients: DMatrix<f64>,
    /// The same χ² with as many rows as columns at most.
    compact: DMatrix<f64>,
    /// All evaluated points, the best first.
    points: Vec<Vec<f64>>,
    leave_one_out: Option<f64>,
}

impl Emulator {
    /// The emulator of the points at which the model worked; none where they are fewer than the coordinates + 1.
    /// Differences of the model over less than `resolution` of the unit cube are not trusted.
    #[must_use]
    pub fn fit(history: &[Evaluated], resolution: f64) -> Option<Self> {
        let mut points: Vec<(&[f64], &[f64], f64)> = history
            .iter()
            .filter_map(|evaluated| Some((&*evaluated.point, evaluated.residuals.as_deref()?, evaluated.chi_squared?)))
            .collect();
        points.sort_by(|a, b| a.2.total_cmp(&b.2));
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
        let weights: Vec<f64> = distances.iter().map(|d| 1.0 / (1.0 + degree.remainder(d / scale))).collect();

        let columns = degree.coefficients(centre.len());
        let mut matrix = DMatrix::zeros(points.len(), columns);
        let mut right = DMatrix::zeros(points.len(), points[0].1.len());
        for (row, ((point, residuals, _), weight)) in points.iter().zip(&weights).enumerate() {
            matrix.set_row(row, &(basis(degree, &local(point, &centre, scale)) * *weight).transpose());
            right.set_row(row, &(DVector::from_column_slice(residuals) * *weight).transpose());
        }
        let solution = least_squares(matrix.clone(), &right);
        let leave_one_out = leave_one_out(&matrix, &right, &solution, &weights);
        let coefficients = solution.transpose();
        let compact = if coefficients.nrows() > columns { coefficients.clone().qr().r() } else { coefficients.clone() };
        let points = points.iter().map(|(point, _, _)| point.to_vec()).collect();
        Self { degree, centre, scale, coefficients, compact, points, leave_one_out }
    }

    /// The degree of the polynomials.
    #[must_use]
    pub fn degree(&self) -> Degree {
        self.degree
    }

    /// Number of parameters.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.centre.len()
    }

    /// Number of residuals.
    #[must_use]
    pub fn data(&self) -> usize {
        self.coefficients.nrows()
    }

    /// The best evaluated point, about which the emulator is most faithful.
    #[must_use]
    pub fn centre(&self) -> &[f64] {
        &self.centre
    }

    /// Distance from the centre within which lie just enough points for the coefficients, in the unit cube.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Root-mean-square error `[-]`, in standard uncertainties of a datum, with which the emulator predicts a point
    /// that it has not seen, weighted as the points are; none where there is no point to spare.
    #[must_use]
    pub fn leave_one_out(&self) -> Option<f64> {
        self.leave_one_out
    }

    /// Weighted residuals `[-]` at a point.
    #[must_use]
    pub fn predict(&self, point: &[f64]) -> Vec<f64> {
        (&self.coefficients * self.basis(point)).as_slice().to_vec()
    }

    /// χ² at a point `[-]`.
    #[must_use]
    pub fn chi_squared(&self, point: &[f64]) -> f64 {
        Smooth::residuals(self, point).norm_squared()
    }

    /// Derivatives of the weighted residuals (rows) by the coordinates (columns).
    #[must_use]
    pub fn jacobian(&self, point: &[f64]) -> DMatrix<f64> {
        &self.coefficients * self.slopes(point)
    }

    /// The least χ² in the cube: downhill from the best point, or from another of the best evaluated points if what
    /// lies below it is lower still and supported by a point nearby.
    #[must_use]
    pub fn minimum(&self) -> Minimum {
        let (lower, upper) = (vec![0.0; self.dimensions()], vec![1.0; self.dimensions()]);
        let mut best = descend(self, &self.centre, &lower, &upper);
        for start in self.points.iter().take(STARTS) {
            let other = descend(self, start, &lower, &upper);
            if self.supports(&other.point) && other.chi_squared < best.chi_squared - 1e-9 * (1.0 + best.chi_squared) {
                best = other;
            }
        }
        let Bottom { point, chi_squared } = best;
        Minimum { point, chi_squared }
    }

    /// Whether a point at which the model worked lies near, no farther than [`scale`](Self::scale).
    #[must_use]
    pub fn supports(&self, point: &[f64]) -> bool {
        self.points.iter().any(|evaluated| distance(evaluated, point) <= self.scale)
    }

    fn basis(&self, point: &[f64]) -> DVector<f64> {
        basis(self.degree, &local(point, &self.centre, self.scale))
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
        slopes / self.scale
    }
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
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// t of a point.
fn local(point: &[f64], centre: &[f64], scale: f64) -> Vec<f64> {
    point.iter().zip(centre).map(|(u, c)| (u - c) / scale).collect()
}

/// 1, t_k and, where quadratic, t_k t_l.
fn basis(degree: Degree, t: &[f64]) -> DVector<f64> {
    let mut values = vec![1.0];
    values.extend_from_slice(t);
    if degree == Degree::Quadratic {
        for k in 0..t.len() {
            values.extend((k..t.len()).map(|l| t[k] * t[l]));
        }
    }
    DVector::from_vec(values)
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

#[cfg(test)]
mod tests {
    use super::super::stand_in::Curve;
    use super::super::{Evaluate, chi_squared};
    use super::*;
    use crate::sampling::design::{full_grid, latin_hypercube};

    fn evaluated(points: &[Vec<f64>], residuals: impl Fn(&[f64]) -> Option<Vec<f64>>) -> Vec<Evaluated> {
        let one = |point: &Vec<f64>| {
            let residuals = residuals(point);
            let chi_squared = residuals.as_deref().map(chi_squared);
            Evaluated { point: point.clone(), residuals, chi_squared }
        };
        points.iter().map(one).collect()
    }

    /// Two residuals that are polynomials of second degree; the minimum, χ² = 0, lies at (0.4, 0.7).
    fn quadratic(u: &[f64]) -> Vec<f64> {
        let (x, y) = (u[0] - 0.4, u[1] - 0.7);
        vec![3.0 * x + x * y - 2.0 * y * y, 5.0 * y + x * x]
    }

    #[test]
    fn quadratic_residuals_are_reproduced() {
        let history = evaluated(&latin_hypercube(12, 2, 3), |u| Some(quadratic(u)));
        let emulator = Emulator::fit(&history, 0.02).unwrap();
        assert_eq!(emulator.degree(), Degree::Quadratic);
        let u = [0.15, 0.3];
        for (found, exact) in emulator.predict(&u).iter().zip(quadratic(&u)) {
            assert!((found - exact).abs() < 1e-10);
        }
        assert!((emulator.chi_squared(&u) - chi_squared(&quadratic(&u))).abs() < 1e-9);
        assert!(emulator.leave_one_out().unwrap() < 1e-9);
        let minimum = emulator.minimum();
        assert!((minimum.point[0] - 0.4).abs() < 1e-6 && (minimum.point[1] - 0.7).abs() < 1e-6, "{minimum:?}");
    }

    #[test]
    fn the_jacobian_is_that_of_differences() {
        let history = evaluated(&latin_hypercube(12, 2, 3), |u| Some(quadratic(u)));
        let emulator = Emulator::fit(&history, 0.02).unwrap();
        let (u, h) = ([0.2, 0.6], 1e-5);
        let jacobian = emulator.jacobian(&u);
        for k in 0..2 {
            let at = |step: f64| {
                let mut point = u;
                point[k] += step;
                emulator.predict(&point)
            };
            for row in 0..2 {
                let difference = (at(h)[row] - at(-h)[row]) / (2.0 * h);
                assert!((jacobian[(row, k)] - difference).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn the_degree_follows_the_number_of_points() {
        let degree = |count| {
            let history = evaluated(&latin_hypercube(count, 2, 3), |u| Some(quadratic(u)));
            Emulator::fit(&history, 0.02).map(|emulator| emulator.degree())
        };
        assert_eq!(
            [2, 3, 8, 9].map(degree),
            [None, Some(Degree::Linear), Some(Degree::Linear), Some(Degree::Quadratic)]
        );
    }

    #[test]
    fn failed_points_are_left_out() {
        let history = evaluated(&latin_hypercube(20, 2, 3), |u| (u[0] < 0.6).then(|| quadratic(u)));
        let minimum = Emulator::fit(&history, 0.02).unwrap().minimum();
        assert!((minimum.point[0] - 0.4).abs() < 1e-6 && (minimum.point[1] - 0.7).abs() < 1e-6);
    }

    #[test]
    fn the_minimum_of_a_smooth_curve_is_close() {
        let curve = Curve::new();
        let points = full_grid(&[4, 4, 4]);
        let residuals = curve.clone().residuals(&points).unwrap();
        let history = evaluated(&points, |u| residuals[points.iter().position(|point| point == u)?].clone());
        let emulator = Emulator::fit(&history, 0.02).unwrap();
        let minimum = emulator.minimum();
        let off = (0..3).map(|k| (minimum.point[k] - curve.truth[k]).abs()).fold(0.0, f64::max);
        println!("off by {off}, leave-one-out error {:?}", emulator.leave_one_out());
        assert!(off < 0.05);
    }
}
