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
#[must_use]
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
struct Fit {
    /// Orthonormal columns, shape `[data][directions]`.
    basis: DMatrix<f64>,
    /// V Σ⁻¹, shape `[parameters][directions]`.
    to_parameters: DMatrix<f64>,
}

impl Fit {
    fn of(jacobian: &DMatrix<f64>) -> Self {
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
    fn residuals(&self, errors: &[f64]) -> Vec<f64> {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola at forty places.
    fn jacobian() -> DMatrix<f64> {
        DMatrix::from_fn(40, 3, |row, k| libm::pow(row as f64 / 39.0, k as f64) / 0.05)
    }

    /// Errors of an autoregressive process of unit variance.
    fn errors(seed: u64, coefficient: f64) -> Vec<f64> {
        let mut random = Random::new(seed);
        let fresh = (1.0 - coefficient * coefficient).sqrt();
        let mut last = random.normal();
        (0..40)
            .map(|k| {
                if k > 0 {
                    last = coefficient * last + fresh * random.normal();
                }
                last
            })
            .collect()
    }

    fn found(seed: u64, coefficient: f64) -> Option<SerialCorrelation> {
        let (fit, series) = (Fit::of(&jacobian()), vec![(0..40).collect::<Vec<usize>>()]);
        serial_correlation(&series, &fit.residuals(&errors(seed, coefficient)), &jacobian())
    }

    #[test]
    fn white_noise_is_seldom_taken_for_correlated() {
        let named = (0..400).filter(|seed| found(*seed, 0.0).is_some()).count();
        assert!(named <= 20, "{named} of 400");
    }

    /// Coverage is that of the three coefficients of the parabola, whose truth is 0, by a normal interval of 95 %.
    #[test]
    fn correlated_errors_are_named_and_their_widened_intervals_hold_the_truth() {
        let fit = Fit::of(&jacobian());
        for (coefficient, least_named) in [(0.5, 64), (0.8, 64)] {
            let (mut named, mut inside, mut stated, mut mean) = (0, 0, 0, 0.0);
            for seed in 1000..1080 {
                let errors = errors(seed, coefficient);
                let widened = found(seed, coefficient);
                named += usize::from(widened.is_some());
                mean += widened.map_or(0.0, |one| one.coefficient) / 80.0;
                let projected = fit.basis.tr_mul(&DMatrix::from_vec(40, 1, errors));
                let off = &fit.to_parameters * projected;
                for k in 0..3 {
                    let deviation = fit.to_parameters.row(k).norm();
                    let distance = off[(k, 0)].abs() / (1.96 * deviation);
                    inside += usize::from(distance <= widened.map_or(1.0, |one| one.factor));
                    stated += usize::from(distance <= 1.0);
                }
            }
            println!(
                "ρ = {coefficient}: named {named} of 80, mean {mean:.2}, inside {inside} of 240, unwidened {stated}"
            );
            assert!(
                named >= least_named && inside >= 204 && stated < inside,
                "{coefficient}: {named} {inside} {stated}"
            );
        }
    }

    #[test]
    fn a_law_of_another_shape_shows_as_correlation() {
        let line = DMatrix::from_fn(15, 2, |row, k| libm::pow(row as f64, k as f64));
        let mut random = Random::new(3);
        let bent: Vec<f64> =
            (0..15).map(|k| 0.2 * random.normal() + 0.16 * libm::pow(f64::from(k) - 7.0, 2.0)).collect();
        let left = Fit::of(&line).residuals(&bent);
        let found = serial_correlation(&[(0..15).collect()], &left, &line).expect("correlated");
        assert!(found.coefficient > 0.8 && found.factor > 2.0, "{found:?}");
    }

    #[test]
    fn series_of_few_and_of_other_data_say_nothing() {
        assert_eq!(serial_correlation(&[vec![0, 1, 2]], &[1.0; 3], &DMatrix::zeros(3, 1)), None);
        assert_eq!(serial_correlation(&[], &[1.0; 40], &jacobian()), None);
    }
}
