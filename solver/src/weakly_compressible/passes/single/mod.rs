//! Pairs in single precision: half of the memory and twice the lanes for what is needed to seven digits only.
//!
//! Positions are integers of 32 bits that wrap, in units of h/2²⁶, so that the distance of two neighbours is an exact
//! integer wherever they are, rounded once to f32. All else of a pair is f32 as well, and up to 64 neighbours of a
//! particle are summed so; those sums are widened and added in f64. What a particle keeps from step to step (position, velocity,
//! density, stress) stays f64. Weights are computed again in each pass, which costs less than to store them.

pub(super) mod continuity;
pub(super) mod geometry;
pub(super) mod momentum;

use super::records::{LaneRecord, QUADS};
use crate::kernel::Kernel;
use crate::lanes::algebra::dot;
use crate::lanes::{LaneChunks, LaneIndices, Lanes, Real, SingleLanes};
use crate::parallel::prelude::*;
use crate::vector::{Tensor, Vector};

/// Chunks of eight neighbours that are summed in f32 before the sum goes to f64.
const PART: usize = 8;
/// Units of position in a smoothing length `[-]`: 32 smoothing lengths before the integers wrap to either side.
const UNITS: f64 = (1_u64 << 26) as f64;

/// One record a particle, of the pass that runs: all passes share this room.
#[derive(Debug, Default)]
pub(crate) struct SingleRecords {
    data: Vec<[f32; 4]>,
    /// Unit of positions `[m]`.
    unit: f64,
}

/// Writes a record, value by value.
pub(super) struct SingleWriter<'a> {
    record: &'a mut [f32],
    next: usize,
    inverse_unit: f64,
}

impl SingleWriter<'_> {
    #[inline(always)]
    fn put(&mut self, value: f32) {
        self.record[self.next] = value;
        self.next += 1;
    }

    #[inline(always)]
    fn scalar(&mut self, value: f64) {
        self.put(value as f32);
    }

    #[inline(always)]
    fn vector<const D: usize>(&mut self, vector: &Vector<D>) {
        for i in 0..D {
            self.scalar(vector[i]);
        }
    }

    /// A position as integers that wrap.
    #[inline(always)]
    fn position<const D: usize>(&mut self, position: &Vector<D>) {
        for i in 0..D {
            let fixed = (position[i] * self.inverse_unit) as i64 as u32;
            self.put(f32::from_bits(fixed));
        }
    }

    #[inline(always)]
    fn tensor<const D: usize>(&mut self, tensor: &Tensor<D>) {
        for i in 0..D {
            for j in 0..D {
                self.scalar(tensor[(i, j)]);
            }
        }
    }

    /// The coefficients of r_i r_j in ½ r·T r: those of the diagonal, then those of i < j.
    #[inline(always)]
    fn half_form<const D: usize>(&mut self, tensor: &Tensor<D>) {
        for i in 0..D {
            self.scalar(0.5 * tensor[(i, i)]);
        }
        for i in 0..D {
            for j in i + 1..D {
                self.scalar(0.5 * (tensor[(i, j)] + tensor[(j, i)]));
            }
        }
    }

    /// The upper triangle of a tensor without trace, without the last entry of its diagonal.
    #[inline(always)]
    fn deviator<const D: usize>(&mut self, deviator: &Tensor<D>) {
        for i in 0..D - 1 {
            for j in i..D {
                self.scalar(deviator[(i, j)]);
            }
        }
    }
}

impl SingleRecords {
    /// Fills a record of some quads for every particle; `smoothing_length` `[m]` gives the unit of positions.
    fn fill(
        &mut self,
        particles: usize,
        quads: usize,
        smoothing_length: f64,
        write: impl Fn(usize, &mut SingleWriter<'_>) + Sync,
    ) {
        let needed = particles * quads;
        if self.data.len() < needed {
            self.data.reserve_exact(needed + needed / 8 + 64 - self.data.len());
            self.data.resize(needed, [0.0; 4]);
        }
        self.unit = smoothing_length / UNITS;
        let inverse_unit = UNITS / smoothing_length;
        const BLOCK: usize = 1024;
        self.data[..needed].par_chunks_mut(quads * BLOCK).enumerate().for_each(|(block, chunk)| {
            for (offset, record) in chunk.chunks_exact_mut(quads).enumerate() {
                let record = record.as_flattened_mut();
                write(block * BLOCK + offset, &mut SingleWriter { record, next: 0, inverse_unit });
            }
        });
    }

    /// Records of eight particles.
    #[inline(always)]
    fn load<S: SingleLanes>(&self, quads: usize, indices: &LaneIndices<'_>) -> LaneRecord<S> {
        self.load_start(quads, quads, indices)
    }

    /// Their first few quads; the rest is zero.
    #[inline(always)]
    fn load_start<S: SingleLanes>(&self, quads: usize, wanted: usize, indices: &LaneIndices<'_>) -> LaneRecord<S> {
        let mut record = [[S::splat(0.0); 4]; QUADS];
        for quad in 0..wanted {
            record[quad] = S::load_quads(&self.data, quads, quad, indices);
        }
        record
    }
}

/// a − b `[m]` of positions as integers.
#[inline(always)]
fn apart<S: SingleLanes, const D: usize>(a: &[S; D], b: &[S; D], unit: S) -> [S; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = a[i].fixed_difference(b[i]) * unit;
    }
    lanes
}

/// Adds a part of a sum to the sum, and empties it.
#[inline(always)]
fn flush<V: Lanes>(sum: &mut V, part: &mut V::Single) {
    *sum = *sum + V::widen(*part);
    *part = V::Single::splat(0.0);
}

#[inline(always)]
fn flush_vector<V: Lanes, const D: usize>(sum: &mut [V; D], part: &mut [V::Single; D]) {
    for i in 0..D {
        flush(&mut sum[i], &mut part[i]);
    }
}

#[inline(always)]
fn flush_tensor<V: Lanes, const D: usize>(sum: &mut [[V; D]; D], part: &mut [[V::Single; D]; D]) {
    for i in 0..D {
        flush_vector(&mut sum[i], &mut part[i]);
    }
}

#[inline(always)]
fn narrow_tensor<V: Lanes, const D: usize>(tensor: &[[V; D]; D]) -> [[V::Single; D]; D] {
    let mut lanes = [[V::Single::splat(0.0); D]; D];
    for i in 0..D {
        for j in 0..D {
            lanes[i][j] = tensor[i][j].narrow();
        }
    }
    lanes
}

/// Distance and weight of a pair.
#[derive(Clone, Copy)]
struct Near<S, const D: usize> {
    /// r_ab `[m]`.
    r: [S; D],
    /// r² `[m²]`.
    square: S,
    /// V_b F `[1/m²]`.
    weight: S,
}

impl<S: SingleLanes, const D: usize> Near<S, D> {
    #[inline(always)]
    fn none() -> [Self; PART] {
        let zero = S::splat(0.0);
        [Self { r: [zero; D], square: zero, weight: zero }; PART]
    }
}

/// Distances and weights of up to [`PART`] chunks, in a loop of its own, so that square roots do not wait for what is done
/// with them. Records begin with position and volume.
#[inline(always)]
fn nearness<S: SingleLanes, const D: usize>(
    kernel: &Kernel<D>,
    records: &SingleRecords,
    quads: usize,
    place: &[S; D],
    part: LaneChunks<'_>,
    near: &mut [Near<S, D>; PART],
) {
    let unit = S::splat(records.unit);
    for (slot, b) in part.enumerate() {
        let first = S::load_quads(&records.data, quads, 0, &b);
        let mut other = *place;
        other.copy_from_slice(&first[..D]);
        let r = apart(place, &other, unit);
        let square = dot(&r, &r);
        // the mask tells the compiler what the caller knows
        near[slot & (PART - 1)] = Near { r, square, weight: kernel.gradient_weight(square, first[D]) };
    }
}
