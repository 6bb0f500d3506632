//! Roughness of grains that rest, as a room that the mixing length starts from: l = κ √(1 − z/h) (R + r) with
//! R = ∫ (1 − φ/φ_max) dz and
//!
//! r = r_0 d exp(−D/(s d)), D = ∫ x (1 − x) dz, x = φ/φ_max, both from the base up.
//!
//! s is this project's and stands in no literature: no measurement says how fast the roughness of a bed fades as its grains loosen.
//!
//! Over packed grains R is the height above them, and l = κ (z + r_0 d) is that of a rough wall whose origin lies r_0 d
//! below the tops of its grains (0.15 to 0.3 for beds of spheres; Nezu & Nakagawa 1993). Grains that move have loosened;
//! the room between them carries the eddies then, and the roughness, which it replaces, fades with it. D counts only
//! room that lies between grains: neither packed grains nor clear water have any.

use crate::parameter::{between, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Roughness of resting grains.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct GrainRoughness {
    /// Depth r_0 of the origin below the tops of resting grains, in grain diameters `[-]`; 0 for a smooth bed.
    #[schemars(transform = between(0.0, 1.0, "give 0.15 to 0.3 for a bed of spheres, 0 for a smooth bed"))]
    pub origin_depth: f64,
    /// Room s between loosened grains over which the bed's roughness falls by e, in grain diameters `[-]`; chosen, not measured:
    /// 0.01 to 0.3 are plausible, and transport depends on it.
    #[schemars(transform = positive("give a few hundredths; a layer of moving grains has a larger value"))]
    pub bed_roughness_fade_length: f64,
}

impl Default for GrainRoughness {
    fn default() -> Self {
        Self { origin_depth: 0.2, bed_roughness_fade_length: 0.03 }
    }
}

impl GrainRoughness {
    /// Room between grains x (1 − x) Δz `[m]` within a layer of a thickness Δz `[m]` and a share x = φ/φ_max `[-]`.
    #[inline]
    #[must_use]
    pub fn loosened(&self, share: f64, thickness: f64) -> f64 {
        let share = share.clamp(0.0, 1.0);
        share * (1.0 - share) * thickness
    }

    /// r `[m]` with the room D `[m]` between the grains below, at a grain diameter d `[m]`.
    #[inline]
    #[must_use]
    pub fn room(&self, loosened: f64, grain_diameter: f64) -> f64 {
        self.origin_depth * grain_diameter * libm::exp(-loosened / (self.bed_roughness_fade_length * grain_diameter))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::turbulence::{MixingLength, MixingLengthShape, StratifiedMixingLength};
    use crate::parameter::range_problem;

    #[test]
    fn resting_grains_under_clear_water_are_a_rough_wall() {
        let roughness = GrainRoughness::default();
        let loosened = roughness.loosened(1.0, 0.04) + roughness.loosened(0.0, 0.02);
        assert_eq!(loosened, 0.0);
        let room = roughness.room(loosened, 5e-3);
        assert_eq!(room, 1e-3);
        // near the wall the length is that over a wall law's origin 1 mm below the bed
        let law = StratifiedMixingLength { packing: 0.6, depth: 0.046 };
        let wall = MixingLength { shape: MixingLengthShape::Linear, origin_offset: 1e-3 };
        let length = law.length(1e-4, law.room(0.0, 1e-4) + room);
        assert!((length / wall.length(1e-4, 0.046) - 1.0).abs() < 2e-3, "{length}");
    }

    #[test]
    fn loosened_grains_replace_it() {
        let roughness = GrainRoughness::default();
        // a grain's height at half the densest packing: D = d/4
        let loosened = roughness.loosened(0.5, 5e-3);
        assert_eq!(loosened, 1.25e-3);
        assert!(roughness.room(loosened, 5e-3) < 3e-4 * roughness.room(0.0, 5e-3));
        // by e over s d
        let fallen = roughness.room(0.03 * 5e-3, 5e-3) / roughness.room(0.0, 5e-3);
        assert!((fallen * 1f64.exp() - 1.0).abs() < 1e-14, "{fallen}");
    }

    #[test]
    fn scatter_about_the_densest_packing_makes_no_room() {
        let roughness = GrainRoughness::default();
        assert_eq!(roughness.loosened(1.02, 1e-3), 0.0);
        assert_eq!(roughness.loosened(-0.01, 1e-3), 0.0);
    }

    #[test]
    fn a_roughness_that_cannot_fade_is_refused() {
        let roughness = GrainRoughness::default();
        assert!(range_problem(&roughness).is_none());
        let field = |roughness: GrainRoughness| range_problem(&roughness).map(|problem| problem.field);
        assert_eq!(
            field(GrainRoughness { bed_roughness_fade_length: 0.0, ..roughness }),
            Some("bed_roughness_fade_length".to_owned())
        );
        assert_eq!(field(GrainRoughness { origin_depth: -0.1, ..roughness }), Some("origin_depth".to_owned()));
    }
}
