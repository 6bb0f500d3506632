//! Packed copies of what a pair loop reads of a neighbour, one record per particle.
//!
//! A neighbour's values then lie in one or two cache lines, and eight neighbours are loaded and transposed into
//! lanes with plain loads, which is faster than gather instructions on every processor tried (some run those from
//! slow microcode).

use crate::lanes::{LaneIndices, Lanes, Real};
use crate::parallel::{ChunksMut, prelude::*};
use crate::vector::{Tensor, Vector};

/// Most quads of four values in a record.
pub(crate) const QUADS: usize = 7;

/// Records of `quads` × 4 values.
#[derive(Debug)]
pub(crate) struct Records {
    quads: usize,
    data: Vec<[f64; 4]>,
}

/// A record's values in lanes.
pub(crate) type LaneRecord<V> = [[V; 4]; QUADS];

impl Records {
    pub(crate) fn new(values: usize) -> Self {
        Self { quads: values.div_ceil(4), data: Vec::new() }
    }

    /// Changes the number of values of a record.
    pub(crate) fn set_values(&mut self, values: usize) {
        self.quads = values.div_ceil(4);
    }

    /// Fills one record for every particle.
    pub(crate) fn fill(&mut self, particles: usize, write: impl Fn(usize, &mut Writer<'_>) + Sync) {
        let quads = self.quads;
        let needed = particles * quads;
        if self.data.capacity() < needed {
            self.data.reserve_exact(needed + needed / 8 + 64 - self.data.len());
        }
        self.data.resize(needed, [0.0; 4]);
        const BLOCK: usize = 1024;
        self.data.par_chunks_mut(quads * BLOCK).enumerate().for_each(|(block, chunk)| {
            for (offset, record) in chunk.chunks_exact_mut(quads).enumerate() {
                write(block * BLOCK + offset, &mut Writer { record: record.as_flattened_mut(), next: 0 });
            }
        });
    }

    /// Room for one record per particle, of the values that they had, without any in new ones; the sentinel's is zero.
    pub(crate) fn resize(&mut self, particles: usize) {
        let needed = particles * self.quads;
        if self.data.capacity() < needed {
            self.data.reserve_exact(needed + needed / 8 + 64 - self.data.len());
        }
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

    /// Loads the records of eight particles; `quads` is their length in quads.
    #[inline(always)]
    pub(crate) fn load<V: Lanes>(&self, quads: usize, indices: &LaneIndices<'_>) -> LaneRecord<V> {
        self.load_start(quads, quads, indices)
    }

    /// Loads the first `wanted` quads of the records of eight particles, which are `quads` long.
    #[inline(always)]
    pub(crate) fn load_start<V: Lanes>(&self, quads: usize, wanted: usize, indices: &LaneIndices<'_>) -> LaneRecord<V> {
        debug_assert_eq!(quads, self.quads);
        let mut record = [[V::splat(0.0); 4]; QUADS];
        for quad in 0..wanted {
            record[quad] = V::load_quads(&self.data, quads, quad, indices);
        }
        record
    }
}

/// Writes a record value by value.
#[derive(Debug)]
pub(crate) struct Writer<'a> {
    record: &'a mut [f64],
    next: usize,
}

impl Writer<'_> {
    #[inline(always)]
    pub(crate) fn scalar(&mut self, value: f64) {
        self.record[self.next] = value;
        self.next += 1;
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

/// The symmetric tensor without trace that starts at `place` of a record: its upper triangle except the last entry of
/// the diagonal, the rest zero.
#[inline(always)]
pub(crate) fn deviator<V: Real, const D: usize>(record: &LaneRecord<V>, place: usize) -> [[V; D]; D] {
    let mut lanes = [[V::splat(0.0); D]; D];
    let mut next = place;
    for i in 0..D - 1 {
        for j in i..D {
            lanes[i][j] = scalar(record, next);
            next += 1;
        }
    }
    lanes
}
