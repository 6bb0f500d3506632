//! Loss function of weighted residuals: the square, or less for an outlier.
//!
//! Huber's loss is ρ(r) = r² for |r| ≤ c and 2 c |r| − c² beyond; with c = 1.345 the estimate keeps 95 % of its efficiency
//! where errors are normal. A search that knows squares only is given ±√ρ in the place of r. Intervals at the limits of χ²
//! are then somewhat wider than need be.
//!
//! Source: Huber, Annals of Mathematical Statistics 35 (1964) 73.

use serde::{Deserialize, Serialize};

/// c, in standard uncertainties.
pub const CORNER: f64 = 1.345;

/// Loss function of a residual.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Loss {
    /// r².
    #[default]
    Squares,
    /// Huber's.
    Huber,
}

impl Loss {
    /// The number `[-]` whose square is the cost of a weighted residual, with its sign.
    pub fn root(self, residual: f64) -> f64 {
        let size = residual.abs();
        match self {
            Self::Huber if size > CORNER => (CORNER * (2.0 * size - CORNER)).sqrt().copysign(residual),
            _ => residual,
        }
    }

    /// The weighted residual `[-]` that has a root.
    pub fn residual(self, root: f64) -> f64 {
        let size = root.abs();
        match self {
            Self::Huber if size > CORNER => ((size * size + CORNER * CORNER) / (2.0 * CORNER)).copysign(root),
            _ => root,
        }
    }
}
