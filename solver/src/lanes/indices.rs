//! Indices that were checked once, so that the loads of every later pass need no check of their own.
#![expect(unsafe_code, reason = "unchecked entries behind one length check")]

use super::LANES;
use crate::parallel::prelude::*;
use crate::vector::Vector;
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

    /// The bare indices.
    #[inline(always)]
    #[must_use]
    pub fn raw(&self) -> &'a [u32; LANES] {
        self.raw
    }

    /// The entries at `index · stride + offset` of an array, for eight indices.
    ///
    /// # Panics
    /// If the array is shorter than the bound, or the offset beyond the stride.
    #[inline(always)]
    pub(super) fn entries<'b, T>(&self, source: &'b [T], stride: usize, offset: usize) -> [&'b T; LANES] {
        assert!(source.len() >= self.bound * stride && offset < stride, "array shorter than its index bound");
        // SAFETY: raw < bound and offset < stride, so the entry lies inside the slice.
        let entry = |lane: usize| unsafe { source.get_unchecked(self.raw[lane] as usize * stride + offset) };
        [entry(0), entry(1), entry(2), entry(3), entry(4), entry(5), entry(6), entry(7)]
    }

    /// The entries of an array of vectors in the plane, as pairs.
    #[inline(always)]
    pub(super) fn pairs<'b, const D: usize>(&self, source: &'b [Vector<D>]) -> [&'b [f64; 2]; LANES] {
        assert!(D == 2, "vectors of two components");
        // SAFETY: a vector of two components is two f64.
        self.entries(unsafe { &*(std::ptr::from_ref(source) as *const [[f64; 2]]) }, 1, 0)
    }

    /// The same particles in arrays that leave out the first few, none of which they may be.
    #[inline(always)]
    #[must_use]
    pub fn places_from(&self, first: usize) -> LanePlaces {
        let mut raw = *self.raw;
        for lane in 0..LANES {
            raw[lane] = raw[lane].wrapping_sub(first as u32);
        }
        LanePlaces { raw, bound: self.bound - first }
    }
}

/// Eight places to be checked when they are used.
#[derive(Debug, Clone, Copy)]
pub struct LanePlaces {
    raw: [u32; LANES],
    bound: usize,
}

impl LanePlaces {
    /// The places as indices.
    ///
    /// # Panics
    /// If one is not below the bound.
    #[inline(always)]
    #[must_use]
    pub fn indices(&self) -> LaneIndices<'_> {
        LaneIndices::new(&self.raw, self.bound)
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

/// Chunks of eight indices, all below one bound. They change only by [`CheckedIndices::refill`] and
/// `CheckedIndices::refill_regions`, which check them, and are checked when they are read back.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(try_from = "PackedIndices", into = "PackedIndices")]
pub struct CheckedIndices {
    chunks: Vec<[u32; LANES]>,
    /// Chunks of a region, if there are regions, and at the start of each those that are not all zero.
    region: usize,
    used: Vec<usize>,
    bound: usize,
}

/// Chunks as they are written: of regions only what is used.
#[derive(Serialize, Deserialize)]
struct PackedIndices {
    chunks: Vec<[u32; LANES]>,
    region: usize,
    used: Vec<usize>,
    bound: usize,
}

impl From<CheckedIndices> for PackedIndices {
    fn from(CheckedIndices { mut chunks, region, used, bound }: CheckedIndices) -> Self {
        if region > 0 {
            let mut end = 0;
            for (index, &used) in used.iter().enumerate() {
                chunks.copy_within(index * region..index * region + used, end);
                end += used;
            }
            chunks.truncate(end);
        }
        Self { chunks, region, used, bound }
    }
}

impl TryFrom<PackedIndices> for CheckedIndices {
    type Error = &'static str;

    fn try_from(PackedIndices { chunks, region, used, bound }: PackedIndices) -> Result<Self, Self::Error> {
        if !all_below(&chunks, bound) || bound > LARGEST_BOUND {
            return Err("neighbour index out of range");
        }
        if region == 0 {
            return Ok(Self { chunks, region, used: Vec::new(), bound });
        }
        let total = used.iter().try_fold(0_usize, |total, &used| total.checked_add(used));
        let room = region.checked_mul(used.len()).filter(|&room| room / LARGEST_SPARSITY <= chunks.len());
        let (Some(room), true) = (room, total == Some(chunks.len()) && used.iter().all(|&used| used <= region)) else {
            return Err("a neighbour list whose parts do not fit together");
        };
        let mut spread = vec![[0; LANES]; room];
        let mut rest = &chunks[..];
        for (target, &used) in spread.chunks_mut(region).zip(&used) {
            let (part, later) = rest.split_at(used);
            target[..used].copy_from_slice(part);
            rest = later;
        }
        Ok(Self { chunks: spread, region, used, bound })
    }
}

/// Largest room for a list over its contents: a file must not buy all memory.
const LARGEST_SPARSITY: usize = 1 << 12;

impl CheckedIndices {
    /// Exclusive upper bound of every index.
    #[must_use]
    pub fn bound(&self) -> usize {
        self.bound
    }

    /// Chunks of a region; zero without regions.
    pub(crate) fn region(&self) -> usize {
        self.region
    }

    /// Lets `fill` rewrite the chunks and checks that every index is below `bound` afterwards.
    ///
    /// # Panics
    /// If one is not.
    pub fn refill<R>(&mut self, bound: usize, fill: impl FnOnce(&mut Vec<[u32; LANES]>) -> R) -> R {
        // taken out, so that unchecked chunks cannot stay behind a panic
        let mut chunks = std::mem::take(&mut self.chunks);
        let result = fill(&mut chunks);
        assert!(
            chunks.par_chunks(4096).map(|part| all_below(part, bound)).reduce(|| true, |a, b| a && b),
            "neighbour index out of range"
        );
        self.used.clear();
        (self.region, self.chunks, self.bound) = (0, chunks, bound);
        result
    }

    /// Lets `fill` rewrite regions of equal length, one for each of `items`, and checks that every index is below `bound`
    /// afterwards. `fill` gets an item with its region and returns how many chunks it wants and another result; both are joined
    /// over all regions, the former by their largest, the latter by `join`, in any order. A region that is too short is left empty. Memory beyond what was ever
    /// written is not touched, so that it costs nothing.
    ///
    /// # Panics
    /// If an index is not below the bound.
    pub(crate) fn refill_regions<T, R: Send + Sync + Clone>(
        &mut self,
        (bound, region): (usize, usize),
        items: impl Items<Item = T>,
        fill: impl Fn(usize, T, &mut [[u32; LANES]]) -> (usize, R) + Sync,
        (none, join): (R, impl Fn(R, R) -> R + Sync + Send),
    ) -> (usize, R) {
        // taken out, so that unchecked chunks cannot stay behind a panic
        let (mut chunks, mut used) = (std::mem::take(&mut self.chunks), std::mem::take(&mut self.used));
        let regions = items.length();
        if chunks.capacity() < regions * region {
            // zeros that the system hands out when they are first written; some head room costs nothing
            drop(chunks);
            chunks = vec![[0; LANES]; (regions + regions / 8) * region];
            used.clear();
        } else if self.region != region {
            chunks.clear();
            used.clear();
        }
        chunks.resize(regions * region, [0; LANES]);
        used.resize(regions, 0);
        let result = (chunks.par_chunks_mut(region), &mut used, items)
            .enumerate()
            .map(|(index, (chunks, used, item))| {
                let (wanted, result) = fill(index, item, chunks);
                // what does not fit is left out and filled again
                let written = if wanted <= chunks.len() { wanted } else { 0 };
                if wanted > chunks.len() {
                    *used = chunks.len();
                }
                if written < *used {
                    chunks[written..*used].fill([0; LANES]);
                }
                *used = written;
                assert!(all_below(&chunks[..written], bound), "neighbour index out of range");
                (wanted, result)
            })
            .reduce(|| (0, none.clone()), |a, b| (a.0.max(b.0), join(a.1, b.1)));
        *self = Self { chunks, region, used, bound };
        result
    }

    /// Copies the chunks of others into existing memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.chunks.clone_from(&other.chunks);
        self.bound = other.bound;
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

    /// Removes and returns the first `count` items, or all if there are fewer.
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

    /// Chunks as one region.
    fn filled(bound: usize, chunks: &[[u32; LANES]]) -> CheckedIndices {
        let mut indices = CheckedIndices::default();
        refill(&mut indices, bound, &[chunks], chunks.len());
        indices
    }

    /// Parts as regions of a length; returns the longest part.
    fn refill(indices: &mut CheckedIndices, bound: usize, parts: &[&[[u32; LANES]]], region: usize) -> usize {
        let fill = |_, part: &&[[u32; LANES]], chunks: &mut [[u32; LANES]]| {
            for (chunk, value) in chunks.iter_mut().zip(*part) {
                *chunk = *value;
            }
            (part.len(), ())
        };
        indices.refill_regions((bound, region), parts, fill, ((), |(), ()| ())).0
    }

    #[test]
    fn previous_content_of_a_region_is_gone() {
        let mut indices = CheckedIndices::default();
        assert_eq!(refill(&mut indices, 9, &[&[[8; LANES]; 3], &[[7; LANES]; 2]], 4), 3);
        // fewer particles: an index of before would now be out of range
        assert_eq!(refill(&mut indices, 4, &[&[[3; LANES]; 1], &[[2; LANES]; 2]], 4), 2);
        let expected = [3, 0, 0, 0, 2, 2, 0, 0].map(|index| [index; LANES]);
        assert_eq!(indices.part(0..8).raw(), expected);
        // what does not fit is told and left out
        assert_eq!(refill(&mut indices, 4, &[&[[9; LANES]; 6]], 4), 6);
        assert_eq!(indices.part(0..4).raw(), [[0; LANES]; 4]);
        assert_eq!(refill(&mut indices, 4, &[&[[1; LANES]; 5], &[[3; LANES]; 1]], 5), 5);
        assert_eq!(indices.part(3..7).raw(), [1, 1, 3, 0].map(|index| [index; LANES]));
    }

    #[test]
    #[should_panic(expected = "out of range")]
    fn an_index_beyond_the_arrays_is_refused() {
        let _ = LaneIndices::new(&[0, 1, 2, 3, 4, 5, 6, 7], 7);
    }

    #[test]
    #[should_panic(expected = "out of range")]
    fn a_list_with_an_index_beyond_the_arrays_is_refused() {
        let _ = filled(7, &[[0; LANES], [3, 1, 7, 2, 0, 0, 0, 0]]);
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
    fn written_output_is_read_back_unchanged() {
        let mut indices = CheckedIndices::default();
        refill(&mut indices, 9, &[&[[8; LANES]; 3], &[], &[[7; LANES]; 1]], 4);
        let packed = PackedIndices::from(indices.clone());
        assert_eq!(packed.chunks, [8, 8, 8, 7].map(|index| [index; LANES]));
        let read = CheckedIndices::try_from(packed).expect("whole");
        assert_eq!(read.part(0..12).raw(), indices.part(0..12).raw());
        let packed = || PackedIndices::from(indices.clone());
        assert!(CheckedIndices::try_from(PackedIndices { bound: 8, ..packed() }).is_err());
        assert!(CheckedIndices::try_from(PackedIndices { region: 2, ..packed() }).is_err());
        assert!(CheckedIndices::try_from(PackedIndices { used: vec![3, 0, 2], ..packed() }).is_err());
        assert!(CheckedIndices::try_from(PackedIndices { region: usize::MAX / 3, ..packed() }).is_err());
    }

    #[test]
    fn a_part_is_walked_in_order() {
        let indices = filled(5, &[[0; LANES], [1; LANES], [2; LANES], [4; LANES]]);
        let seen: Vec<u32> = indices.part(1..4).map(|chunk| chunk.raw[3]).collect();
        assert_eq!(seen, [1, 2, 4]);
    }
}
