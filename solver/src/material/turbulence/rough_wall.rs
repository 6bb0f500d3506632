//! The logarithmic law over a hydraulically rough wall (Nikuradse 1933): u(z′)/u_* = (1/κ) ln(z′/z_0), z_0 = k_s/30.
//!
//! z′ is the distance from the wall law's origin, k_s the equivalent sand roughness. A spacing that cannot resolve z_0
//! takes the wall's stress from the velocity u of the fluid at z′ instead of from a velocity gradient:
//!
//! u_* = κ |u|/ln(z′/z_0), τ = ρ u_*² against u, that is τ = c u with c = ρ κ² |u|/ln²(z′/z_0).
//!
//! The law begins at z_0, where u = 0 and u_* has no value. Nearer to the wall than e z_0 the stress is therefore taken
//! with ln = 1, so that it never exceeds ρ (κ u)².

use super::VON_KARMAN;
use crate::parameter::positive;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Smallest ln(z′/z_0) `[-]` that a stress is taken with.
const SMALLEST_LOGARITHM: f64 = 1.0;

/// A rough wall under a turbulent flow.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct RoughWall {
    /// Equivalent sand roughness k_s `[m]`: about a grain diameter on a flat bed.
    #[schemars(transform = positive("give it in metres; about the grain diameter"))]
    pub sand_roughness: f64,
}

impl RoughWall {
    /// Roughness length z_0 = k_s/30 `[m]`, the distance from the origin at which the law has no velocity.
    #[inline]
    #[must_use]
    pub fn roughness_length(&self) -> f64 {
        self.sand_roughness / 30.0
    }

    /// Velocity u `[m/s]` at a distance z′ `[m]` from the origin and a friction velocity u_* `[m/s]`; 0 up to z_0.
    #[inline]
    #[must_use]
    pub fn velocity(&self, distance: f64, friction_velocity: f64) -> f64 {
        friction_velocity / VON_KARMAN * libm::log(distance.max(self.roughness_length()) / self.roughness_length())
    }

    /// Shear stress τ = ρ u_*² `[Pa]` of the flow on the wall, with the sign of the velocity along the wall `[m/s]`, at a
    /// distance z′ `[m]` from the origin and a density `[kg/m³]`.
    #[inline]
    #[must_use]
    pub fn shear_stress(&self, velocity: f64, distance: f64, density: f64) -> f64 {
        self.stress_coefficient(velocity, distance, density) * velocity
    }

    /// c = τ/u = ρ κ² |u|/ln² `[Pa·s/m]`, of the same arguments: what an implicit step multiplies the new velocity by.
    #[inline]
    #[must_use]
    pub fn stress_coefficient(&self, velocity: f64, distance: f64, density: f64) -> f64 {
        let ratio = VON_KARMAN / self.logarithm(distance);
        density * ratio * ratio * velocity.abs()
    }

    /// ln(z′/z_0) `[-]`, not below its bound.
    #[inline]
    fn logarithm(&self, distance: f64) -> f64 {
        libm::log(distance / self.roughness_length()).max(SMALLEST_LOGARITHM)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::turbulence::{MixingLength, MixingLengthShape};

    /// 5 mm grains: z_0 = 1/6 mm.
    const BED: RoughWall = RoughWall { sand_roughness: 5e-3 };

    #[test]
    fn gives_the_profile_by_hand() {
        // z′ = 30 z_0 = 5 mm: ln 30 = 3.401197, u = 0.1/0.41 · 3.401197
        assert!((BED.velocity(5e-3, 0.1) - 0.829_560).abs() < 1e-6);
        assert_eq!(BED.velocity(BED.roughness_length(), 0.1), 0.0);
        assert_eq!(BED.velocity(-1e-3, 0.1), 0.0);
    }

    #[test]
    fn finds_the_friction_velocity_of_its_own_profile() {
        for distance in [5e-4, 1.6e-3, 4e-2] {
            let velocity = BED.velocity(distance, 0.116);
            assert!((BED.shear_stress(velocity, distance, 1000.0) - 13.456).abs() < 1e-11);
            assert!((BED.shear_stress(-velocity, distance, 1000.0) + 13.456).abs() < 1e-11);
        }
    }

    #[test]
    fn stress_is_bounded_at_the_wall() {
        for distance in [-1e-3, 0.0, 1e-9, BED.roughness_length(), 2.0 * BED.roughness_length()] {
            assert!((BED.shear_stress(0.5, distance, 1000.0) - 1000.0 * (0.41f64 * 0.5).powi(2)).abs() < 1e-11);
        }
        assert_eq!(BED.shear_stress(0.0, 1e-3, 1000.0), 0.0);
    }

    #[test]
    fn profile_carries_a_linear_stress_with_the_parabolic_mixing_length() {
        // τ/ρ = l² (du/dz)² by central differences of the profile itself: two independent routes to u_*² (1 − z′/H)
        let law = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: 6e-4 };
        let (depth, friction_velocity, step) = (0.046, 0.116, 1e-7);
        for k in 1..46 {
            let height = f64::from(k) * 1e-3;
            let distance = height + law.origin_offset;
            let difference =
                BED.velocity(distance + step, friction_velocity) - BED.velocity(distance - step, friction_velocity);
            let shear_rate = difference / (2.0 * step);
            let stress = law.eddy_viscosity(height, depth, shear_rate) * shear_rate;
            let expected = friction_velocity * friction_velocity * (1.0 - distance / (depth + law.origin_offset));
            assert!((stress / expected - 1.0).abs() < 1e-7, "z = {height}: {stress} or {expected}");
        }
    }
}
