//! The two passes before the iteration: all that stays over a solve, then the diagonal and the first residual.

use super::ViscousSolve;
use super::system::{BlockSums, Coefficients, GROUPS, LaneVector, Unknowns, ViscousSystem};
use super::update::{load_columns, store_columns, store_record};
use crate::lanes::algebra::{
    accumulate, deviatoric_rate, difference, dot, invariant, load, load_tensor, load_vector, product, scaled_tensor,
    zero_vector,
};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::material::turbulence::dynamic_eddy_viscosity;
use crate::parallel::prelude::*;
use crate::weakly_compressible::energy::sum_of_lanes;
use crate::weakly_compressible::passes::layout;
use crate::weakly_compressible::passes::records::{self, Records};
use crate::weakly_compressible::terms::{no_slip, wall_slip};
use crate::weakly_compressible::{BLOCK, Particles};

impl<const D: usize> ViscousSolve<'_, D> {
    /// Pair vectors, coefficients, and what the diagonal needs of a neighbour in the place of its stress.
    pub(crate) fn prepare(&self, particles: &Particles<D>, system: &mut ViscousSystem<D>) {
        (
            system.coefficients.par_chunks_mut(GROUPS),
            system.pair_vectors.par_chunks_mut(self.model.list.region),
            system.stresses.blocks_mut(particles.flow_count(), BLOCK),
        )
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (coefficients, pair_vectors, stiffnesses))| {
                self.model.instruction_set.run(CoefficientPass {
                    constants: self,
                    particles,
                    block,
                    coefficients,
                    pair_vectors,
                    stiffnesses,
                });
            });
    }

    /// Diagonal and residual; the increment starts from zero.
    pub(crate) fn residual_of_start(&self, particles: &Particles<D>, system: &mut ViscousSystem<D>) {
        let (stiffnesses, pair_vectors) = (&system.stresses, &system.pair_vectors);
        (system.coefficients.par_chunks_mut(GROUPS), system.unknowns.par_chunks_mut(GROUPS), &mut system.sums)
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (coefficients, unknowns, sums))| {
                self.model.instruction_set.run(ResidualPass {
                    constants: self,
                    particles,
                    stiffnesses,
                    pair_vectors,
                    block,
                    coefficients,
                    unknowns,
                    sums,
                });
            });
    }
}

struct CoefficientPass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    particles: &'a Particles<D>,
    block: usize,
    coefficients: &'a mut [Coefficients<D>],
    pair_vectors: &'a mut [LaneVector<D>],
    stiffnesses: &'a mut [[f64; 4]],
}

impl<const D: usize> LanePass for CoefficientPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, block, coefficients, pair_vectors, stiffnesses } = self;
        let places = const { layout::geometry(D).div_ceil(4) };
        let region_start = block * constants.model.list.region;
        let quads = const { (D * D).div_ceil(4) };
        let smoothing_length = constants.model.kernel.smoothing_length();
        let mixing_area = constants.model.mixing_area();
        let out = stiffnesses.chunks_mut(LANES * quads);
        for (offset, (coefficients, stiffnesses)) in coefficients.iter_mut().zip(out).enumerate() {
            let group = constants.model.list.group(block * GROUPS + offset);
            let own = constants.pairs.geometry.load::<V>(places, &group.own);
            let place = records::vector::<V, D>(&own, 0);
            let volume = records::scalar(&own, D);
            let mut closure = zero_vector::<V, D>();
            let weights = &constants.pairs.weights[group.first_pair..];
            let (flow_weights, wall_weights) = weights.split_at(group.flow.len());
            let stored = &mut pair_vectors[group.first_pair - region_start..];
            for ((b, weight), stored) in group.flow.zip(flow_weights).zip(stored) {
                let record = constants.pairs.geometry.load_start::<V>(places, const { D.div_ceil(4) }, &b);
                let position = records::vector::<V, D>(&record, 0);
                let mut pair = difference(&place, &position);
                for i in 0..D {
                    pair[i] = V::load(weight) * pair[i];
                    stored[i] = pair[i].to_array();
                }
                accumulate(&mut closure, V::splat(1.0), &pair);
            }
            let first = block * BLOCK + offset * LANES;
            let last = (first + LANES).min(particles.flow_count());
            let gradient = load_tensor::<V, D>(&particles.velocity_gradient[first..last]);
            let law = &constants.model.rheology;
            let (held, held_share) = law.viscosity_without_pressure(&gradient, &particles.viscosity[first..last]);
            let correction = particles.correction.load::<V>(first / LANES);
            let half_share = V::splat(0.5) * held_share;
            let shared = V::splat(1.0) - half_share;
            let (mut by_walls, mut resistance) = (zero_vector::<V, D>(), V::splat(0.0));
            for (w, weight) in group.wall.zip(wall_weights) {
                let record = constants.pairs.geometry.load_start::<V>(places, const { D.div_ceil(4) }, &w);
                let position = records::vector::<V, D>(&record, 0);
                let places = w.places_from(particles.flow_count());
                let w = places.indices();
                let normal = gather_vectors::<V, D>(&particles.walls.normal, &w);
                let depth: V = gather(&particles.walls.depth, &w);
                let r = difference(&place, &position);
                let factor = wall_slip::factor(&r, &normal, depth, smoothing_length, wall_slip::LIMIT);
                // a smooth wall has no traction along it, and across it the pressure alone
                let smoothness: V = gather(&particles.walls.smoothness, &w);
                let rough = V::load(weight) * (V::splat(1.0) - smoothness);
                accumulate(&mut closure, shared * rough * factor, &r);
                accumulate(&mut by_walls, half_share * rough * factor, &r);
                let stretch = no_slip::stretch(&normal, &r, &product(&correction, &r));
                resistance = resistance - rough * no_slip::response(factor) * stretch;
            }
            let mut viscosity = load::<V>(&particles.viscosity[first..last]);
            if mixing_area > 0.0 {
                let rate = deviatoric_rate(&gradient);
                let density = load::<V>(&particles.density[first..last]);
                viscosity = viscosity + dynamic_eddy_viscosity(density, mixing_area, invariant(2.0, &rate));
            }
            let stiffness = (viscosity / volume).sqrt();
            store_record(&scaled_tensor(stiffness, &correction), stiffnesses);
            let stretched = product(&correction, &by_walls);
            let counted = V::splat(mean_of_block::<D>()) * viscosity * dot(&stretched, &stretched);
            let none = V::splat(0.0);
            let hold = ((held + held) - (counted / resistance).if_less(none, resistance, none)).max(none);
            coefficients.shared = shared.to_array();
            coefficients.hold = hold.to_array();
            coefficients.closure = store_columns(&closure);
            for i in 0..D {
                coefficients.correction[i] = store_columns(&correction[i]);
            }
            coefficients.twice_viscosity = (V::splat(2.0) * viscosity).to_array();
            coefficients.mass = [1.0; LANES];
            coefficients.mass[..last - first].copy_from_slice(&particles.mass[first..last]);
            let impulse_volume = V::splat(constants.time_step) * volume;
            coefficients.impulse_volume = impulse_volume.to_array();
            coefficients.inertia = (V::load(&coefficients.mass) + impulse_volume * hold * resistance).to_array();
        }
    }
}

/// Mean over the diagonal of |dev sym (e_i ⊗ g)|² in parts of ½ g² `[-]`: its block is ½ g² I + (½ − 1/D) g ⊗ g, in the plane a number.
const fn mean_of_block<const D: usize>() -> f64 {
    1.0 + (1.0 - 2.0 / D as f64) / D as f64
}

struct ResidualPass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    particles: &'a Particles<D>,
    stiffnesses: &'a Records,
    pair_vectors: &'a [LaneVector<D>],
    block: usize,
    coefficients: &'a mut [Coefficients<D>],
    unknowns: &'a mut [Unknowns<D>],
    sums: &'a mut BlockSums,
}

impl<const D: usize> LanePass for ResidualPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, stiffnesses, pair_vectors, block, coefficients, unknowns, sums } = self;
        let quads = const { (D * D).div_ceil(4) };
        let (mut residual_sum, mut descent) = (V::splat(0.0), V::splat(0.0));
        for (offset, (coefficients, unknowns)) in coefficients.iter_mut().zip(unknowns).enumerate() {
            let group = constants.model.list.group(block * GROUPS + offset);
            let mut stiffness_sum = V::splat(0.0);
            for (b, pair) in group.flow.zip(&pair_vectors[group.first_pair..]) {
                let stiffness = records::tensor::<V, D>(&stiffnesses.load::<V>(quads, &b), 0);
                let stretched = product(&stiffness, &load_columns(pair));
                stiffness_sum = stiffness_sum + dot(&stretched, &stretched);
            }
            let share = mean_of_block::<D>();
            let mut own = zero_vector::<V, D>();
            for i in 0..D {
                for j in 0..D {
                    own[i] = own[i] + V::load(&coefficients.correction[i][j]) * V::load(&coefficients.closure[j]);
                }
            }
            let impulse_volume = V::load(&coefficients.impulse_volume);
            let volume = impulse_volume / V::splat(constants.time_step);
            let (mass, inertia) = (V::load(&coefficients.mass), V::load(&coefficients.inertia));
            let stiffness =
                V::splat(0.5) * V::load(&coefficients.twice_viscosity) * dot(&own, &own) + volume * stiffness_sum;
            let inverse_diagonal = V::splat(1.0) / (inertia + V::splat(share) * impulse_volume * stiffness);
            coefficients.inverse_diagonal = inverse_diagonal.to_array();
            let first = block * BLOCK + offset * LANES;
            let last = (first + LANES).min(particles.flow_count());
            let acceleration = load_vector::<V, D>(&particles.acceleration[first..last]);
            for i in 0..D {
                let residual = V::splat(constants.time_step) * mass * acceleration[i];
                residual_sum = residual_sum + residual * residual / mass;
                descent = descent + residual * residual * inverse_diagonal;
                unknowns.residual[i] = residual.to_array();
            }
            unknowns.increment = [[0.0; LANES]; D];
            unknowns.direction = [[0.0; LANES]; D];
        }
        *sums = BlockSums { residual: sum_of_lanes(residual_sum), descent: sum_of_lanes(descent), curvature: 0.0 };
    }
}
