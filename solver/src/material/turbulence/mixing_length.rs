//! Prandtl's mixing length (1925): ν_t = l² |γ̇| with |γ̇| = √(2 ε:ε), so that the turbulent stress is ρ l² |du/dz|².
//!
//! Heights z are above the nominal bed; the wall law counts them from an origin z_off below it, z′ = z + z_off. With
//! H = h + z_off for a depth h,
//! - parabolic: l = κ z′ √(1 − z′/H). The logarithmic profile du/dz = u_*/(κ z′) then carries exactly the stress of a
//!   uniform free-surface flow, ρ u_*² (1 − z′/H), with the parabolic ν_t = κ u_* z′ (1 − z′/H);
//! - linear: l = κ z′, right near the wall only: under the same stress the profile bends below the logarithm.

use super::{VON_KARMAN, eddy_viscosity};
use crate::parameter::not_negative;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Mixing length over the distance from the wall.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[serde(rename_all = "kebab-case")]
pub enum MixingLengthShape {
    /// l = κ z′ √(1 − z′/H): the eddy viscosity of a logarithmic profile is a parabola over the depth.
    Parabolic,
    /// l = κ z′.
    Linear,
}

/// Mixing in proportion to the distance from a bed.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct MixingLength {
    /// Shape over the depth.
    pub shape: MixingLengthShape,
    /// Depth z_off `[m]` of the wall law's origin below the nominal bed: a fraction of a grain diameter.
    #[schemars(transform = not_negative("give it in metres: a fraction of a grain diameter"))]
    pub origin_offset: f64,
}

impl MixingLength {
    /// Mixing length l `[m]` at a height z `[m]` above the nominal bed in a flow of a depth h `[m]`; 0 below the
    /// origin, and above the surface for the parabolic shape.
    #[inline]
    #[must_use]
    pub fn length(&self, height: f64, depth: f64) -> f64 {
        let distance = (height + self.origin_offset).max(0.0);
        let damping = match self.shape {
            MixingLengthShape::Parabolic => (1.0 - distance / (depth + self.origin_offset)).max(0.0).sqrt(),
            MixingLengthShape::Linear => 1.0,
        };
        VON_KARMAN * distance * damping
    }

    /// Kinematic eddy viscosity ν_t = l² |γ̇| `[m²/s]` at a height `[m]`, a depth `[m]` and a shear rate `[1/s]`.
    #[inline]
    #[must_use]
    pub fn eddy_viscosity(&self, height: f64, depth: f64, shear_rate: f64) -> f64 {
        eddy_viscosity(self.length(height, depth), shear_rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::turbulence::VON_KARMAN;

    const DEPTH: f64 = 0.046;
    const PARABOLIC: MixingLength = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: 6e-4 };
    const LINEAR: MixingLength = MixingLength { shape: MixingLengthShape::Linear, ..PARABOLIC };

    #[test]
    fn log_law_carries_the_stress_of_a_uniform_flow_exactly() {
        let friction_velocity = 0.116;
        for k in 0..=46 {
            let height = f64::from(k) * 1e-3;
            let distance = height + PARABOLIC.origin_offset;
            let shear_rate = friction_velocity / (VON_KARMAN * distance);
            let expected = friction_velocity * friction_velocity * (1.0 - distance / 0.0466);
            let stress = PARABOLIC.eddy_viscosity(height, DEPTH, shear_rate) * shear_rate;
            assert!((stress - expected).abs() < 1e-15, "z = {height}: {stress} or {expected}");
        }
    }

    #[test]
    fn both_shapes_begin_alike_and_part_over_the_depth() {
        assert!((PARABOLIC.length(0.0, DEPTH) / LINEAR.length(0.0, DEPTH) - 1.0).abs() < 0.007);
        // z′ = 23.3 mm, half of H: κ z′ = 9.553 mm, the root is √½
        assert!((LINEAR.length(0.0227, DEPTH) - 9.553e-3).abs() < 1e-15);
        assert!((PARABOLIC.length(0.0227, DEPTH) - 9.553e-3 * 0.5f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn is_zero_below_the_origin_and_above_the_surface() {
        for law in [PARABOLIC, LINEAR] {
            assert_eq!(law.length(-6e-4, DEPTH), 0.0);
            assert_eq!(law.length(-1e-2, DEPTH), 0.0);
        }
        assert_eq!(PARABOLIC.length(0.05, DEPTH), 0.0);
    }
}
