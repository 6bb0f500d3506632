//! Continuity (3)(7) as it is stepped (24), with the density–pressure coupling (27).
//!
//! The divergence in (7) is not corrected: the trace of the corrected gradient makes the layer shrink or blow up.

use crate::lanes::Real;

/// −∇·v `[1/s]`: the trace of the uncorrected gradient Σ V (v_b − v_a) ⊗ ∇W is ∇·v of (7).
#[inline(always)]
pub fn compression<R: Real, const D: usize>(gradient: &[[R; D]; D]) -> R {
    let mut compression = -gradient[0][0];
    for i in 1..D {
        compression = compression - gradient[i][i];
    }
    compression
}

/// ρ `[kg/m³]` after a time step `[s]`, (24) with (27): `coupling` is the pair sum of (27) `[Pa/m²]`, `strength` its σ
/// `[-]`. ρ is never floored: a floor opens voids.
#[inline(always)]
#[must_use]
pub fn advanced<R: Real>(density: R, compression: R, coupling: R, strength: f64, time_step: f64) -> R {
    density + R::splat(time_step) * density * compression + R::splat(time_step * time_step * strength) * coupling
}
