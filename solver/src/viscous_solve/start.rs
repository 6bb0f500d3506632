//! The two passes before the iteration: the gradient of the old velocities with all that stays over a solve, then the
//! residual and the diagonal.

use super::ViscousSolve;
use super::system::{Coefficients, GROUPS, LaneVector, Sums, Unknowns, ViscousSystem};
use super::update::{add_lanes, flux_of, own_part, store_columns, store_record};
use crate::lanes::algebra::{
    accumulate, accumulate_outer, deviatoric_rate, difference, dot, invariant, load, load_tensor, load_vector,
    matrix_product, product, scaled_tensor, zero_tensor, zero_vector,
};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::neighbours::BLOCK;
use crate::operators::geometry;
use crate::particles::Particles;
use crate::records::{self, Records};
use crate::terms::hourglass::WALL_FACTOR_LIMIT;
use rayon::prelude::*;

/// The squares of the norms that a solve starts with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    pub(super) explicit: f64,
    pub(super) viscous: f64,
    pub(super) residual: f64,
    pub(super) descent: f64,
}

impl<const D: usize> ViscousSolve<'_, D> {
    /// Pair vectors, coefficients and viscosities, fluxes of the old velocities, and what the diagonal needs.
    pub(super) fn gradient_of_start(&self, particles: &Particles<D>, system: &mut ViscousSystem<D>) {
        let flow = particles.flow_count();
        let velocities = &system.velocities;
        (
            system.coefficients.par_chunks_mut(GROUPS),
            system.pair_vectors.par_chunks_mut(self.list.region()),
            system.fluxes.blocks_mut(flow, BLOCK),
            system.stiffnesses.blocks_mut(flow, BLOCK),
        )
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (coefficients, pair_vectors, fluxes, stiffnesses))| {
                self.instruction_set.run(GradientPass {
                    constants: self,
                    particles,
                    velocities,
                    block,
                    coefficients,
                    pair_vectors,
                    fluxes,
                    stiffnesses,
                });
            });
    }

    /// Residual and diagonal; the increment starts from zero.
    pub(super) fn residual_of_start(&self, particles: &Particles<D>, system: &mut ViscousSystem<D>) -> Start {
        let (fluxes, stiffnesses, pair_vectors) = (&system.fluxes, &system.stiffnesses, &system.pair_vectors);
        (system.coefficients.par_chunks_mut(GROUPS), system.unknowns.par_chunks_mut(GROUPS), &mut system.sums)
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (coefficients, unknowns, sums))| {
                self.instruction_set.run(ResidualPass {
                    constants: self,
                    particles,
                    fluxes,
                    stiffnesses,
                    pair_vectors,
                    block,
                    coefficients,
                    unknowns,
                    sums,
                });
            });
        Start {
            explicit: system.sum(|sums| sums.explicit),
            viscous: system.sum(|sums| sums.viscous),
            residual: system.sum(|sums| sums.residual),
            descent: system.sum(|sums| sums.descent),
        }
    }

    /// 2 η `[Pa·s]` of eight particles, the eddy viscosity (5) included.
    #[inline(always)]
    fn twice_viscosity<V: Lanes>(&self, shear_rate: V, pressure: V, density: V) -> V {
        let (rates, pressures) = (shear_rate.to_array(), pressure.to_array());
        let mut viscosities = [0.0; LANES];
        for lane in 0..LANES {
            viscosities[lane] = self.rheology.viscosity(rates[lane], pressures[lane]);
        }
        let eddy = density * V::splat(self.mixing_area) * shear_rate;
        V::splat(2.0) * (V::load(&viscosities) + eddy)
    }
}

struct GradientPass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    particles: &'a Particles<D>,
    velocities: &'a Records,
    block: usize,
    coefficients: &'a mut [Coefficients<D>],
    pair_vectors: &'a mut [LaneVector<D>],
    fluxes: &'a mut [[f64; 4]],
    stiffnesses: &'a mut [[f64; 4]],
}

impl<const D: usize> LanePass for GradientPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, velocities, block, coefficients, pair_vectors, fluxes, stiffnesses } = self;
        let places = const { geometry::values(D).div_ceil(4) };
        let region_start = block * constants.list.region();
        let quads = const { (D * D).div_ceil(4) };
        let nearest = V::splat(1e-6 * constants.smoothing_length);
        let out = fluxes.chunks_mut(LANES * quads).zip(stiffnesses.chunks_mut(LANES * quads));
        for (offset, (coefficients, (fluxes, stiffnesses))) in coefficients.iter_mut().zip(out).enumerate() {
            let group = constants.list.group(block * GROUPS + offset);
            let own = particles.geometry_records.load::<V>(places, &group.own);
            let place = records::vector::<V, D>(&own, 0);
            let volume = records::scalar(&own, D);
            let pressure = records::scalar(&own, D + 1);
            let record = velocities.load::<V>(const { D.div_ceil(4) }, &group.own);
            let velocity_a = records::vector::<V, D>(&record, 0);
            let mut closure = zero_vector::<V, D>();
            let mut gradient = zero_tensor::<V, D>();
            let weights = &particles.pair_weights[group.first_pair..];
            let (flow_weights, wall_weights) = weights.split_at(group.flow.len());
            let stored = &mut pair_vectors[group.first_pair - region_start..];
            for ((b, weight), stored) in group.flow.zip(flow_weights).zip(stored) {
                let record = particles.geometry_records.load_start::<V>(places, const { D.div_ceil(4) }, &b);
                let position = records::vector::<V, D>(&record, 0);
                let record = velocities.load::<V>(const { D.div_ceil(4) }, &b);
                let velocity = records::vector::<V, D>(&record, 0);
                let mut pair = difference(&place, &position);
                for i in 0..D {
                    pair[i] = V::load(weight) * pair[i];
                    stored[i] = pair[i].to_array();
                }
                accumulate(&mut closure, V::splat(1.0), &pair);
                accumulate_outer(&mut gradient, V::splat(1.0), &velocity, &pair);
            }
            for (w, weight) in group.wall.zip(wall_weights) {
                let record = particles.geometry_records.load_start::<V>(places, const { D.div_ceil(4) }, &w);
                let position = records::vector::<V, D>(&record, 0);
                let normal = gather_vectors::<V, D>(&particles.wall_normal, &w);
                let wall_velocity = gather_vectors::<V, D>(&particles.wall_velocity, &w);
                let depth: V = gather(&particles.wall_depth, &w);
                let r = difference(&place, &position);
                // (20); the distance of a to the surface is n·r − d_w
                let distance = (dot(&normal, &r) - depth).max(nearest);
                let factor = (V::splat(1.0) + depth / distance).min(V::splat(WALL_FACTOR_LIMIT));
                // no traction along a smooth wall, and across it the pressure alone
                let smoothness: V = gather(&particles.wall_smoothness, &w);
                let weight = V::load(weight) * factor * (V::splat(1.0) - smoothness);
                accumulate(&mut closure, weight, &r);
                accumulate_outer(&mut gradient, weight, &wall_velocity, &r);
            }
            for i in 0..D {
                accumulate(&mut gradient[i], -velocity_a[i], &closure);
            }
            let first = block * BLOCK + offset * LANES;
            let last = (first + LANES).min(particles.flow_count());
            let correction = load_tensor::<V, D>(&particles.correction[first..last]);
            let density = load::<V>(&particles.density[first..last]);
            let rate = deviatoric_rate(&matrix_product(&gradient, &correction));
            let twice_viscosity = constants.twice_viscosity(invariant(2.0, &rate), pressure, density);
            let stress = scaled_tensor(twice_viscosity, &rate);
            store_record(&matrix_product(&stress, &correction), fluxes);
            let stiffness = (V::splat(0.5) * twice_viscosity / volume).sqrt();
            store_record(&scaled_tensor(stiffness, &correction), stiffnesses);
            coefficients.closure = store_columns(&closure);
            for i in 0..D {
                coefficients.correction[i] = store_columns(&correction[i]);
            }
            coefficients.twice_viscosity = twice_viscosity.to_array();
            coefficients.mass = [1.0; LANES];
            coefficients.mass[..last - first].copy_from_slice(&particles.mass[first..last]);
            coefficients.impulse_volume = (V::splat(constants.time_step) * volume).to_array();
        }
    }
}

struct ResidualPass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    particles: &'a Particles<D>,
    fluxes: &'a Records,
    stiffnesses: &'a Records,
    pair_vectors: &'a [LaneVector<D>],
    block: usize,
    coefficients: &'a mut [Coefficients<D>],
    unknowns: &'a mut [Unknowns<D>],
    sums: &'a mut Sums,
}

impl<const D: usize> LanePass for ResidualPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, fluxes, stiffnesses, pair_vectors, block, coefficients, unknowns, sums } =
            self;
        let quads = const { (D * D).div_ceil(4) };
        let zero = V::splat(0.0);
        let (mut explicit, mut viscous, mut residual_sum, mut descent) = (zero, zero, zero, zero);
        for (offset, (coefficients, unknowns)) in coefficients.iter_mut().zip(unknowns).enumerate() {
            let group = constants.list.group(block * GROUPS + offset);
            let mut force = own_part(&flux_of(fluxes, &group), &coefficients.closure);
            let mut stiffness_sum = zero;
            for (b, pair) in group.flow.zip(&pair_vectors[group.first_pair..]) {
                let mut r = zero_vector::<V, D>();
                for i in 0..D {
                    r[i] = V::load(&pair[i]);
                }
                let flux = records::tensor::<V, D>(&fluxes.load::<V>(quads, &b), 0);
                let stiffness = records::tensor::<V, D>(&stiffnesses.load::<V>(quads, &b), 0);
                accumulate(&mut force, V::splat(1.0), &product(&flux, &r));
                let stretched = product(&stiffness, &r);
                stiffness_sum = stiffness_sum + dot(&stretched, &stretched);
            }
            // The diagonal block of |dev sym (e_i ⊗ g)|² is ½ g² I + (½ − 1/D) g ⊗ g: in the plane a number, in space
            // taken for its mean.
            let share = 1.0 + (1.0 - 2.0 / D as f64) / D as f64;
            let mut own = zero_vector::<V, D>();
            for i in 0..D {
                for j in 0..D {
                    own[i] = own[i] + V::load(&coefficients.correction[i][j]) * V::load(&coefficients.closure[j]);
                }
            }
            let impulse_volume = V::load(&coefficients.impulse_volume);
            let volume = impulse_volume / V::splat(constants.time_step);
            let mass = V::load(&coefficients.mass);
            let stiffness =
                V::splat(0.5) * V::load(&coefficients.twice_viscosity) * dot(&own, &own) + volume * stiffness_sum;
            let inverse_diagonal = V::splat(1.0) / (mass + V::splat(share) * impulse_volume * stiffness);
            coefficients.inverse_diagonal = inverse_diagonal.to_array();
            let first = block * BLOCK + offset * LANES;
            let last = (first + LANES).min(particles.flow_count());
            let acceleration = load_vector::<V, D>(&particles.acceleration[first..last]);
            for i in 0..D {
                let push = V::splat(constants.time_step) * mass * acceleration[i];
                let drag = impulse_volume * force[i];
                let residual = push + drag;
                explicit = explicit + push * push / mass;
                viscous = viscous + drag * drag / mass;
                residual_sum = residual_sum + residual * residual / mass;
                descent = descent + residual * residual * inverse_diagonal;
                unknowns.residual[i] = residual.to_array();
            }
            unknowns.increment = [[0.0; LANES]; D];
            unknowns.direction = [[0.0; LANES]; D];
        }
        *sums = Sums {
            explicit: add_lanes(explicit),
            viscous: add_lanes(viscous),
            residual: add_lanes(residual_sum),
            descent: add_lanes(descent),
            curvature: 0.0,
        };
    }
}
