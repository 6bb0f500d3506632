//! Quantities that neighbours exchange while continuity sums over them: what stands of one in their records, and its sums.

use super::precision::Precision;
use super::records::LaneRecord;
use crate::lanes::algebra::zero_tensor;
use crate::lanes::{LaneIndices, Lanes, Real};
use crate::weakly_compressible::{Model, NeighbourGroup, PairDiffusion, Particles};

/// Eight numbers of a precision.
pub(super) type Numbers<P, V> = <P as Precision>::Lanes<V>;

/// A quantity that neighbours exchange. In records it stands behind what the density takes.
pub(super) trait Exchange<V: Lanes, P: Precision, const D: usize>: Sized {
    /// Name, by which a record has its length.
    const KIND: PairDiffusion;

    /// Nothing summed yet around eight particles of these records and pressures `[Pa]`.
    fn around(own: &LaneRecord<Numbers<P, V>>, pressure: Numbers<P, V>) -> Self;

    /// Adds flow neighbours with their weights V F `[1/m²]`, records and pressures `[Pa]`.
    #[inline(always)]
    fn add(&mut self, _weight: Numbers<P, V>, _other: &LaneRecord<Numbers<P, V>>, _pressure: Numbers<P, V>) {}

    /// Adds the parts of sums to the sums.
    #[inline(always)]
    fn flush(&mut self) {}

    /// Adds wall neighbours, by their indices, with their weights `[1/m²]` and the way from them `[m]`.
    #[inline(always)]
    fn add_wall(&mut self, _inputs: &Inputs<'_, D>, _wall: &LaneIndices<'_>, _weight: V, _r: &[Numbers<P, V>; D]) {}

    /// The sums, when all neighbours are added.
    fn sums(self) -> Exchanged<V, D>;
}

/// Inputs of the loops over neighbours beside their records.
#[derive(Clone, Copy)]
pub(super) struct Inputs<'a, const D: usize> {
    pub(super) model: &'a Model<D>,
    pub(super) particles: &'a Particles<D>,
    pub(super) group: NeighbourGroup<'a>,
}

/// Pair sums of what is exchanged.
pub(super) struct Exchanged<V, const D: usize> {
    /// Sums of the stress ratio's diffusion `[Pa/m²]`.
    pub(super) stress_ratio: [[V; D]; D],
    pub(super) field: FieldSums<V>,
}

/// Pair sums of a field's diffusion, with the weights V F ≤ 0 `[1/m²]`.
pub(super) struct FieldSums<V> {
    /// Σ V F f_b over the flow.
    pub(super) taken: V,
    /// Σ V F over the flow, and with their factors over walls.
    pub(super) given: V,
    /// Σ V F over all.
    pub(super) weights: V,
    /// Smallest eigenvalue of the moment matrix `[-]`, where it is asked for.
    pub(super) eigenvalue: V,
}

impl<V: Real> FieldSums<V> {
    #[inline(always)]
    pub(super) fn none() -> Self {
        let zero = V::splat(0.0);
        Self { taken: zero, given: zero, weights: zero, eigenvalue: V::splat(1.0) }
    }
}

/// Nothing is exchanged.
impl<V: Lanes, P: Precision, const D: usize> Exchange<V, P, D> for () {
    const KIND: PairDiffusion = PairDiffusion::None;

    #[inline(always)]
    fn around(_: &LaneRecord<Numbers<P, V>>, _: Numbers<P, V>) {}

    #[inline(always)]
    fn sums(self) -> Exchanged<V, D> {
        Exchanged { stress_ratio: zero_tensor(), field: FieldSums::none() }
    }
}
