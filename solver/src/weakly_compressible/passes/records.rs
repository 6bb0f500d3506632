//! Packed copies of what a pair loop reads of a neighbour, one record per particle.
//!
//! A neighbour's values then lie in one or two cache lines, and eight neighbours are loaded and transposed into
//! lanes with plain loads, which is faster than gather instructions on every processor tried (some run those from
//! slow microcode).

use super::precision::Precision;
use crate::lanes::{LaneIndices, LaneNumbers, Lanes, Real};
use crate::parallel::{ChunksMut, prelude::*};
use crate::vector::{Tensor, Vector};

/// Most quads of four values in a record.
pub(crate) const QUADS: usize = 7;

/// Records of `quads` × 4 values.
#[derive(Debug, Default)]
pub(crate) struct Records<P: Precision = f64> {
    quads: usize,
    /// Length that is the unit of positions `[m]`.
    smoothing_length: f64,
    data: Vec<[P; 4]>,
}

/// A record's values in lanes.
pub(crate) type LaneRecord<V> = [[V; 4]; QUADS];

impl<P: Precision> Records<P> {
    /// Empty records of a given number of values.
    pub(crate) fn new(values: usize) -> Self {
        Self { quads: values.div_ceil(4), smoothing_length: 0.0, data: Vec::new() }
    }

    /// Fills a record of a given number of values for every particle; allocated memory is kept.
    pub(crate) fn fill(
        &mut self,
        particles: usize,
        values: usize,
        smoothing_length: f64,
        write: impl Fn(usize, &mut Writer<'_, P>) + Sync,
    ) {
        let quads = values.div_ceil(4);
        (self.quads, self.smoothing_length) = (quads, smoothing_length);
        let needed = particles * quads;
        if self.data.len() < needed {
            self.reserve(needed);
            self.data.resize(needed, [P::default(); 4]);
        }
        const BLOCK: usize = 1024;
        self.data[..needed].par_chunks_mut(quads * BLOCK).enumerate().for_each(|(block, chunk)| {
            for (offset, record) in chunk.chunks_exact_mut(quads).enumerate() {
                let record = record.as_flattened_mut();
                write(block * BLOCK + offset, &mut Writer { record, next: 0, smoothing_length });
            }
        });
    }

    /// Room for a number of quads, with some head room if it is new.
    fn reserve(&mut self, needed: usize) {
        if self.data.capacity() < needed {
            self.data.reserve_exact(needed + needed / 8 + 64 - self.data.len());
        }
    }

    /// Loads the records of eight particles; `quads` is their length in quads.
    #[inline(always)]
    pub(crate) fn load<V: Lanes>(&self, quads: usize, indices: &LaneIndices<'_>) -> LaneRecord<P::Lanes<V>> {
        self.load_start::<V>(quads, quads, indices)
    }

    /// Loads the first `wanted` quads of the records of eight particles, which are `quads` long.
    #[inline(always)]
    pub(crate) fn load_start<V: Lanes>(
        &self,
        quads: usize,
        wanted: usize,
        indices: &LaneIndices<'_>,
    ) -> LaneRecord<P::Lanes<V>> {
        debug_assert_eq!(quads, self.quads);
        let mut record = [[P::Lanes::<V>::splat(0.0); 4]; QUADS];
        for quad in 0..wanted {
            record[quad] = P::Lanes::<V>::load_quads(&self.data, quads, quad, indices);
        }
        record
    }

    /// a − b `[m]` of two positions in records.
    #[inline(always)]
    pub(super) fn apart<V: Lanes, const D: usize>(
        &self,
        a: &[P::Lanes<V>; D],
        b: &[P::Lanes<V>; D],
    ) -> [P::Lanes<V>; D] {
        let mut lanes = *a;
        for i in 0..D {
            lanes[i] = P::apart::<V>(a[i], b[i], self.smoothing_length);
        }
        lanes
    }
}

impl Records {
    /// Room for one record per particle, of the values that they had, without any in new ones; the sentinel's is zero.
    pub(crate) fn resize(&mut self, particles: usize) {
        let needed = particles * self.quads;
        self.reserve(needed);
        self.data.resize(needed, [0.0; 4]);
        self.data[needed - self.quads..].fill([0.0; 4]);
    }

    /// The records of the first `particles`, in parts of `block` records.
    pub(crate) fn blocks_mut(&mut self, particles: usize, block: usize) -> ChunksMut<'_, [f64; 4]> {
        let quads = self.quads;
        self.data[..particles * quads].par_chunks_mut(block * quads)
    }

    /// Makes the record at `slot` a copy of that at `source`, each of its values times a sign.
    pub(crate) fn copy_signed(&mut self, slot: usize, source: usize, signs: &[f64]) {
        for (place, sign) in signs.iter().enumerate() {
            let (quad, component) = (place / 4, place % 4);
            let value = self.data[source * self.quads + quad][component];
            self.data[slot * self.quads + quad][component] = value * sign;
        }
    }
}

/// Writes a record value by value.
#[derive(Debug)]
pub(crate) struct Writer<'a, P: Precision> {
    record: &'a mut [P],
    next: usize,
    smoothing_length: f64,
}

impl<P: Precision> Writer<'_, P> {
    #[inline(always)]
    fn put(&mut self, value: P) {
        self.record[self.next] = value;
        self.next += 1;
    }

    #[inline(always)]
    pub(crate) fn scalar(&mut self, number: f64) {
        self.put(P::of(number));
    }

    #[inline(always)]
    pub(crate) fn position<const D: usize>(&mut self, position: &Vector<D>) {
        for i in 0..D {
            self.put(P::of_coordinate(position[i], self.smoothing_length));
        }
    }

    #[inline(always)]
    pub(crate) fn vector<const D: usize>(&mut self, vector: &Vector<D>) {
        for i in 0..D {
            self.scalar(vector[i]);
        }
    }

    /// The upper triangle of a symmetric tensor without trace, except the last entry of its diagonal.
    #[inline(always)]
    pub(crate) fn deviator<const D: usize>(&mut self, deviator: &Tensor<D>) {
        for i in 0..D - 1 {
            for j in i..D {
                self.scalar(deviator[(i, j)]);
            }
        }
    }

    /// The coefficients of r_i r_j in ½ r·T r, i ≤ j.
    #[inline(always)]
    pub(super) fn half_form<const D: usize>(&mut self, tensor: &Tensor<D>) {
        for i in 0..D {
            self.scalar(0.5 * tensor[(i, i)]);
            for j in i + 1..D {
                self.scalar(0.5 * (tensor[(i, j)] + tensor[(j, i)]));
            }
        }
    }

    #[inline(always)]
    pub(crate) fn tensor<const D: usize>(&mut self, tensor: &Tensor<D>) {
        for i in 0..D {
            for j in 0..D {
                self.scalar(tensor[(i, j)]);
            }
        }
    }
}

/// The scalar at `place` of a record.
#[inline(always)]
pub(crate) fn scalar<V: Real>(record: &LaneRecord<V>, place: usize) -> V {
    record[place / 4][place % 4]
}

/// The vector that starts at `place` of a record.
#[inline(always)]
pub(crate) fn vector<V: Real, const D: usize>(record: &LaneRecord<V>, place: usize) -> [V; D] {
    let mut lanes = [V::splat(0.0); D];
    for i in 0..D {
        lanes[i] = scalar(record, place + i);
    }
    lanes
}

/// The tensor that starts at `place` of a record, indexed `[row][column]`.
#[inline(always)]
pub(crate) fn tensor<V: Real, const D: usize>(record: &LaneRecord<V>, place: usize) -> [[V; D]; D] {
    let mut lanes = [[V::splat(0.0); D]; D];
    for i in 0..D {
        lanes[i] = vector(record, place + D * i);
    }
    lanes
}

/// Values of a symmetric tensor without trace in a record.
pub(crate) const fn deviator_values(dimension: usize) -> usize {
    dimension * (dimension + 1) / 2 - 1
}

/// The upper triangle that starts at `place` of a record, the rest zero.
#[inline(always)]
pub(crate) fn triangle<V: Real, const D: usize>(record: &LaneRecord<V>, place: usize) -> [[V; D]; D] {
    rows_from_diagonal::<V, D>(record, place, D)
}

/// The symmetric tensor without trace that starts at `place` of a record: its upper triangle except the last entry of
/// the diagonal, the rest zero.
#[inline(always)]
pub(crate) fn deviator<V: Real, const D: usize>(record: &LaneRecord<V>, place: usize) -> [[V; D]; D] {
    rows_from_diagonal::<V, D>(record, place, D - 1)
}

#[inline(always)]
fn rows_from_diagonal<V: Real, const D: usize>(record: &LaneRecord<V>, place: usize, rows: usize) -> [[V; D]; D] {
    let mut lanes = [[V::splat(0.0); D]; D];
    let mut next = place;
    for i in 0..rows {
        for j in i..D {
            lanes[i][j] = scalar(record, next);
            next += 1;
        }
    }
    lanes
}
