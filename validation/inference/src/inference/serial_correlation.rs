//! Correlation of neighbouring residuals along profiles and in time, and by how much it widens intervals.
//!
//! Errors of neighbours are taken as those of a first-order autoregressive process, of correlation ρ^|i − j|. The fit takes part of
//! them out of the residuals e = M ε, M = 1 − Q Qᵀ with an orthonormal basis Q of the columns of the Jacobian J. The test is
//! against white noise that went through the same M; ρ is the value whose residuals have the observed ratio on average,
//! Σ e_i e_(i+1)/Σ e_i². Intervals of independent errors are then too narrow by the root of
//! diag((JᵀJ)⁻¹ JᵀCJ (JᵀJ)⁻¹)/diag((JᵀJ)⁻¹) for errors of the covariance C.

use crate::sampling::Random;
use nalgebra::DMatrix;

/// Fewest residuals in series about whose correlation anything is said.
const LEAST: usize = 8;
/// Draws of white noise, and the share of them that may have a larger correlation.
const DRAWS: usize = 999;
const LEVEL: f64 = 0.04;
/// Largest correlation `[-]`: beyond it a series is one datum.
const MOST: f64 = 0.97;
/// Halvings of the range of ρ.
const HALVINGS: usize = 30;
/// Singular values below this share of the largest one count as none.
const LEAST_SHARE: f64 = 1e-8;

/// Correlation of neighbouring errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SerialCorrelation {
    /// Correlation ρ of neighbours `[-]`.
    pub coefficient: f64,
    /// Factor on the standard uncertainties of the parameters, ≥ 1 `[-]`.
    pub factor: f64,
}

/// Finds the correlation along series, each the places of its residuals in their order; none where white noise has as much in four
/// of 100 experiments.
pub fn serial_correlation(
    series: &[Vec<usize>],
    residuals: &[f64],
    jacobian: &DMatrix<f64>,
) -> Option<SerialCorrelation> {
    if series.iter().filter(|places| places.len() > 1).map(Vec::len).sum::<usize>() < LEAST {
        return None;
    }
    let fit = Fit::of(jacobian);
    let observed = ratio(series, residuals);
    let mut random = Random::new(1);
    let larger = (0..DRAWS).filter(|_| {
        let noise: Vec<f64> = residuals.iter().map(|_| random.normal()).collect();
        ratio(series, &fit.residuals(&noise)) >= observed
    });
    if (larger.count() + 1) as f64 > LEVEL * (DRAWS + 1) as f64 {
        return None;
    }
    let (mut low, mut high) = (0.0, MOST);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if fit.expected(series, middle) < observed { low = middle } else { high = middle }
    }
    let coefficient = 0.5 * (low + high);
    Some(SerialCorrelation { coefficient, factor: fit.factor(series, coefficient) })
}

/// Σ e_i e_(i+1)/Σ e_i² over all series.
fn ratio(series: &[Vec<usize>], residuals: &[f64]) -> f64 {
    let product = |pair: &[usize]| residuals[pair[0]] * residuals[pair[1]];
    let products: f64 = series.iter().flat_map(|places| places.windows(2)).map(product).sum();
    let squares: f64 = series.iter().flatten().map(|place| residuals[*place] * residuals[*place]).sum();
    if squares > 0.0 { products / squares } else { 0.0 }
}

/// A linear least-squares fit: J = Q Σ Vᵀ.
pub struct Fit {
    /// Orthonormal columns, shape `[data][directions]`.
    pub basis: DMatrix<f64>,
    /// V Σ⁻¹, shape `[parameters][directions]`.
    pub to_parameters: DMatrix<f64>,
}

impl Fit {
    /// The fit of a Jacobian.
    pub fn of(jacobian: &DMatrix<f64>) -> Self {
        let empty =
            || Self { basis: DMatrix::zeros(jacobian.nrows(), 0), to_parameters: DMatrix::zeros(jacobian.ncols(), 0) };
        let factors = jacobian.clone().svd(true, true);
        let (Some(left), Some(right)) = (factors.u, factors.v_t) else { return empty() };
        let least = LEAST_SHARE * factors.singular_values.max();
        let kept: Vec<usize> =
            (0..factors.singular_values.len()).filter(|k| factors.singular_values[*k] > least).collect();
        let to_parameters = DMatrix::from_fn(jacobian.ncols(), kept.len(), |row, k| {
            right[(kept[k], row)] / factors.singular_values[kept[k]]
        });
        Self { basis: left.select_columns(&kept), to_parameters }
    }

    /// Residuals of errors after the fit.
    pub fn residuals(&self, errors: &[f64]) -> Vec<f64> {
        let mut left = errors.to_vec();
        for direction in self.basis.column_iter() {
            let part: f64 = direction.iter().zip(errors).map(|(q, error)| q * error).sum();
            left.iter_mut().zip(direction.iter()).for_each(|(error, q)| *error -= part * q);
        }
        left
    }

    /// Ratio of the expectations of both sums of residuals whose errors have the correlation ρ.
    fn expected(&self, series: &[Vec<usize>], coefficient: f64) -> f64 {
        let covered = self.covered(series, coefficient);
        let inner = self.basis.tr_mul(&covered);
        let element = |i: usize, j: usize, own: f64| {
            let (q, r) = (self.basis.row(i), self.basis.row(j));
            own - (q * covered.row(j).transpose())[0] - (covered.row(i) * r.transpose())[0]
                + (q * &inner * r.transpose())[0]
        };
        let products: f64 =
            series.iter().flat_map(|places| places.windows(2)).map(|pair| element(pair[0], pair[1], coefficient)).sum();
        let squares: f64 = series.iter().flatten().map(|place| element(*place, *place, 1.0)).sum();
        products / squares
    }

    /// C Q for errors that correlate along series by ρ^|i − j|, by one pass along them in each direction.
    fn covered(&self, series: &[Vec<usize>], coefficient: f64) -> DMatrix<f64> {
        let mut covered = self.basis.clone();
        for places in series {
            for k in 0..self.basis.ncols() {
                let values: Vec<f64> = places.iter().map(|place| self.basis[(*place, k)]).collect();
                let (mut ahead, mut behind) = (0.0, 0.0);
                let count = places.len();
                for i in 0..count {
                    covered[(places[i], k)] += ahead;
                    ahead = coefficient * (ahead + values[i]);
                    let j = count - 1 - i;
                    covered[(places[j], k)] += behind;
                    behind = coefficient * (behind + values[j]);
                }
            }
        }
        covered
    }

    /// Largest ratio of a parameter's standard deviation to that of independent errors, and at least their mean over all directions.
    fn factor(&self, series: &[Vec<usize>], coefficient: f64) -> f64 {
        let inner = self.basis.tr_mul(&self.covered(series, coefficient));
        let mean = inner.trace() / inner.nrows().max(1) as f64;
        let correlated = &self.to_parameters * &inner * self.to_parameters.transpose();
        let independent = &self.to_parameters * self.to_parameters.transpose();
        let of = |k: usize| if independent[(k, k)] > 0.0 { correlated[(k, k)] / independent[(k, k)] } else { 1.0 };
        (0..independent.nrows()).map(of).fold(mean.max(1.0), f64::max).sqrt()
    }
}
