//! Velocities of the wall particles, extrapolated from the flow.
//!
//! The velocity gradient takes the line through zero at the surface: no slip. Continuity takes the same of grains, whose
//! profile is resolved. A liquid's boundary layer may be thinner than a spacing, and a flow that slides over its wall as
//! over ice would then be torn apart by the wall's opposite velocity, which the pressure answers with work: 3 % of what
//! gravity gave a collapsing column of water. So continuity takes for a liquid the line that fits the velocity along the
//! surface best, whatever it is there: for a resolved profile the same line, for a sliding flow its velocity.
//!
//! Grains that come round an edge leave the wall behind it: nothing presses them on it, but a kernel that reaches over the edge would shear
//! them. So a wall particle moves along with grains that cross its plane from behind, as one of a smooth wall does.

use super::wall_stress::BLOCK;
use crate::lanes::algebra::{difference, dot, store_vector, zero_vector};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::terms::wall_extrapolation as terms;
use crate::weakly_compressible::{Model, PairData, Particles};

/// Velocity `[m/s]` of every wall particle: −d_w Σ V W v_f d_f / Σ V W d_f², the line through zero at the
/// surface that fits the flow best, relative to the wall's own velocity. A smooth wall has the flow's mean velocity
/// along its surface.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let (first, count) = (particles.flow_count(), particles.wall_count());
    let result = &mut pairs.wall_velocity;
    result.resize(count, (Vector::zeros(), Vector::zeros()));
    let shared = &*particles;
    result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
        let first_group = model.list.flow_groups() + block * (BLOCK / LANES);
        model.instruction_set.run(Pass { model, particles: shared, first_group, out });
    });
    for (offset, (velocity, sliding)) in result.iter().enumerate() {
        particles.velocity[first + offset] = *velocity;
        particles.walls.sliding_velocity[offset] = *sliding;
    }
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    first_group: usize,
    out: &'a mut [(Vector<D>, Vector<D>)],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, first_group, out } = self;
        let (slides, solid) = (model.slides(), model.rheology.is_solid());
        let nearest = V::splat(terms::NEAREST * model.spacing);
        let smallest = V::splat(terms::DRY * model.spacing * model.spacing);
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = model.list.group(first_group + offset);
            let place = gather_vectors::<V, D>(&particles.position, &group.own);
            let places = group.own.places_from(particles.flow_count());
            let places = places.indices();
            let normal = gather_vectors::<V, D>(&particles.walls.normal, &places);
            let wall_velocity = gather_vectors::<V, D>(&particles.walls.velocity, &places);
            let depth: V = gather(&particles.walls.depth, &places);
            let smoothness: V = gather(&particles.walls.smoothness, &places);
            let (mut moment, mut first_moment, mut weights) = (V::splat(0.0), V::splat(0.0), V::splat(0.0));
            // flow from behind the plane to its front
            let mut crossing = V::splat(0.0);
            let (mut sums, mut means) = (zero_vector::<V, D>(), zero_vector::<V, D>());
            for f in group.flow {
                let position = gather_vectors::<V, D>(&particles.position, &f);
                let velocity = gather_vectors::<V, D>(&particles.velocity, &f);
                let volume: V = gather(&particles.volume, &f);
                let r = difference(&position, &place);
                let height = dot(&r, &normal) - depth;
                let distance = height.max(nearest);
                let weight = volume * model.kernel.value(dot(&r, &r));
                let lever = weight * distance;
                moment = moment + lever * distance;
                first_moment = first_moment + lever;
                weights = weights + weight;
                for axis in 0..D {
                    let slip = velocity[axis] - wall_velocity[axis];
                    sums[axis] = sums[axis] + lever * slip;
                    means[axis] = means[axis] + weight * slip;
                    let behind = weight.if_less(height, V::splat(0.0), V::splat(0.0));
                    crossing = crossing + behind * slip * normal[axis];
                }
            }
            let smoothness =
                if solid { V::splat(1.0).if_less(V::splat(0.0), crossing, smoothness) } else { smoothness };
            // a dry wall moves at the prescribed velocity
            let slope = (depth / moment.max(smallest)).where_less(smallest, moment);
            let wet = terms::wet_inverse(weights);
            let mut mean_slip = means;
            let mut fitted_slip = means;
            let spread = terms::spread(weights, first_moment, moment, model.spacing);
            for axis in 0..D {
                mean_slip[axis] = wet * means[axis];
                let growth = (weights * sums[axis] - first_moment * means[axis]) / spread;
                fitted_slip[axis] = mean_slip[axis] - growth * (wet * first_moment + depth);
            }
            let (mean_normal, fitted_normal) = (dot(&mean_slip, &normal), dot(&fitted_slip, &normal));
            let opposite_normal = slope * dot(&sums, &normal);
            let mut velocity = wall_velocity;
            let mut sliding = wall_velocity;
            for axis in 0..D {
                // across the surface the velocity is opposite, along it as the surface has it
                let across = opposite_normal * normal[axis];
                let along = slope * sums[axis] - across;
                let smooth = mean_slip[axis] - mean_normal * normal[axis];
                let fitted = fitted_slip[axis] - fitted_normal * normal[axis];
                velocity[axis] = wall_velocity[axis] - across - along + smoothness * (along + smooth);
                sliding[axis] = wall_velocity[axis] - across + fitted + smoothness * (smooth - fitted);
            }
            if !slides {
                sliding = velocity;
            }
            let (mut velocities, mut slidings) = ([Vector::zeros(); LANES], [Vector::zeros(); LANES]);
            store_vector(&velocity, &mut velocities);
            store_vector(&sliding, &mut slidings);
            for (lane, out) in out.iter_mut().enumerate() {
                *out = (velocities[lane], slidings[lane]);
            }
        }
    }
}
