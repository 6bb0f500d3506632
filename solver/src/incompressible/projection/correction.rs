//! Selection of the density errors that a pressure corrects.

use super::super::Phase;

/// Density errors that a pressure corrects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Correction {
    /// Too dense and too thin alike.
    Both,
    /// Too dense only: what may come apart.
    CompressionOnly,
}

impl Correction {
    /// Relative density deficit of a particle that is to be corrected `[-]`, negative where it is too dense.
    pub(crate) fn missing<const D: usize>(self, phase: &Phase<D>, a: usize) -> f64 {
        let missing = 1.0 - phase.concentration[a];
        match self {
            Self::Both if missing > 0.0 => missing * (1.0 - phase.nearness[a]),
            Self::Both => missing,
            Self::CompressionOnly => missing.min(0.0),
        }
    }
}
