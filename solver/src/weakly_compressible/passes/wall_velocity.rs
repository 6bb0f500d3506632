//! Velocities of the wall particles, extrapolated from the flow.

use super::PairData;
use super::wall_stress::BLOCK;
use crate::lanes::algebra::{difference, dot, store_vector, zero_vector};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::vector::Vector;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::wall_extrapolation as terms;
use rayon::prelude::*;

/// Velocity `[m/s]` of every wall particle: −d_w Σ V W v_f d_f / Σ V W d_f², the line through zero at the
/// surface that fits the flow best, relative to the wall's own velocity. A smooth wall has the flow's mean velocity
/// along its surface.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let (first, count) = (particles.flow_count(), particles.wall_count());
    let result = &mut pairs.wall_velocity;
    result.resize(count, Vector::zeros());
    let shared = &*particles;
    result.par_chunks_mut(BLOCK).enumerate().with_min_len(4).for_each(|(block, out)| {
        let first_group = model.list.flow_groups() + block * (BLOCK / LANES);
        model.instruction_set.run(Pass { model, particles: shared, first_group, out });
    });
    particles.velocity[first..first + count].copy_from_slice(result);
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    first_group: usize,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, first_group, out } = self;
        let nearest = V::splat(terms::NEAREST * model.spacing);
        let smallest = V::splat(terms::DRY * model.spacing * model.spacing);
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = model.list.group(first_group + offset);
            let place = gather_vectors::<V, D>(&particles.position, &group.own);
            let normal = gather_vectors::<V, D>(&particles.wall_normal, &group.own);
            let wall_velocity = gather_vectors::<V, D>(&particles.wall_velocity, &group.own);
            let depth: V = gather(&particles.wall_depth, &group.own);
            let smoothness: V = gather(&particles.wall_smoothness, &group.own);
            let (mut moment, mut weights) = (V::splat(0.0), V::splat(0.0));
            let (mut sums, mut means) = (zero_vector::<V, D>(), zero_vector::<V, D>());
            for f in group.flow {
                let position = gather_vectors::<V, D>(&particles.position, &f);
                let velocity = gather_vectors::<V, D>(&particles.velocity, &f);
                let volume: V = gather(&particles.volume, &f);
                let r = difference(&position, &place);
                let distance = (dot(&r, &normal) - depth).max(nearest);
                let weight = volume * model.kernel.value(dot(&r, &r));
                let lever = weight * distance;
                moment = moment + lever * distance;
                weights = weights + weight;
                for axis in 0..D {
                    let slip = velocity[axis] - wall_velocity[axis];
                    sums[axis] = sums[axis] + lever * slip;
                    means[axis] = means[axis] + weight * slip;
                }
            }
            // a dry wall moves as it is told
            let slope = (depth / moment.max(smallest)).where_less(smallest, moment);
            let wet = terms::wet_inverse(weights);
            let mut sliding = means;
            for axis in 0..D {
                sliding[axis] = wet * means[axis] + slope * sums[axis];
            }
            let along_normal = dot(&sliding, &normal);
            let mut velocity = wall_velocity;
            for axis in 0..D {
                let slides = smoothness * (sliding[axis] - along_normal * normal[axis]);
                velocity[axis] = wall_velocity[axis] - slope * sums[axis] + slides;
            }
            store_vector(&velocity, out);
        }
    }
}
