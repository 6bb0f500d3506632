//! The passes of an iteration: search direction, stresses of the direction, their divergence, and the descent.

use super::system::{BlockSums, Coefficients, GROUPS, LaneVector, Unknowns, ViscousSystem};
use super::{ViscousSolve, lane};
use crate::lanes::algebra::{
    accumulate, accumulate_outer, deviatoric_rate, matrix_product, product, scaled_tensor, zero_tensor, zero_vector,
};
use crate::lanes::{LANES, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::weakly_compressible::BLOCK;
use crate::weakly_compressible::energy::sum_of_lanes;
use crate::weakly_compressible::passes::records::{self, Records};

impl<const D: usize> ViscousSolve<'_, D> {
    /// p ← D⁻¹ r + growth · p.
    pub fn next_direction(&self, system: &mut ViscousSystem<D>, flow: usize, growth: f64) {
        let coefficients = &system.coefficients;
        (system.unknowns.par_chunks_mut(GROUPS), system.velocities.blocks_mut(flow, BLOCK))
            .enumerate()
            .with_min_len(16)
            .for_each(|(block, (unknowns, velocities))| {
                let coefficients = &coefficients[block * GROUPS..];
                self.model.instruction_set.run(DirectionPass { coefficients, unknowns, velocities, growth });
            });
    }

    /// Puts the increment where the passes look for a direction.
    pub(super) fn show_increments(&self, system: &mut ViscousSystem<D>, flow: usize) {
        let ViscousSystem { unknowns, velocities, .. } = system;
        (velocities.blocks_mut(flow, BLOCK), unknowns.par_chunks(GROUPS)).for_each(|(velocities, unknowns)| {
            for (place, velocity) in velocities.iter_mut().enumerate() {
                let increment = lane(&unknowns[place / LANES].increment, place % LANES);
                velocity[..D].copy_from_slice(increment.as_slice());
            }
        });
    }

    /// s L of the direction.
    pub(super) fn stresses(&self, system: &mut ViscousSystem<D>, flow: usize) {
        let ViscousSystem { coefficients, velocities, pair_vectors, stresses, .. } = system;
        stresses.blocks_mut(flow, BLOCK).enumerate().with_min_len(4).for_each(|(block, stresses)| {
            self.model.instruction_set.run(StressPass {
                constants: self,
                coefficients: &coefficients[block * GROUPS..],
                velocities,
                pair_vectors,
                block,
                stresses,
            });
        });
    }

    /// (M + Δt K) p and p·(M + Δt K) p.
    pub(super) fn divergence(&self, system: &mut ViscousSystem<D>) {
        let ViscousSystem { coefficients, unknowns, pair_vectors, stresses, sums, .. } = system;
        (unknowns.par_chunks_mut(GROUPS), sums).enumerate().with_min_len(4).for_each(|(block, (unknowns, sums))| {
            self.model.instruction_set.run(DivergencePass {
                constants: self,
                coefficients: &coefficients[block * GROUPS..],
                stresses,
                pair_vectors,
                block,
                unknowns,
                sums,
            });
        });
    }

    /// δ ← δ + step · p, r ← r − step · (M + Δt K) p.
    pub(super) fn descend(&self, system: &mut ViscousSystem<D>, step: f64) {
        let coefficients = &system.coefficients;
        (system.unknowns.par_chunks_mut(GROUPS), &mut system.sums).enumerate().with_min_len(16).for_each(
            |(block, (unknowns, sums))| {
                let coefficients = &coefficients[block * GROUPS..];
                self.model.instruction_set.run(DescentPass { coefficients, unknowns, step, sums });
            },
        );
    }
}

/// A vector's components, each for eight particles.
#[inline(always)]
pub(super) fn store_columns<V: Lanes, const D: usize>(vector: &[V; D]) -> LaneVector<D> {
    let mut columns = [[0.0; LANES]; D];
    for i in 0..D {
        columns[i] = vector[i].to_array();
    }
    columns
}

#[inline(always)]
pub(super) fn load_columns<V: Lanes, const D: usize>(columns: &LaneVector<D>) -> [V; D] {
    let mut vector = zero_vector::<V, D>();
    for i in 0..D {
        vector[i] = V::load(&columns[i]);
    }
    vector
}

/// Writes a tensor into the records of eight particles.
#[inline(always)]
pub(super) fn store_record<V: Lanes, const D: usize>(tensor: &[[V; D]; D], out: &mut [[f64; 4]]) {
    let quads = const { (D * D).div_ceil(4) };
    for quad in 0..quads {
        let mut values = [V::splat(0.0); 4];
        for (k, value) in values.iter_mut().enumerate() {
            let place = 4 * quad + k;
            if place < D * D {
                *value = tensor[place / D][place % D];
            }
        }
        V::store_quads(&values, out, quads, quad);
    }
}

struct DirectionPass<'a, const D: usize> {
    coefficients: &'a [Coefficients<D>],
    unknowns: &'a mut [Unknowns<D>],
    velocities: &'a mut [[f64; 4]],
    growth: f64,
}

impl<const D: usize> LanePass for DirectionPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let records = self.velocities.chunks_mut(LANES);
        for ((coefficients, unknowns), record) in self.coefficients.iter().zip(self.unknowns).zip(records) {
            let mut quad = [V::splat(0.0); 4];
            for i in 0..D {
                let descent = V::load(&unknowns.residual[i]) * V::load(&coefficients.inverse_diagonal);
                quad[i] = descent + V::splat(self.growth) * V::load(&unknowns.direction[i]);
                unknowns.direction[i] = quad[i].to_array();
            }
            V::store_quads(&quad, record, 1, 0);
        }
    }
}

struct StressPass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    coefficients: &'a [Coefficients<D>],
    velocities: &'a Records,
    pair_vectors: &'a [LaneVector<D>],
    block: usize,
    stresses: &'a mut [[f64; 4]],
}

impl<const D: usize> LanePass for StressPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, coefficients, velocities, pair_vectors, block, stresses } = self;
        let records_of_group = const { LANES * (D * D).div_ceil(4) };
        for (offset, (coefficients, out)) in coefficients.iter().zip(stresses.chunks_mut(records_of_group)).enumerate()
        {
            let group = constants.model.list.group(block * GROUPS + offset);
            let own = records::vector::<V, D>(&velocities.load::<V>(1, &group.own), 0);
            let mut gradient = zero_tensor::<V, D>();
            for (b, pair) in group.flow.zip(&pair_vectors[group.first_pair..]) {
                let velocity = records::vector::<V, D>(&velocities.load::<V>(1, &b), 0);
                accumulate_outer(&mut gradient, V::splat(1.0), &velocity, &load_columns(pair));
            }
            let closure = load_columns::<V, D>(&coefficients.closure);
            let mut correction = zero_tensor::<V, D>();
            for i in 0..D {
                accumulate(&mut gradient[i], -own[i], &closure);
                correction[i] = load_columns(&coefficients.correction[i]);
            }
            let rate = deviatoric_rate(&matrix_product(&gradient, &correction));
            let stress = scaled_tensor(V::load(&coefficients.twice_viscosity), &rate);
            store_record(&matrix_product(&stress, &correction), out);
        }
    }
}

struct DivergencePass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    coefficients: &'a [Coefficients<D>],
    stresses: &'a Records,
    pair_vectors: &'a [LaneVector<D>],
    block: usize,
    unknowns: &'a mut [Unknowns<D>],
    sums: &'a mut BlockSums,
}

impl<const D: usize> LanePass for DivergencePass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, coefficients, stresses, pair_vectors, block, unknowns, sums } = self;
        let mut curvature = V::splat(0.0);
        for (offset, (coefficients, unknowns)) in coefficients.iter().zip(unknowns).enumerate() {
            let group = constants.model.list.group(block * GROUPS + offset);
            let own = records::tensor::<V, D>(&stresses.load::<V>(const { (D * D).div_ceil(4) }, &group.own), 0);
            // s_a L_a (Σ w r + Σ_w w β r)
            let mut force = product(&own, &load_columns(&coefficients.closure));
            for (b, pair) in group.flow.zip(&pair_vectors[group.first_pair..]) {
                let stress = records::tensor::<V, D>(&stresses.load::<V>(const { (D * D).div_ceil(4) }, &b), 0);
                accumulate(&mut force, V::splat(1.0), &product(&stress, &load_columns(pair)));
            }
            let (inertia, volume) = (V::load(&coefficients.inertia), V::load(&coefficients.impulse_volume));
            for i in 0..D {
                let direction = V::load(&unknowns.direction[i]);
                let product = inertia * direction - volume * force[i];
                curvature = curvature + direction * product;
                unknowns.product[i] = product.to_array();
            }
        }
        sums.curvature = sum_of_lanes(curvature);
    }
}

struct DescentPass<'a, const D: usize> {
    coefficients: &'a [Coefficients<D>],
    unknowns: &'a mut [Unknowns<D>],
    step: f64,
    sums: &'a mut BlockSums,
}

impl<const D: usize> LanePass for DescentPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let step = V::splat(self.step);
        let (mut residual_sum, mut descent) = (V::splat(0.0), V::splat(0.0));
        for (coefficients, unknowns) in self.coefficients.iter().zip(self.unknowns) {
            let (mass, inverse) = (V::load(&coefficients.mass), V::load(&coefficients.inverse_diagonal));
            for i in 0..D {
                let increment = V::load(&unknowns.increment[i]) + step * V::load(&unknowns.direction[i]);
                let residual = V::load(&unknowns.residual[i]) - step * V::load(&unknowns.product[i]);
                unknowns.increment[i] = increment.to_array();
                unknowns.residual[i] = residual.to_array();
                residual_sum = residual_sum + residual * residual / mass;
                descent = descent + residual * residual * inverse;
            }
        }
        self.sums.residual = sum_of_lanes(residual_sum);
        self.sums.descent = sum_of_lanes(descent);
    }
}
