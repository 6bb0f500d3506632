//! Diffusion of the stress ratio among yielding particles, summed beside continuity.

use super::exchange::{Exchange, Exchanged, FieldSums, Numbers};
use super::layout::Continuity;
use super::pair_weights::{flush, flush_tensor};
use super::precision::Precision;
use super::records::{self, LaneRecord, Writer};
use crate::lanes::algebra::zero_tensor;
use crate::lanes::{Lanes, Real};
use crate::vector::equivalent_shear_stress;
use crate::weakly_compressible::terms::stress_diffusion;
use crate::weakly_compressible::{Model, PairDiffusion, Particles};

/// Sums of the stress ratio's diffusion around eight particles.
pub(super) struct StressRatio<V: Lanes, P: Precision, const D: usize> {
    pressure: Numbers<P, V>,
    /// Yielding share `[-]`.
    yielding: Numbers<P, V>,
    stress: [[Numbers<P, V>; D]; D],
    sum: [[V; D]; D],
    part: [[Numbers<P, V>; D]; D],
    /// Σ f p_b, in single precision.
    pressures: V,
    part_pressures: Numbers<P, V>,
}

/// Writes the yielding share of a particle and its stress.
pub(super) fn write<P: Precision, const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    index: usize,
    record: &mut Writer<'_, P>,
) {
    let (stress, pressure) = (&particles.stress[index], particles.pressure[index]);
    let elasticity = model.elasticity(equivalent_shear_stress(stress), pressure, &particles.kept(index));
    record.scalar(stress_diffusion::yielding(elasticity, pressure));
    record.deviator(stress);
}

impl<V: Lanes, P: Precision, const D: usize> Exchange<V, P, D> for StressRatio<V, P, D> {
    const KIND: PairDiffusion = PairDiffusion::StressRatio;

    #[inline(always)]
    fn around(own: &LaneRecord<Numbers<P, V>>, pressure: Numbers<P, V>) -> Self {
        Self {
            pressure,
            yielding: records::scalar(own, Continuity::<P, D>::EXCHANGED),
            stress: records::deviator(own, Continuity::<P, D>::EXCHANGED + 1),
            sum: zero_tensor(),
            part: zero_tensor(),
            pressures: V::splat(0.0),
            part_pressures: Numbers::<P, V>::splat(0.0),
        }
    }

    #[inline(always)]
    fn add(&mut self, weight: Numbers<P, V>, other: &LaneRecord<Numbers<P, V>>, pressure: Numbers<P, V>) {
        let yielding = records::scalar(other, Continuity::<P, D>::EXCHANGED);
        let stress = records::deviator(other, Continuity::<P, D>::EXCHANGED + 1);
        let factor = weight * stress_diffusion::pair_factor(self.yielding, yielding, self.pressure + pressure);
        if P::SINGLE {
            self.part_pressures = self.part_pressures + factor * pressure;
            stress_diffusion::accumulate_stress(&mut self.part, factor, &stress);
        } else {
            let (of_a, of_b) = ((&self.stress, self.pressure), (&stress, pressure));
            stress_diffusion::accumulate_bracket(&mut self.part, factor, of_a, of_b);
        }
    }

    #[inline(always)]
    fn flush(&mut self) {
        flush::<V, P>(&mut self.pressures, &mut self.part_pressures);
        flush_tensor::<V, P, D>(&mut self.sum, &mut self.part);
    }

    #[inline(always)]
    fn sums(self) -> Exchanged<V, D> {
        let mut sum = self.sum;
        if P::SINGLE {
            let pressure = P::widen::<V>(self.pressure);
            for i in 0..D {
                for j in 0..D {
                    sum[i][j] = self.pressures * P::widen::<V>(self.stress[i][j]) - pressure * sum[i][j];
                }
            }
        }
        stress_diffusion::complete(&mut sum);
        Exchanged { stress_ratio: sum, field: FieldSums::none() }
    }
}
