//! Which density errors a pressure corrects.

use super::super::phase::Phase;

/// Which density errors are corrected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Correction {
    /// Too dense and too thin alike.
    Both,
    /// Too dense only: what may come apart.
    CompressionOnly,
}

impl Correction {
    /// What a particle lacks of its density and is to be corrected `[-]`.
    pub(crate) fn missing<const D: usize>(self, phase: &Phase<D>, a: usize) -> f64 {
        let missing = 1.0 - phase.concentration[a];
        match self {
            Self::Both if missing > 0.0 => missing * (1.0 - phase.nearness[a]),
            Self::Both => missing,
            Self::CompressionOnly => missing.min(0.0),
        }
    }
}
