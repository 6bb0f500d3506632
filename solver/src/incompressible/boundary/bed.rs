//! Friction of what the fluid flows over.

use super::super::terms::viscous_pair;
use super::super::{Bed, Phase, ProjectionNumerics, height_axis};
use crate::lanes::Lanes;

/// Mirror velocity of wall particles below a no-slip bed relative to their partner, for zero velocity at the wall.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallMirror {
    /// Height of the wall `[m]`.
    level: f64,
    /// Least height of a particle above it `[m]`.
    least_height: f64,
    /// Largest velocity of a wall particle over its partner's `[-]`.
    largest: f64,
}

impl WallMirror {
    /// The mirror of a bed that a phase of a spacing `[m]` sticks to; of any other bed one that is not read.
    pub(crate) fn of(bed: Bed, spacing: f64, numerics: &ProjectionNumerics) -> Self {
        let level = if let Bed::NoSlip(level) = bed { level } else { 0.0 };
        Self { level, least_height: numerics.least_wall_height * spacing, largest: numerics.largest_mirror }
    }

    /// Heights above the wall `[m]` of eight particles.
    #[inline(always)]
    pub(crate) fn height<V: Lanes>(&self, position: V) -> V {
        (position - V::splat(self.level)).max(V::splat(self.least_height))
    }

    /// 1 + d/z `[-]` of wall particles so far below eight particles `[m]` at the heights z `[m]`.
    #[inline(always)]
    pub(crate) fn factor<V: Lanes>(&self, separation: V, height: V) -> V {
        let depth = (separation - height).max(V::splat(0.0));
        (V::splat(1.0) + depth / height).min(V::splat(self.largest))
    }
}

/// Friction of the bed on a fluid particle, Δt Σ_w k_aw `[kg]`, at a dynamic viscosity of the particle `[Pa·s]`.
pub(crate) fn friction<const D: usize>(bed: Bed, fluid: &Phase<D>, a: usize, viscosity: f64, time_step: f64) -> f64 {
    let walls = fluid.wall_sums[a];
    match bed {
        Bed::Slip => 0.0,
        Bed::NoSlip(_) => {
            let volumes = (fluid.lattice_volume, fluid.lattice_volume);
            viscous_pair::coefficient(time_step, volumes, 2.0 * fluid.moment[a], walls.mirrored, 2.0 * viscosity)
        }
        Bed::Rough { level, origin_offset, law } => {
            // twice Σ V |∂W| over the wall is a particle's share of the bed's area
            let area = -2.0 * fluid.lattice_volume / fluid.lattice.gradient * walls.arm;
            if area <= 0.0 || area.is_nan() {
                return 0.0;
            }
            let normal = height_axis(D);
            let mut along = fluid.velocity[a];
            along[normal] = 0.0;
            let distance = fluid.position[a][normal] - level + origin_offset;
            time_step * fluid.lattice_volume * area * law.stress_coefficient(along.norm(), distance, fluid.density)
        }
    }
}
