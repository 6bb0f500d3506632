//! The mixing length over and among grains: l = κ √(1 − z/h) R with the room R = ∫ (1 − φ/φ_max) dz from the base up.
//!
//! An eddy grows where grains leave it room (Li & Sawamoto 1995 for the integral, as in Revil-Baudard & Chauchat 2013, J.
//! Fluid Mech. 730); the root makes the logarithmic law exact over a clear bed, where R = z, as for
//! [`MixingLength`](super::MixingLength).

use super::VON_KARMAN;

/// Mixing in proportion to the room between grains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StratifiedMixingLength {
    /// Solid fraction φ_max `[-]` of grains that leave no room.
    pub packing: f64,
    /// Depth h `[m]` of the flow above the bed.
    pub depth: f64,
}

impl StratifiedMixingLength {
    /// Room (1 − φ/φ_max) Δz `[m]` within a layer of a thickness Δz `[m]` and a solid fraction φ `[-]`; negative where
    /// grains scatter above φ_max.
    #[inline]
    #[must_use]
    pub fn room(&self, solid_fraction: f64, thickness: f64) -> f64 {
        (1.0 - solid_fraction / self.packing) * thickness
    }

    /// l `[m]` at a height z `[m]` above the bed with the room R `[m]` below; 0 above the surface and without room.
    #[inline]
    #[must_use]
    pub fn length(&self, height: f64, room: f64) -> f64 {
        let root = (1.0 - height / self.depth).max(0.0).sqrt();
        VON_KARMAN * root * room.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::turbulence::{MixingLength, MixingLengthShape};

    const LAW: StratifiedMixingLength = StratifiedMixingLength { packing: 0.6, depth: 0.046 };

    #[test]
    fn is_the_parabolic_length_over_a_clear_bed() {
        let parabolic = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: 0.0 };
        for k in 0..=50 {
            let height = f64::from(k) * 1e-3;
            let room = LAW.room(0.0, height);
            assert!((LAW.length(height, room) - parabolic.length(height, 0.046)).abs() < 1e-16, "z = {height}");
        }
    }

    #[test]
    fn packed_grains_leave_no_room() {
        assert_eq!(LAW.room(0.6, 0.01), 0.0);
        assert!((LAW.room(0.3, 0.01) - 0.005).abs() < 1e-17);
        assert_eq!(LAW.length(-0.003, LAW.room(0.62, 0.01)), 0.0);
    }
}
