//! One pass over the neighbours for all that depends on positions and pressure: the moment matrix with its
//! corrections, the corrected pressure gradient, and the stress as the divergence takes it.

use super::correction::corrections;
use crate::kernel::Kernel;
use crate::lanes::algebra::{
    accumulate, deviatoric_rate, difference, dot, invariant, load, load_tensor, matrix_product, product, store_tensor,
    store_vector, zero_tensor, zero_vector,
};
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes};
use crate::material::rheology::Rheology;
use crate::vector::{Tensor, Vector};
use crate::weakly_compressible::neighbours::VerletList;
use crate::weakly_compressible::numerics::MomentumOperator;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::records::{self, Records};
use rayon::prelude::*;
use std::ops::Range;

/// The constants of the pass.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Geometry<'a, const D: usize> {
    pub(crate) kernel: Kernel<D>,
    pub(crate) list: &'a VerletList,
    pub(crate) instruction_set: InstructionSet,
    pub(crate) momentum_operator: MomentumOperator,
    pub(crate) rheology: &'a Rheology,
    /// ζ ρ0 c_s h `[Pa·s]`: viscosity that damps elastic waves below the yield. Without it an arrested layer
    /// swings for ever; a flowing one does not feel it.
    pub(crate) elastic_viscosity: f64,
    /// (C_s Δ)² `[m²]` of the eddy viscosity (5).
    pub(crate) mixing_area: f64,
}

/// Values of a neighbour's record: position, volume, pressure.
pub(crate) const fn values(dimension: usize) -> usize {
    dimension + 2
}

struct Output<'a, const D: usize> {
    correction: &'a mut [Tensor<D>],
    force_correction: &'a mut [Tensor<D>],
    pressure_gradient: &'a mut [Vector<D>],
    flux: &'a mut [Tensor<D>],
    pair_weights: &'a mut [[f64; LANES]],
}

impl<const D: usize> Geometry<'_, D> {
    /// Updates corrections, pressure gradients and fluxes of the flow particles.
    pub(crate) fn run(&self, particles: &mut Particles<D>) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let flow = particles.flow_count();
        let mut records = std::mem::replace(&mut particles.geometry_records, Records::new(0));
        let shared = &*particles;
        records.fill(particles.position.len(), |index, record| {
            record.vector(&shared.position[index]);
            record.scalar(shared.volume[index]);
            record.scalar(shared.pressure[index]);
        });
        particles.geometry_records = records;
        let mut correction = std::mem::take(&mut particles.correction);
        let mut force_correction = std::mem::take(&mut particles.force_correction);
        let mut pressure_gradient = std::mem::take(&mut particles.pressure_gradient);
        let mut flux = std::mem::take(&mut particles.flux);
        let mut pair_weights = std::mem::take(&mut particles.pair_weights);
        let region = self.list.region();
        pair_weights.resize(flow.div_ceil(BLOCK) * region, [0.0; LANES]);
        let shared = &*particles;
        (
            correction.par_chunks_mut(BLOCK),
            force_correction.par_chunks_mut(BLOCK),
            pressure_gradient[..flow].par_chunks_mut(BLOCK),
            flux[..flow].par_chunks_mut(BLOCK),
            pair_weights.par_chunks_mut(region),
        )
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (correction, force_correction, pressure_gradient, flux, pair_weights))| {
                let out = Output { correction, force_correction, pressure_gradient, flux, pair_weights };
                self.instruction_set.run(Pass { constants: self, particles: shared, block, out });
            });
        particles.correction = correction;
        particles.force_correction = force_correction;
        particles.pressure_gradient = pressure_gradient;
        particles.flux = flux;
        particles.pair_weights = pair_weights;
    }
}

struct Pass<'a, const D: usize> {
    constants: &'a Geometry<'a, D>,
    particles: &'a Particles<D>,
    block: usize,
    out: Output<'a, D>,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        const BLOCK: usize = crate::weakly_compressible::neighbours::BLOCK;
        let Self { constants, particles, block, out } = self;
        let list = constants.list;
        let region_start = block * list.region();
        let mut offset = 0;
        while offset < out.flux.len() {
            let group = list.group((block * BLOCK + offset) / LANES);
            let own = particles.geometry_records.load::<V>(const { values(D).div_ceil(4) }, &group.own);
            let place = records::vector::<V, D>(&own, 0);
            let pressure_a = records::scalar(&own, D + 1);
            // M is symmetric: only the upper triangle is summed
            let mut moment = zero_tensor::<V, D>();
            let mut gradient = zero_vector::<V, D>();
            let weights = &mut out.pair_weights[group.first_pair - region_start..];
            for (b, stored) in group.pairs.zip(weights) {
                let record = particles.geometry_records.load::<V>(const { values(D).div_ceil(4) }, &b);
                let position = records::vector::<V, D>(&record, 0);
                let volume = records::scalar(&record, D);
                let pressure = records::scalar(&record, D + 1);
                let r = difference(&place, &position);
                let weight = constants.kernel.gradient_weight(dot(&r, &r), volume);
                *stored = weight.to_array();
                accumulate(&mut gradient, (pressure - pressure_a) * weight, &r);
                for i in 0..D {
                    let weighted = weight * r[i];
                    for j in i..D {
                        moment[i][j] = moment[i][j] - weighted * r[j];
                    }
                }
            }
            for i in 1..D {
                for j in 0..i {
                    moment[i][j] = moment[j][i];
                }
            }
            let end = (offset + LANES).min(out.flux.len());
            let (for_gradients, mut for_forces) = corrections(&moment);
            if constants.momentum_operator != MomentumOperator::SingleDivergence {
                for_forces = identity();
            }
            let first = block * BLOCK + offset;
            let stress = constants.stress(particles, first..first + end - offset, pressure_a);
            store_tensor(&for_gradients, &mut out.correction[offset..end]);
            store_tensor(&for_forces, &mut out.force_correction[offset..end]);
            store_vector(&product(&for_gradients, &gradient), &mut out.pressure_gradient[offset..end]);
            store_tensor(&matrix_product(&stress, &for_forces), &mut out.flux[offset..end]);
            offset = end;
        }
    }
}

#[inline(always)]
fn identity<V: Lanes, const D: usize>() -> [[V; D]; D] {
    let mut lanes = zero_tensor::<V, D>();
    for i in 0..D {
        lanes[i][i] = V::splat(1.0);
    }
    lanes
}

impl<const D: usize> Geometry<'_, D> {
    /// σ = s − pI `[Pa]` of eight particles with the stresses that their law does not carry.
    #[inline(always)]
    fn stress<V: Lanes>(&self, particles: &Particles<D>, places: Range<usize>, pressure: V) -> [[V; D]; D] {
        let mut stress = load_tensor::<V, D>(&particles.stress[places.clone()]);
        let damped = self.elastic_viscosity > 0.0 && self.rheology.is_plastic();
        if damped || self.mixing_area > 0.0 {
            let rate = deviatoric_rate(&load_tensor::<V, D>(&particles.velocity_gradient[places.clone()]));
            let mut viscosity = V::splat(0.0);
            if damped {
                let elasticity = self.rheology.elasticity(invariant(0.5, &stress), pressure);
                viscosity = elasticity * V::splat(self.elastic_viscosity);
            }
            if self.mixing_area > 0.0 {
                // ρ ν_s with ν_s = (C_s Δ)² |γ̇|, (5)
                let density = load::<V>(&particles.density[places]);
                viscosity = viscosity + density * V::splat(self.mixing_area) * invariant(2.0, &rate);
            }
            for i in 0..D {
                accumulate(&mut stress[i], V::splat(2.0) * viscosity, &rate[i]);
            }
        }
        for axis in 0..D {
            stress[axis][axis] = stress[axis][axis] - pressure;
        }
        stress
    }
}
