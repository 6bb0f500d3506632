//! The weights V_b F of pairs: stored once a step, or computed anew by each pass, part by part of a sum.

use super::precision::{PART, Precision};
use super::records::{self, Records};
use crate::kernel::Kernel;
use crate::lanes::algebra::{dot, zero_vector};
use crate::lanes::{LANES, LaneChunks, LaneNumbers, Lanes, Real};
use std::iter::Zip;
use std::slice::Iter;

/// Weights `[1/m²]` of eight pairs.
pub(super) type Weights<P> = [P; LANES];

/// Ingredients of the pair weights. Records begin with position and volume.
pub(super) struct Weighing<'a, P: Precision, V: Lanes, const D: usize> {
    pub(super) kernel: &'a Kernel<D>,
    pub(super) records: &'a Records<P>,
    /// Length of a record.
    pub(super) quads: usize,
    /// Position of the group.
    pub(super) place: [P::Lanes<V>; D],
}

impl<P: Precision, V: Lanes, const D: usize> Weighing<'_, P, V, D> {
    /// Makes the weights of pairs, in a loop of its own, so that square roots do not wait for what is done with them.
    #[inline(always)]
    pub(super) fn weigh(&self, pairs: LaneChunks<'_>, weights: &mut [Weights<P>]) {
        for (b, weights) in pairs.zip(weights) {
            let record = self.records.load_start::<V>(self.quads, const { (D + 1).div_ceil(4) }, &b);
            let r = self.records.apart::<V, D>(&self.place, &records::vector(&record, 0));
            *weights = self.kernel.gradient_weight(dot(&r, &r), records::scalar(&record, D)).to_array();
        }
    }

    /// Pairs of the group, to be summed part by part; `stored` has their weights where weights are stored.
    #[inline(always)]
    pub(super) fn pairs<'b>(&'b self, pairs: LaneChunks<'b>, stored: &'b [Weights<P>]) -> PairParts<'b, P, V, D> {
        PairParts { weighing: self, pairs, stored, room: [[P::default(); LANES]; PART] }
    }
}

/// Pairs of a group that are not summed yet.
pub(super) struct PairParts<'a, P: Precision, V: Lanes, const D: usize> {
    weighing: &'a Weighing<'a, P, V, D>,
    pairs: LaneChunks<'a>,
    stored: &'a [Weights<P>],
    room: [Weights<P>; PART],
}

impl<'a, P: Precision, V: Lanes, const D: usize> PairParts<'a, P, V, D> {
    /// The next part of the sum with its weights.
    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<Zip<LaneChunks<'a>, Iter<'_, Weights<P>>>> {
        if self.pairs.is_empty() {
            return None;
        }
        let part = self.pairs.take_first(P::PART);
        if P::SINGLE {
            self.weighing.weigh(part, &mut self.room);
            Some(part.zip(&self.room))
        } else {
            Some(part.zip(self.stored))
        }
    }
}

/// Adds a part of a sum to the sum, and empties it.
#[inline(always)]
pub(super) fn flush<V: Lanes, P: Precision>(sum: &mut V, part: &mut P::Lanes<V>) {
    *sum = *sum + P::widen::<V>(*part);
    *part = P::Lanes::<V>::splat(0.0);
}

#[inline(always)]
pub(super) fn flush_vector<V: Lanes, P: Precision, const D: usize>(sum: &mut [V; D], part: &mut [P::Lanes<V>; D]) {
    for i in 0..D {
        flush::<V, P>(&mut sum[i], &mut part[i]);
    }
}

#[inline(always)]
pub(super) fn flush_tensor<V: Lanes, P: Precision, const D: usize>(
    sum: &mut [[V; D]; D],
    part: &mut [[P::Lanes<V>; D]; D],
) {
    for i in 0..D {
        flush_vector::<V, P, D>(&mut sum[i], &mut part[i]);
    }
}

/// A vector as f64, exactly.
#[inline(always)]
pub(super) fn widened<V: Lanes, P: Precision, const D: usize>(vector: &[P::Lanes<V>; D]) -> [V; D] {
    let mut lanes = zero_vector::<V, D>();
    for i in 0..D {
        lanes[i] = P::widen(vector[i]);
    }
    lanes
}
