//! Friction of what the fluid flows over.

use super::super::neighbours::Pair;
use super::super::numerics::ProjectionNumerics;
use super::super::phase::Phase;
use super::super::scene::{Bed, height_axis};
use super::super::terms::viscous_pair;

/// What the bed holds a fluid particle with, Δt Σ_w k_aw `[kg]`, at a dynamic viscosity of the particle `[Pa·s]`.
pub(crate) fn friction<const D: usize>(
    bed: Bed,
    fluid: &Phase<D>,
    a: usize,
    viscosity: f64,
    numerics: &ProjectionNumerics,
    time_step: f64,
) -> f64 {
    let normal = height_axis(D);
    match bed {
        Bed::Slip => 0.0,
        Bed::NoSlip(level) => {
            // the wall particle moves against the partner, so that the velocity is 0 at the wall
            let height = (fluid.position[a][normal] - level).max(numerics.least_wall_height * fluid.spacing);
            let held = |sum, pair: &Pair<D>| {
                let depth = (pair.separation[normal] - height).max(0.0);
                let mirror = (1.0 + depth / height).min(numerics.largest_mirror);
                let volumes = (fluid.volume[a], fluid.lattice_volume);
                let moments = 2.0 * fluid.moment[a];
                sum + viscous_pair::coefficient(time_step, volumes, moments, pair.gradient, 2.0 * viscosity) * mirror
            };
            fluid.wall_pairs.of(a).iter().fold(0.0, held)
        }
        Bed::Rough { level, origin_offset, law } => {
            // twice Σ V |∂W| over the wall is a particle's share of the bed's area
            let scale = -2.0 * fluid.lattice_volume / fluid.lattice.gradient;
            let arms = |sum, pair: &Pair<D>| sum + pair.gradient * pair.separation[normal];
            let area = scale * fluid.wall_pairs.of(a).iter().fold(0.0, arms);
            if area <= 0.0 || area.is_nan() {
                return 0.0;
            }
            let mut along = fluid.velocity[a];
            along[normal] = 0.0;
            let distance = fluid.position[a][normal] - level + origin_offset;
            time_step * fluid.volume[a] * area * law.stress_coefficient(along.norm(), distance, fluid.density)
        }
    }
}
