//! The pore liquid: diffusion of its pressure, summed beside continuity, and its bound on the time step.

use super::exchange::{Exchange, Exchanged, FieldSums, Inputs, Numbers};
use super::layout::Continuity;
use super::pair_weights::flush;
use super::precision::Precision;
use super::records::{self, LaneRecord, Writer};
use crate::lanes::algebra::zero_tensor;
use crate::lanes::{LaneIndices, Lanes, Real};
use crate::material::pore_liquid::LARGEST_DIFFUSION;
use crate::material::rheology::field::{FieldStep, Memory};
use crate::weakly_compressible::terms::field_diffusion;
use crate::weakly_compressible::{Model, PairDiffusion, Particles};

/// Sums of the diffusion of the pore pressure around eight particles, by the conductivities of both.
pub(super) struct PorePressure<V: Lanes, P: Precision> {
    pressure: Numbers<P, V>,
    conductivity: Numbers<P, V>,
    sums: FieldSums<V>,
    part_taken: Numbers<P, V>,
    part_weights: Numbers<P, V>,
}

/// Writes the pore pressure of a particle and its relative conductivity.
pub(super) fn write<P: Precision, const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    index: usize,
    record: &mut Writer<'_, P>,
) {
    let pore = particles.kept(index).pore();
    record.scalar(pore.pressure);
    record.scalar(model.relative_conductivity(pore.growth));
}

impl<V: Lanes, P: Precision, const D: usize> Exchange<V, P, D> for PorePressure<V, P> {
    const KIND: PairDiffusion = PairDiffusion::PorePressure;

    #[inline(always)]
    fn around(own: &LaneRecord<Numbers<P, V>>, _: Numbers<P, V>) -> Self {
        let none = Numbers::<P, V>::splat(0.0);
        Self {
            pressure: records::scalar(own, Continuity::<P, D>::EXCHANGED),
            conductivity: records::scalar(own, Continuity::<P, D>::EXCHANGED + 1),
            sums: FieldSums::none(),
            part_taken: none,
            part_weights: none,
        }
    }

    #[inline(always)]
    fn add(&mut self, weight: Numbers<P, V>, other: &LaneRecord<Numbers<P, V>>, _: Numbers<P, V>) {
        let conductivity = records::scalar(other, Continuity::<P, D>::EXCHANGED + 1);
        let mean = field_diffusion::mean_conductivity(self.conductivity, conductivity);
        let difference = records::scalar(other, Continuity::<P, D>::EXCHANGED) - self.pressure;
        self.part_taken = self.part_taken + weight * mean * difference;
        self.part_weights = self.part_weights + weight;
    }

    #[inline(always)]
    fn flush(&mut self) {
        flush::<V, P>(&mut self.sums.taken, &mut self.part_taken);
        flush::<V, P>(&mut self.sums.weights, &mut self.part_weights);
    }

    /// Walls are sealed: they only close the neighbourhood.
    #[inline(always)]
    fn add_wall(&mut self, _: &Inputs<'_, D>, _: &LaneIndices<'_>, weight: V, _: &[Numbers<P, V>; D]) {
        self.sums.weights = self.sums.weights + weight;
    }

    #[inline(always)]
    fn sums(self) -> Exchanged<V, D> {
        Exchanged { stress_ratio: zero_tensor(), field: self.sums }
    }
}

/// Largest diffusivity of the pore pressure among particles of these memories, times C/[`LARGEST_DIFFUSION`] `[m²/s]`: with the coefficient C
/// of the viscous bound, that bound is then the one of the diffusion. Zero without a pore liquid.
pub(super) fn diffusivity<const D: usize>(model: &Model<D>, memories: &[Memory<f64>]) -> f64 {
    let Some(pore) = &model.pore_liquid else { return 0.0 };
    let (stable, modulus) = (model.numerics.viscous_courant / LARGEST_DIFFUSION, model.moduli().bulk);
    let scaled = |&memory: &Memory<f64>| {
        let fraction = pore.solid_fraction / (1.0 + FieldStep::alone(0.0).with_memory(memory).pore().growth);
        stable * pore.diffusivity(fraction, modulus)
    };
    memories.iter().map(scaled).fold(0.0, f64::max)
}
