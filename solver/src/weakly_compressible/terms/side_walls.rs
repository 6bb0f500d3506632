//! Friction of two parallel side walls, a width W apart, on a plane flow between them (Taberlet et al. 2003, Phys. Rev. Lett. 91; Jop,
//! Forterre & Pouliquen 2005, J. Fluid Mech. 541).
//!
//! Averaged over W, walls at rest on which grains press with p and slide with the friction μ_w give a force per volume of
//! −(2 μ_w p/W) v/|v|. At rest it is whatever holds the grains, up to that size: v ∈ [0, …] solves
//!
//! v = v* − Δt a v/|v|, a = 2 μ_w p/(ρ W); v = 0 where |v*| ≤ Δt a,
//!
//! with the velocity v* that all other forces lead to: implicit Euler of Coulomb's law. So the friction stops grains and never turns
//! them, and grains at rest stay exactly there while the other forces are below its limit: nothing is regularised, and nothing creeps.

use crate::lanes::Real;

/// Speed `[m/s]` that the walls take from sliding grains in a time step `[s]`, of a friction over the width μ_w/W `[1/m]`, a pressure
/// `[Pa]` and a density `[kg/m³]`; none without a pressure.
#[inline(always)]
#[must_use]
pub fn speed_lost<R: Real>(pressure: R, density: R, friction_per_width: f64, time_step: f64) -> R {
    R::splat(2.0 * friction_per_width * time_step) * pressure.max(R::splat(0.0)) / density
}

/// Remaining part of a speed `[m/s]` over itself `[-]`, where walls take up to `lost` `[m/s]` of it; 0 at rest.
#[inline(always)]
#[must_use]
pub fn share_left<R: Real>(speed: R, lost: R) -> R {
    (speed - lost).max(R::splat(0.0)) / speed.max(R::splat(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_walls_rub_and_only_where_grains_press_on_them() {
        // 2 · 0.3/0.1 m · 500 Pa/1500 kg/m³ = 2 m/s²
        assert!((speed_lost(500.0, 1500.0, 3.0, 0.01) - 0.02).abs() < 1e-15);
        assert_eq!(speed_lost(-500.0, 1500.0, 3.0, 0.01), 0.0);
    }

    #[test]
    fn grains_are_stopped_and_never_turned() {
        assert_eq!(share_left(2.0, 0.5), 0.75);
        assert_eq!(share_left(2.0, 0.0), 1.0);
        for speed in [0.0, 1e-300, 0.1, 0.5] {
            assert_eq!(share_left(speed, 0.5), 0.0);
        }
        assert_eq!(share_left(0.0, 0.0), 0.0);
    }
}
