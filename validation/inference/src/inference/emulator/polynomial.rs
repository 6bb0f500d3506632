//! Polynomials of first and second degree about a point.

use nalgebra::DVector;

/// Quadratic from this many points per coefficient on.
const POINTS_PER_COEFFICIENT: f64 = 1.5;

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
    pub(super) fn coefficients(self, dimensions: usize) -> usize {
        match self {
            Self::Linear => dimensions + 1,
            Self::Quadratic => (dimensions + 1) * (dimensions + 2) / 2,
        }
    }

    /// Points from which on a polynomial of this degree is fitted.
    pub(in crate::inference) fn points(self, dimensions: usize) -> usize {
        match self {
            Self::Linear => self.coefficients(dimensions),
            Self::Quadratic => (POINTS_PER_COEFFICIENT * self.coefficients(dimensions) as f64).ceil() as usize,
        }
    }

    /// Growth of the neglected terms with |t|.
    pub(super) fn remainder(self, t: f64) -> f64 {
        match self {
            Self::Linear => t * t,
            Self::Quadratic => t * t * t,
        }
    }
}

/// t of a point.
pub(super) fn local(point: &[f64], centre: &[f64], scale: f64) -> Vec<f64> {
    point.iter().zip(centre).map(|(u, c)| (u - c) / scale).collect()
}

/// 1, t_k and, where quadratic, t_k t_l.
pub(super) fn basis(degree: Degree, t: &[f64]) -> DVector<f64> {
    let mut values = vec![1.0];
    values.extend_from_slice(t);
    if degree == Degree::Quadratic {
        for k in 0..t.len() {
            values.extend((k..t.len()).map(|l| t[k] * t[l]));
        }
    }
    DVector::from_vec(values)
}
