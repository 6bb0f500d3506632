//! A full neighbour list in groups of eight particles: one lane, one particle.
//!
//! Chunk k of a group holds the k-th neighbour of each of its eight particles, so that a pair sum adds up in its
//! lane, in list order, and everything that follows a sum is done for eight particles at once. A group has first its
//! own particles, then their flow neighbours, then their wall neighbours, each part padded with the sentinel: a far
//! particle of no volume, whose contributions are exactly zero. Wall particles have flow neighbours only.

use super::CellGrid;
use crate::lanes::{CheckedIndices, InstructionSet, LANES, LaneChunks, LaneIndices, LanePass, Lanes};
use crate::vector::Vector;
use rayon::prelude::*;
use std::ops::Range;

/// Eight particles and their neighbours.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NeighbourGroup<'a> {
    /// The particles themselves.
    pub(crate) own: LaneIndices<'a>,
    /// Flow neighbours and their images.
    pub(crate) flow: LaneChunks<'a>,
    /// Wall neighbours and their images.
    pub(crate) wall: LaneChunks<'a>,
    /// Both, in this order.
    pub(crate) pairs: LaneChunks<'a>,
    /// Whether images are among the flow neighbours.
    pub(crate) has_images: bool,
    /// Where the first flow chunk stands among all chunks; the wall chunks follow the flow chunks.
    pub(crate) first_pair: usize,
}

/// The neighbours of one particle, for diagnostics and tests.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// Flow neighbours and their images, in list order.
    pub flow: Vec<u32>,
    /// Wall neighbours and their images, in list order.
    pub wall: Vec<u32>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Extent {
    start: u32,
    flow: u16,
    wall: u16,
    has_images: bool,
}

/// The neighbour list of all real particles: groups of the flow, then groups of the walls.
#[derive(Debug, Default)]
pub struct VerletList {
    /// Flow particles.
    flow: usize,
    sentinel: u32,
    extents: Vec<Extent>,
    indices: CheckedIndices,
    /// Chunks set aside for a block of groups.
    region: usize,
}

/// Particles a block of the parallel loops.
pub(crate) const BLOCK: usize = 256;
const GROUPS: usize = BLOCK / LANES;
/// Neighbours that a row of the list can hold.
pub(crate) const LARGEST_ROW: usize = 1024;

impl VerletList {
    /// Group `index` of eight flow particles: those from 8 `index` on.
    #[inline(always)]
    #[must_use]
    pub(crate) fn group(&self, index: usize) -> NeighbourGroup<'_> {
        let Extent { start, flow, wall, has_images } = self.extents[index];
        let first_pair = start as usize + 1;
        let wall_start = first_pair + flow as usize;
        let mut own = self.indices.part(first_pair - 1..first_pair);
        let Some(own) = own.next() else { unreachable!("a part of one chunk") };
        NeighbourGroup {
            own,
            flow: self.indices.part(first_pair..wall_start),
            wall: self.indices.part(wall_start..wall_start + wall as usize),
            pairs: self.indices.part(first_pair..wall_start + wall as usize),
            has_images,
            first_pair,
        }
    }

    /// Groups of flow particles; the groups of the wall particles follow.
    #[must_use]
    pub(crate) fn flow_groups(&self) -> usize {
        self.flow.div_ceil(LANES)
    }

    /// Chunks set aside for every [`BLOCK`] of particles: what belongs to a block's pairs may be kept in slices of
    /// this length.
    #[must_use]
    pub(crate) fn region(&self) -> usize {
        self.region
    }

    /// The neighbours of a real particle without padding.
    #[must_use]
    pub fn row(&self, particle: usize) -> Row {
        let (group, lane) = if particle < self.flow {
            (particle / LANES, particle % LANES)
        } else {
            let wall = particle - self.flow;
            (self.flow_groups() + wall / LANES, wall % LANES)
        };
        let group = self.group(group);
        let listed = |chunks: LaneChunks<'_>| {
            chunks.raw().iter().map(|chunk| chunk[lane]).filter(|&index| index != self.sentinel).collect()
        };
        Row { flow: listed(group.flow), wall: listed(group.wall) }
    }

    /// Fills the list for the first `real` positions, of which the first `flow` are the flow's, with all neighbours
    /// nearer than `radius` `[m]`.
    ///
    /// # Errors
    /// The particle that has more neighbours than a row can hold: the flow has collapsed onto itself.
    pub(crate) fn rebuild<const D: usize>(
        &mut self,
        positions: &[Vector<D>],
        flow: usize,
        real: usize,
        radius: f64,
        grids: (&CellGrid<D>, &CellGrid<D>),
        set: InstructionSet,
    ) -> Result<(), usize> {
        self.flow = flow;
        self.sentinel = positions.len() as u32 - 1;
        let groups = self.flow_groups() + (real - flow).div_ceil(LANES);
        let search = Search { positions, flow, real, radius, grids, sentinel: self.sentinel };
        self.extents.resize(groups, Extent::default());
        if self.region == 0 {
            self.region = GROUPS * if D == 2 { 40 } else { 130 };
        }
        loop {
            let (region, extents) = (self.region, &mut self.extents);
            let (needed, crowded) = self.indices.refill(positions.len(), |chunks| {
                chunks.resize(groups.div_ceil(GROUPS) * region, [0; LANES]);
                (chunks.par_chunks_mut(region), extents.par_chunks_mut(GROUPS))
                    .into_par_iter()
                    .enumerate()
                    .map(|(block, (chunks, extents))| {
                        let mut result = (0, usize::MAX);
                        let result_of_block = &mut result;
                        set.run(BlockSearch { search, block, region, chunks, extents, result: result_of_block });
                        result
                    })
                    .reduce(|| (0, usize::MAX), |a, b| (a.0.max(b.0), a.1.min(b.1)))
            });
            if crowded != usize::MAX {
                // what was cut short is not to be read
                self.extents.fill(Extent::default());
                return Err(crowded);
            }
            if needed <= region {
                return Ok(());
            }
            self.region = needed + needed / 8;
        }
    }
}

#[derive(Clone, Copy)]
struct Search<'a, const D: usize> {
    positions: &'a [Vector<D>],
    flow: usize,
    real: usize,
    radius: f64,
    grids: (&'a CellGrid<D>, &'a CellGrid<D>),
    sentinel: u32,
}

/// Neighbours of one particle as they are found; what is packed last may reach a chunk beyond the largest row.
type FoundRow = [u32; LARGEST_ROW + LANES];

/// The search for a block of groups.
struct BlockSearch<'a, const D: usize> {
    search: Search<'a, D>,
    block: usize,
    region: usize,
    chunks: &'a mut [[u32; LANES]],
    extents: &'a mut [Extent],
    /// Chunks that the block needs, and its first particle that has too many neighbours.
    result: &'a mut (usize, usize),
}

impl<const D: usize> LanePass for BlockSearch<'_, D> {
    /// Fills the groups as far as they fit.
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { search, block, region, chunks, extents, result } = self;
        let mut rows: [FoundRow; LANES] = [[0; LARGEST_ROW + LANES]; LANES];
        let (mut used, mut crowded) = (0, usize::MAX);
        for (offset, extent) in extents.iter_mut().enumerate() {
            let own = search.particles(block * GROUPS + offset);
            let place = used;
            used += 1;
            if let Some(chunk) = chunks.get_mut(place) {
                *chunk = own;
            }
            let mut parts = [0; 2];
            let mut has_images = false;
            for part in 0..2 {
                let grid = if part == 0 { search.grids.0 } else { search.grids.1 };
                let mut found = [0; LANES];
                let mut longest = 0;
                for lane in 0..LANES {
                    let particle = own[lane];
                    // no walls for the padding and for walls
                    if particle != search.sentinel && (part == 0 || (particle as usize) < search.flow) {
                        found[lane] = search.row::<V>(particle, grid, &mut rows[lane]);
                    }
                    if found[lane] > LARGEST_ROW {
                        crowded = crowded.min(particle as usize);
                        found[lane] = LARGEST_ROW;
                    }
                    longest = if found[lane] > longest { found[lane] } else { longest };
                    if part == 0 {
                        for &index in &rows[lane][..found[lane]] {
                            has_images |= index as usize >= search.real;
                        }
                    }
                }
                for lane in 0..LANES {
                    rows[lane][found[lane]..longest].fill(search.sentinel);
                }
                if let Some(target) = chunks.get_mut(used..used + longest) {
                    for (k, chunk) in target.iter_mut().enumerate() {
                        for lane in 0..LANES {
                            chunk[lane] = rows[lane][k];
                        }
                    }
                }
                parts[part] = longest;
                used += longest;
            }
            *extent = Extent {
                start: (block * region + place) as u32,
                flow: parts[0] as u16,
                wall: parts[1] as u16,
                has_images,
            };
        }
        // nothing of an older list stays behind; a block that did not fit is filled again
        let rest = if used <= chunks.len() { used } else { 0 };
        chunks[rest..].fill([search.sentinel; LANES]);
        *result = (used, crowded);
    }
}

impl<const D: usize> Search<'_, D> {
    /// The particles of a group, padded with the sentinel.
    fn particles(&self, group: usize) -> [u32; LANES] {
        let flow_groups = self.flow.div_ceil(LANES);
        let range: Range<usize> = if group < flow_groups {
            LANES * group..self.flow
        } else {
            self.flow + LANES * (group - flow_groups)..self.real
        };
        let mut own = [self.sentinel; LANES];
        for (slot, particle) in own.iter_mut().zip(range) {
            *slot = particle as u32;
        }
        own
    }

    /// Writes the neighbours of one particle in a grid and returns their number; what does not fit is counted but
    /// not kept.
    #[inline(always)]
    fn row<V: Lanes>(&self, particle: u32, grid: &CellGrid<D>, row: &mut FoundRow) -> usize {
        let centre = self.positions[particle as usize];
        let limit = V::splat(self.radius * self.radius);
        let mut found = 0usize;
        let (ranges, count) = grid.ranges(&centre);
        for range in &ranges[..count] {
            let mut start = range.start;
            while start < range.end {
                let mut distance_squared = V::splat(0.0);
                for axis in 0..D {
                    let Some(coordinates) = grid.coordinates[axis][start..].first_chunk() else { unreachable!() };
                    let difference = V::splat(centre[axis]) - V::load(coordinates);
                    distance_squared = distance_squared + difference * difference;
                }
                let Some(indices) = grid.index[start..].first_chunk() else { unreachable!() };
                let near = distance_squared.less_mask(limit);
                let left = range.end - start;
                let inside = if left < LANES { (1 << left) - 1 } else { (1 << LANES) - 1 };
                let slot = if found < LARGEST_ROW { found } else { LARGEST_ROW };
                let Some(out) = row[slot..].first_chunk_mut() else { unreachable!() };
                found += V::pack(indices, near & inside, particle, out);
                start += LANES;
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rebuilt(list: &mut VerletList, positions: &[Vector<2>], radius: f64) {
        let real = positions.len() - 1;
        let mut grids = (CellGrid::new(), CellGrid::new());
        for grid in [&mut grids.0, &mut grids.1] {
            grid.cover(positions[..real].iter(), radius);
        }
        grids.0.sort((0..real).map(|index| (index as u32, &positions[index])));
        grids.1.sort(std::iter::empty());
        list.rebuild(positions, real, real, radius, (&grids.0, &grids.1), InstructionSet::best()).expect("room");
    }

    #[test]
    fn a_crowded_list_after_a_larger_one_grows_and_keeps_nothing_of_it() {
        let mut list = VerletList::default();
        let line = |count: usize, step: f64| -> Vec<_> {
            (0..count).map(|k| Vector::<2>::new(k as f64 * step, 0.0)).chain([Vector::<2>::repeat(1e9)]).collect()
        };
        rebuilt(&mut list, &line(3000, 1.0), 1.5);
        assert_eq!(list.row(7).flow, [6, 8]);
        rebuilt(&mut list, &line(600, 0.01), 1.005);
        for particle in [0, 299, 599] {
            let expected: Vec<u32> = (0..600u32).filter(|&k| k != particle && k.abs_diff(particle) <= 100).collect();
            assert_eq!(list.row(particle as usize).flow, expected);
        }
    }
}
