//! Joint region, intervals and covariance that the data leave open, and whether the model explains the data at all.
//!
//! Of data with normal errors χ² rises from its minimum to the truth by a number that follows the χ² distribution, with
//! as many degrees of freedom as there are parameters, or one for a single parameter with the others at their best
//! (Wilks, Annals of Mathematical Statistics 9 (1938) 60).

use super::descent::LocalMinimum;
use super::emulator::Emulator;
use super::profile::{ProfileCurve, ProfileLikelihood, ProfileLikelihoodPoint};
use nalgebra::DMatrix;
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// Share of repeated experiments whose region contains the truth.
pub const CONFIDENCE: f64 = 0.95;

/// Shares of a distribution below the ends of the interval that leaves out as much below as above.
pub(super) const CENTRAL: [f64; 2] = [0.5 - 0.5 * CONFIDENCE, 0.5 + 0.5 * CONFIDENCE];

/// Singular values of J below this share of the largest one, or below this number of standard uncertainties over a full
/// range, count as that much: directions without information get a large variance, not an infinite one.
const LEAST_SHARE: f64 = 1e-8;
const LEAST_INFORMATION: f64 = 1e-3;

/// Enlargement of the stated standard uncertainties of the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncertainties {
    /// Factor for errors that are correlated, 1 for independent ones `[-]`.
    pub factor: f64,
    /// Whether √(reduced χ²) enlarges them too where it exceeds 1, as if what the model misses were part of the noise.
    pub is_inflated: bool,
}

impl Uncertainties {
    /// Standard uncertainties as they are stated.
    pub const STATED: Self = Self { factor: 1.0, is_inflated: false };
}

/// The parameters that agree with the data, in the unit cube, as the emulator has it.
#[derive(Debug, Clone)]
pub struct Region {
    /// The emulator that it rests on.
    pub emulator: Emulator,
    /// The best point, with the χ² that was evaluated there.
    pub minimum: LocalMinimum,
    /// The same point with the emulator's χ²: what its rises are counted from.
    base: LocalMinimum,
    /// Rise of χ² at the edge of the joint region `[-]`.
    pub threshold: f64,
    /// Rise of χ² at the ends of intervals `[-]`.
    pub limit: f64,
    /// Profile of every parameter with its interval.
    pub profiles: Vec<ProfileLikelihood>,
    /// Covariance (JᵀJ)⁻¹ at the minimum. A standard deviation far above 1, the range, only says that the data do not
    /// determine the parameter.
    pub covariance: DMatrix<f64>,
    /// Correlation of the parameters `[-]`.
    pub correlation: DMatrix<f64>,
    /// χ² at the best point over the number of data less that of parameters `[-]`; none unless there are more data.
    pub reduced_chi_squared: Option<f64>,
    /// Share of repeated experiments in which a true model gives a larger χ² `[-]`.
    pub p_value: Option<f64>,
    /// Factor on the stated standard uncertainties that the region, the intervals and the covariance include `[-]`.
    pub inflation: f64,
}

impl Region {
    /// The region of an emulator about its own minimum.
    pub fn new(emulator: &Emulator, uncertainties: Uncertainties) -> Self {
        let mut region = Self::about(emulator, emulator.minimum(), uncertainties);
        region.draw();
        region
    }

    /// The region about an evaluated point with the χ² that the model has there; its profiles have no curves yet.
    pub fn about(emulator: &Emulator, minimum: LocalMinimum, uncertainties: Uncertainties) -> Self {
        let dimensions = emulator.dimensions();
        let freedom = emulator.data().checked_sub(dimensions).filter(|freedom| *freedom > 0);
        let reduced_chi_squared = freedom.map(|freedom| minimum.chi_squared / freedom as f64);
        let p_value = freedom.map(|freedom| chi_squared_tail(minimum.chi_squared, freedom));
        let unexplained = reduced_chi_squared.filter(|_| uncertainties.is_inflated).unwrap_or(1.0).max(1.0).sqrt();
        let inflation = uncertainties.factor * unexplained;
        let squared = inflation * inflation;
        let covariance = squared * covariance(&emulator.jacobian(&minimum.point));
        let base = LocalMinimum { chi_squared: emulator.chi_squared(&minimum.point), point: minimum.point.clone() };
        let limit = squared * chi_squared_quantile(CONFIDENCE, 1);
        let profile = |which: usize| {
            let curve = ProfileCurve { emulator, minimum: &base, which, threshold: limit };
            curve.interval(covariance[(which, which)].sqrt())
        };
        let profiles = (0..dimensions).map(profile).collect();
        Self {
            emulator: emulator.clone(),
            threshold: squared * chi_squared_quantile(CONFIDENCE, dimensions),
            limit,
            profiles,
            correlation: correlation(&covariance),
            covariance,
            reduced_chi_squared,
            p_value,
            inflation,
            minimum,
            base,
        }
    }

    /// Draws the curves of the profiles over their intervals.
    pub fn draw(&mut self) {
        for k in 0..self.profiles.len() {
            self.profiles[k].curve = self.along(k).curve(self.profiles[k].interval);
        }
    }

    fn along(&self, which: usize) -> ProfileCurve<'_> {
        ProfileCurve { emulator: &self.emulator, minimum: &self.base, which, threshold: self.limit }
    }

    /// The best point of the emulator with one parameter held, downhill from `start`.
    pub fn held(&self, start: &[f64], which: usize, value: f64) -> ProfileLikelihoodPoint {
        self.along(which).held(start, value)
    }

    /// End of the interval on the emulator's profile along one parameter beyond a point, and whether it is at the bound.
    pub fn end_beyond(&self, start: &[f64], which: usize, upper: bool) -> (Vec<f64>, bool) {
        let direction = if upper { 1.0 } else { -1.0 };
        self.along(which).crossing(start, direction, self.covariance[(which, which)].sqrt())
    }

    /// The best point outside of a parameter's intervals where the emulator agrees with the data too.
    pub fn lead(&self, which: usize) -> Option<Vec<f64>> {
        self.along(which).lead(&self.profiles[which])
    }

    /// Rise of the emulator's χ² at a point `[-]`.
    pub fn rise(&self, point: &[f64]) -> f64 {
        self.emulator.chi_squared(point) - self.base.chi_squared
    }

    /// Derivatives of the weighted residuals at the minimum, one row a datum, one column a parameter.
    pub fn jacobian(&self) -> DMatrix<f64> {
        self.emulator.jacobian(&self.minimum.point)
    }

    /// Whether a point of the cube agrees with the data.
    pub fn contains(&self, point: &[f64]) -> bool {
        self.rise(point) <= self.threshold
    }
}

/// χ² below which a share `confidence` of its distribution lies `[-]`; not a number without freedom.
pub fn chi_squared_quantile(confidence: f64, freedom: usize) -> f64 {
    // rounded, since the library underneath takes logarithms from the platform
    ChiSquared::new(freedom as f64).map_or(f64::NAN, |distribution| rounded(distribution.inverse_cdf(confidence)))
}

/// Share of the distribution of χ² above a value `[-]`; not a number without freedom.
pub fn chi_squared_tail(value: f64, freedom: usize) -> f64 {
    ChiSquared::new(freedom as f64).map_or(f64::NAN, |distribution| rounded(distribution.sf(value)))
}

fn rounded(value: f64) -> f64 {
    (value * 1e9).round() * 1e-9
}

/// (JᵀJ)⁻¹ from the singular values of J.
fn covariance(jacobian: &DMatrix<f64>) -> DMatrix<f64> {
    let count = jacobian.ncols();
    let mut result = DMatrix::zeros(count, count);
    // with fewer data than parameters, rows of zeros bring out the directions without effect
    let factors = jacobian.clone().resize_vertically(jacobian.nrows().max(count), 0.0).svd(false, true);
    let Some(directions) = factors.v_t else { return result };
    let least = LEAST_INFORMATION.max(LEAST_SHARE * factors.singular_values.max());
    for (row, value) in factors.singular_values.iter().enumerate() {
        let direction = directions.row(row);
        let value = value.max(least);
        result += direction.tr_mul(&direction) / (value * value);
    }
    result
}

/// Correlation matrix of a covariance; nothing correlates with a parameter without variance.
fn correlation(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(covariance.nrows(), covariance.ncols(), |row, column| {
        let scale = (covariance[(row, row)] * covariance[(column, column)]).sqrt();
        if row == column {
            1.0
        } else if scale > 0.0 {
            (covariance[(row, column)] / scale).clamp(-1.0, 1.0)
        } else {
            0.0
        }
    })
}
