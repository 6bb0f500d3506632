//! One pass over the neighbours for all that depends on positions and pressure: the moment matrix with its
//! corrections, the corrected pressure gradient, and the stress as the divergence takes it.

use super::correction::corrections;
use crate::kernel::Kernel;
use crate::lanes::algebra::{accumulate, difference, dot, reduce_vector, splat_vector};
use crate::lanes::{InstructionSet, LANES, LaneIndices, LanePass, Lanes};
use crate::neighbours::VerletList;
use crate::numerics::MomentumOperator;
use crate::particles::Particles;
use crate::records::{self, Records};
use crate::rheology::Rheology;
use crate::vector::{Tensor, Vector, deviator, equivalent_shear_stress, strain_rate};
use rayon::prelude::*;

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
        const BLOCK: usize = crate::neighbours::BLOCK;
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
        let stride = self.list.stride();
        let mut pair_weights = std::mem::take(&mut particles.pair_weights);
        if pair_weights.len() < flow * stride {
            pair_weights.resize(flow * stride, [0.0; LANES]);
        }
        let shared = &*particles;
        (
            correction.par_chunks_mut(BLOCK),
            force_correction.par_chunks_mut(BLOCK),
            pressure_gradient[..flow].par_chunks_mut(BLOCK),
            flux[..flow].par_chunks_mut(BLOCK),
            pair_weights[..flow * stride].par_chunks_mut(BLOCK * stride),
        )
            .into_par_iter()
            .enumerate()
            .with_min_len(4)
            .for_each(|(block, (correction, force_correction, pressure_gradient, flux, pair_weights))| {
                let out = Output { correction, force_correction, pressure_gradient, flux, pair_weights };
                self.instruction_set.run(Pass { constants: self, particles: shared, first: block * BLOCK, out });
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
    first: usize,
    out: Output<'a, D>,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, first, out } = self;
        let total = particles.position.len();
        let zero = V::splat(0.0);
        let stride = constants.list.stride();
        for offset in 0..out.flux.len() {
            let a = first + offset;
            let place = splat_vector::<V, D>(&particles.position[a]);
            let pressure_a = V::splat(particles.pressure[a]);
            // M is symmetric: only the upper triangle is summed
            let mut moment = [[zero; D]; D];
            let mut gradient = [zero; D];
            let row = constants.list.row(a);
            let weights = &mut out.pair_weights[offset * stride..(offset + 1) * stride];
            for (chunk, stored) in row.flow.iter().chain(row.wall).zip(weights) {
                let b = LaneIndices::new(chunk, total);
                let record = particles.geometry_records.load::<V>(const { values(D).div_ceil(4) }, &b);
                let position = records::vector::<V, D>(&record, 0);
                let volume = records::scalar(&record, D);
                let pressure = records::scalar(&record, D + 1);
                let r = difference(&place, &position);
                let weight = volume * constants.kernel.gradient_factor(dot(&r, &r));
                *stored = weight.to_array();
                accumulate(&mut gradient, (pressure - pressure_a) * weight, &r);
                for i in 0..D {
                    let weighted = weight * r[i];
                    for j in i..D {
                        moment[i][j] = moment[i][j] - weighted * r[j];
                    }
                }
            }
            let mut symmetric = Tensor::<D>::zeros();
            for i in 0..D {
                for j in i..D {
                    symmetric[(i, j)] = moment[i][j].sum();
                    symmetric[(j, i)] = symmetric[(i, j)];
                }
            }
            let (for_gradients, for_forces) = corrections(&symmetric);
            out.correction[offset] = for_gradients;
            out.force_correction[offset] = match constants.momentum_operator {
                MomentumOperator::SingleDivergence => for_forces,
                _ => Tensor::identity(),
            };
            out.pressure_gradient[offset] = for_gradients * reduce_vector(&gradient);
            let mut stress = particles.stress[a];
            if constants.elastic_viscosity > 0.0 && constants.rheology.is_plastic() {
                let elasticity = constants.rheology.elasticity(equivalent_shear_stress(&stress), particles.pressure[a]);
                if elasticity > 0.0 {
                    let rate = deviator(&strain_rate(&particles.velocity_gradient[a]));
                    stress += rate * (2.0 * elasticity * constants.elastic_viscosity);
                }
            }
            if constants.mixing_area > 0.0 {
                // 2 ρ ν_s ε′ with ν_s = (C_s Δ)² |γ̇|, (5)
                let rate = deviator(&strain_rate(&particles.velocity_gradient[a]));
                let shear_rate = (2.0 * crate::vector::double_contraction(&rate, &rate)).sqrt();
                stress += rate * (2.0 * particles.density[a] * constants.mixing_area * shear_rate);
            }
            for axis in 0..D {
                stress[(axis, axis)] -= particles.pressure[a];
            }
            out.flux[offset] = stress * out.force_correction[offset];
        }
    }
}
