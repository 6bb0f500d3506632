//! Diffusion of the law's field, summed beside continuity and the diffusion of the stress ratio.

use super::exchange::{Exchange, Exchanged, FieldSums, Inputs, Numbers};
use super::layout::Continuity;
use super::pair_weights::{flush, widened};
use super::precision::Precision;
use super::records::{self, LaneRecord};
use super::stress_ratio::StressRatio;
use crate::lanes::{LaneIndices, Lanes, Real, gather, gather_vectors};
use crate::material::rheology::field::{FieldBoundary, FieldStep};
use crate::weakly_compressible::terms::field_diffusion;
use crate::weakly_compressible::{Model, PairDiffusion};

/// Sums of the diffusion of a field, and of the stress ratio, around eight particles.
pub(super) struct FieldDiffusion<V: Lanes, P: Precision, const D: usize> {
    stress_ratio: StressRatio<V, P, D>,
    sums: FieldSums<V>,
    part_taken: Numbers<P, V>,
    part_weights: Numbers<P, V>,
}

impl<V: Lanes, P: Precision, const D: usize> FieldDiffusion<V, P, D> {
    /// The field stands behind the stress.
    const FIELD: usize = Continuity::<P, D>::values(PairDiffusion::StressRatio);
}

impl<V: Lanes, P: Precision, const D: usize> Exchange<V, P, D> for FieldDiffusion<V, P, D> {
    const KIND: PairDiffusion = PairDiffusion::Field;

    #[inline(always)]
    fn around(own: &LaneRecord<Numbers<P, V>>, pressure: Numbers<P, V>) -> Self {
        let none = Numbers::<P, V>::splat(0.0);
        let stress_ratio = StressRatio::around(own, pressure);
        Self { stress_ratio, sums: FieldSums::none(), part_taken: none, part_weights: none }
    }

    #[inline(always)]
    fn add(&mut self, weight: Numbers<P, V>, other: &LaneRecord<Numbers<P, V>>, pressure: Numbers<P, V>) {
        self.part_taken = self.part_taken + weight * records::scalar(other, Self::FIELD);
        self.part_weights = self.part_weights + weight;
        self.stress_ratio.add(weight, other, pressure);
    }

    #[inline(always)]
    fn flush(&mut self) {
        flush::<V, P>(&mut self.sums.taken, &mut self.part_taken);
        flush::<V, P>(&mut self.sums.weights, &mut self.part_weights);
        self.sums.given = self.sums.weights;
        self.stress_ratio.flush();
    }

    #[inline(always)]
    fn add_wall(&mut self, inputs: &Inputs<'_, D>, wall: &LaneIndices<'_>, weight: V, r: &[Numbers<P, V>; D]) {
        let particles = inputs.particles;
        let places = wall.places_from(particles.flow_count());
        let places = places.indices();
        let normal = gather_vectors::<V, D>(&particles.walls.normal, &places);
        let depth: V = gather(&particles.walls.depth, &places);
        let smoothness: V = gather(&particles.walls.smoothness, &places);
        let r = widened::<V, P, D>(r);
        let factor = field_diffusion::wall_factor(&r, &normal, depth, smoothness, inputs.model.spacing);
        self.sums.given = self.sums.given + weight * factor;
        self.sums.weights = self.sums.weights + weight;
    }

    #[inline(always)]
    fn sums(self) -> Exchanged<V, D> {
        Exchanged { field: self.sums, ..self.stress_ratio.sums() }
    }
}

/// What is kept at the start of a step, with what diffusion of the field brings and takes.
#[inline(always)]
pub(super) fn diffusing<V: Lanes, const D: usize>(
    model: &Model<D>,
    kept: FieldStep<V>,
    sums: &FieldSums<V>,
) -> FieldStep<V> {
    let Some(diffusion) = model.field_diffusion() else { return kept };
    // V F is negative
    let strength = V::splat(-2.0 * diffusion.strength);
    let mut loss = strength * sums.given;
    if diffusion.surface == FieldBoundary::Vanishing {
        let weights = V::splat(-2.0) * sums.weights;
        let sink = field_diffusion::surface_sink(weights, model.full_weight, sums.eigenvalue);
        let sink = match model.pore_liquid {
            Some(_) => V::lane_by_lane([kept.pore().growth], &|[growth]| model.relative_conductivity(growth)) * sink,
            None => sink,
        };
        loss = loss + V::splat(diffusion.strength) * sink;
    }
    FieldStep { gain: strength * sums.taken, loss, ..kept }
}
