//! The free surface: where neighbours are missing.

use super::super::{Phase, ProjectionNumerics};
use crate::lanes::Lanes;

/// Deficit of neighbours above which a particle lies at the surface (31) `[-]`.
pub(crate) const AT_SURFACE: f64 = 0.5;

/// Detection of the free surface of a phase, (31).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface {
    /// Volume of a particle over Σ V W of the lattice and the reference `[m^D]`.
    scale: f64,
    /// β of (31) `[-]`.
    threshold: f64,
}

impl Surface {
    pub(crate) fn of<const D: usize>(phase: &Phase<D>, numerics: &ProjectionNumerics) -> Self {
        let reference = phase.lattice.concentration * numerics.reference_concentration;
        Self { scale: phase.lattice_volume / reference, threshold: numerics.surface_threshold }
    }

    /// Concentration and deficit `[-]` of eight particles by their Σ W `[1/m^D]`.
    #[inline(always)]
    pub(crate) fn find<V: Lanes>(&self, values: V) -> (V, V) {
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let concentration = V::splat(self.scale) * values;
        let missing = (one - concentration) * V::splat(1.0 / (1.0 - self.threshold));
        (concentration, (missing - V::splat(AT_SURFACE)).max(zero).min(one))
    }
}
