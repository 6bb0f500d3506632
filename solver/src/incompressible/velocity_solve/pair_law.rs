//! The η_a + η_b of two sediment particles: the law at the rate and the load of a pair, or a mean of the particles' own.

use super::super::PairLaw;
use super::super::terms::viscous_pair::mean_rate;
use crate::material::rheology::Rheology;

/// Load and viscosity of one particle of a pair.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    /// Load on the grains `[Pa]`.
    pub(super) load: f64,
    /// Apparent viscosity `[Pa·s]`.
    pub(super) viscosity: f64,
}

/// η_a + η_b of two sediment particles `[Pa·s]`, from the pair's own |u_ab|/r `[1/s]` and what a shear rate is over it in
/// rows that slide `[-]`. The law at the smaller load takes the mean over all directions, with which its fits were made.
#[inline]
pub(super) fn viscosities<const D: usize>(
    law: &Rheology,
    pair_law: PairLaw,
    ends: (End, End),
    sliding_rate: f64,
    own_rate: impl FnOnce() -> f64,
) -> f64 {
    let (a, b) = ends;
    match pair_law {
        PairLaw::PairRate => 2.0 * law.viscosity(mean_rate(D) * own_rate(), a.load.min(b.load)),
        PairLaw::PairRateMeanLoad => 2.0 * law.viscosity(sliding_rate * own_rate(), 0.5 * (a.load + b.load)),
        PairLaw::ArithmeticMean => a.viscosity + b.viscosity,
        PairLaw::HarmonicMean => 4.0 * a.viscosity * b.viscosity / (a.viscosity + b.viscosity),
    }
}
