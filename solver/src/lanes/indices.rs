//! Indices that were checked once, so that the loads of every later pass need no check of their own.

use super::LANES;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Largest bound: any element of any record is then addressed without overflow.
const LARGEST_BOUND: usize = i32::MAX as usize / 16;

/// Eight indices below a bound.
#[derive(Debug, Clone, Copy)]
pub struct LaneIndices<'a> {
    pub(super) raw: &'a [u32; LANES],
    pub(super) bound: usize,
}

impl<'a> LaneIndices<'a> {
    /// Checks that every index is below `bound`.
    ///
    /// # Panics
    /// If one is not: a neighbour list that does not belong to the arrays.
    #[inline(always)]
    #[must_use]
    pub fn new(raw: &'a [u32; LANES], bound: usize) -> Self {
        assert!(all_below(std::slice::from_ref(raw), bound), "neighbour index out of range");
        Self { raw, bound }
    }
}

/// Whether every index is below the bound.
#[inline(always)]
fn all_below(chunks: &[[u32; LANES]], bound: usize) -> bool {
    if bound == 0 || bound > LARGEST_BOUND {
        return chunks.is_empty();
    }
    let last = bound as u32 - 1;
    // For numbers below 2³¹ the top bit of last − index tells whether index > last, and that of the index itself
    // whether it is such a number. A maximum would need instructions that plain x86-64 does not have.
    let mut bits = [0; LANES];
    for chunk in chunks {
        for lane in 0..LANES {
            bits[lane] |= last.wrapping_sub(chunk[lane]) | chunk[lane];
        }
    }
    bits.iter().fold(0, |all, bits| all | bits) >> 31 == 0
}

/// Chunks of eight indices, all below one bound. They change only by [`CheckedIndices::refill`], which checks them, and are
/// checked when they are read back.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(try_from = "UncheckedIndices")]
pub struct CheckedIndices {
    chunks: Vec<[u32; LANES]>,
    bound: usize,
}

/// Chunks as they were written.
#[derive(Deserialize)]
struct UncheckedIndices {
    chunks: Vec<[u32; LANES]>,
    bound: usize,
}

impl TryFrom<UncheckedIndices> for CheckedIndices {
    type Error = &'static str;

    fn try_from(UncheckedIndices { chunks, bound }: UncheckedIndices) -> Result<Self, Self::Error> {
        if all_below(&chunks, bound) { Ok(Self { chunks, bound }) } else { Err("neighbour index out of range") }
    }
}

impl CheckedIndices {
    /// What every index is below.
    #[must_use]
    pub fn bound(&self) -> usize {
        self.bound
    }

    /// Lets `fill` rewrite the chunks and checks that every index is below `bound` afterwards.
    ///
    /// # Panics
    /// If one is not.
    pub fn refill<R>(&mut self, bound: usize, fill: impl FnOnce(&mut Vec<[u32; LANES]>) -> R) -> R {
        // taken out, so that unchecked chunks cannot stay behind a panic
        let mut chunks = std::mem::take(&mut self.chunks);
        let result = fill(&mut chunks);
        assert!(chunks.par_chunks(4096).all(|part| all_below(part, bound)), "neighbour index out of range");
        (self.chunks, self.bound) = (chunks, bound);
        result
    }

    /// Number of chunks.
    #[must_use]
    pub fn len(&self) -> usize {
        self.chunks.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.chunks.is_empty()
    }

    /// Some neighbouring chunks.
    #[inline(always)]
    #[must_use]
    pub fn part(&self, range: std::ops::Range<usize>) -> LaneChunks<'_> {
        LaneChunks { raw: &self.chunks[range], bound: self.bound }
    }
}

/// Checked chunks, to be walked through.
#[derive(Debug, Clone, Copy)]
pub struct LaneChunks<'a> {
    raw: &'a [[u32; LANES]],
    bound: usize,
}

impl<'a> LaneChunks<'a> {
    /// Number of chunks left.
    #[inline(always)]
    #[must_use]
    pub fn len(&self) -> usize {
        self.raw.len()
    }

    /// Whether none is left.
    #[inline(always)]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.raw.is_empty()
    }

    /// Takes the first few away, as many as there are.
    #[inline(always)]
    #[must_use]
    pub fn take_first(&mut self, count: usize) -> Self {
        let (first, rest) = self.raw.split_at(if count < self.raw.len() { count } else { self.raw.len() });
        self.raw = rest;
        Self { raw: first, bound: self.bound }
    }

    /// The bare indices.
    #[must_use]
    pub fn raw(&self) -> &'a [[u32; LANES]] {
        self.raw
    }
}

impl<'a> Iterator for LaneChunks<'a> {
    type Item = LaneIndices<'a>;

    #[inline(always)]
    fn next(&mut self) -> Option<LaneIndices<'a>> {
        let (first, rest) = self.raw.split_first()?;
        self.raw = rest;
        Some(LaneIndices { raw: first, bound: self.bound })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[should_panic(expected = "out of range")]
    fn an_index_beyond_the_arrays_is_refused() {
        let _ = LaneIndices::new(&[0, 1, 2, 3, 4, 5, 6, 7], 7);
    }

    #[test]
    #[should_panic(expected = "out of range")]
    fn a_list_with_an_index_beyond_the_arrays_is_refused() {
        CheckedIndices::default().refill(7, |chunks| *chunks = vec![[0; LANES], [3, 1, 7, 2, 0, 0, 0, 0]]);
    }

    #[test]
    fn the_check_is_exact_for_every_kind_of_number() {
        for bound in [1, 7, 4000, LARGEST_BOUND] {
            for index in [0, 1, 6, 7, 3999, 4000, LARGEST_BOUND as u32, u32::MAX / 2, u32::MAX / 2 + 1, u32::MAX] {
                let chunks = [[0; LANES], [0, 0, 0, index, 0, 0, 0, 0]];
                assert_eq!(all_below(&chunks, bound), (index as usize) < bound, "{index} below {bound}");
            }
        }
        assert!(!all_below(&[[0; LANES]], 0) && !all_below(&[[0; LANES]], LARGEST_BOUND + 1));
    }

    #[test]
    fn a_part_is_walked_in_order() {
        let mut indices = CheckedIndices::default();
        indices.refill(5, |chunks| chunks.extend([[0; LANES], [1; LANES], [2; LANES], [4; LANES]]));
        let seen: Vec<u32> = indices.part(1..4).map(|chunk| chunk.raw[3]).collect();
        assert_eq!(seen, [1, 2, 4]);
    }
}
