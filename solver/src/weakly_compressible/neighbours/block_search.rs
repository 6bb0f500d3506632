//! The search that fills a block of groups of the neighbour list.

use super::CellGrid;
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes, Real, SingleLanes};
use crate::vector::Vector;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Particles per block of the parallel loops.
pub(crate) const BLOCK: usize = 256;
pub(super) const GROUPS: usize = BLOCK / LANES;
/// Largest number of neighbours in a row of the list.
pub(crate) const LARGEST_ROW: usize = 1024;

/// Place and number of a group's chunks.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Extent {
    pub(super) start: u32,
    pub(super) flow: u16,
    pub(super) wall: u16,
    pub(super) has_images: bool,
}

impl Extent {
    /// Index of the last of its chunks.
    pub(super) fn last_chunk(&self) -> usize {
        self.start as usize + usize::from(self.flow) + usize::from(self.wall)
    }
}

/// Inputs of a search: particles, a radius `[m]` and the grids of flow and walls.
#[derive(Clone, Copy)]
pub(super) struct Search<'a, const D: usize> {
    pub(super) positions: &'a [Vector<D>],
    pub(super) flow: usize,
    pub(super) real: usize,
    pub(super) radius: f64,
    pub(super) grids: (&'a CellGrid<D>, &'a CellGrid<D>),
    pub(super) sentinel: u32,
}

/// Masks of the first N lanes, for each N.
static FIRST_LANES: [u32; LANES + 1] = {
    let mut masks = [0; LANES + 1];
    let mut lane = 0;
    while lane < LANES {
        masks[lane + 1] = masks[lane] << 1 | 1;
        lane += 1;
    }
    masks
};

/// Neighbours of one particle as they are found; what is packed last may reach a chunk beyond the largest row.
type FoundRow = [u32; LARGEST_ROW + LANES];

/// The search for a block of groups.
pub(super) struct BlockSearch<'a, const D: usize> {
    pub(super) search: Search<'a, D>,
    pub(super) block: usize,
    pub(super) region: usize,
    pub(super) chunks: &'a mut [[u32; LANES]],
    pub(super) extents: &'a mut [Extent],
    /// Chunks that the block needs, and its first particle that has too many neighbours.
    pub(super) result: &'a mut (usize, usize),
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
                let found = search.rows::<V>(&own, part, &mut rows, &mut crowded, &mut has_images);
                let mut longest = 0;
                for lane in 0..LANES {
                    longest = if found[lane] > longest { found[lane] } else { longest };
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

    /// The neighbours of eight particles in one grid, the flow's (part 0) or the walls' (part 1); returns how many each
    /// has, up to the largest row. A particle with more is `crowded`, the first of them.
    #[inline(always)]
    fn rows<V: Lanes>(
        &self,
        own: &[u32; LANES],
        part: usize,
        rows: &mut [FoundRow; LANES],
        crowded: &mut usize,
        has_images: &mut bool,
    ) -> [usize; LANES] {
        let grid = if part == 0 { self.grids.0 } else { self.grids.1 };
        let mut found = [0; LANES];
        for lane in 0..LANES {
            let particle = own[lane];
            // no walls for the padding and for walls
            if particle != self.sentinel && (part == 0 || (particle as usize) < self.flow) {
                found[lane] = self.row::<V>(particle, grid, &mut rows[lane]);
            }
            if found[lane] > LARGEST_ROW {
                *crowded = (*crowded).min(particle as usize);
                found[lane] = LARGEST_ROW;
            }
            if part == 0 {
                for &index in &rows[lane][..found[lane]] {
                    *has_images |= index as usize >= self.real;
                }
            }
        }
        found
    }

    /// Writes the neighbours of one particle in a grid and returns their number; what does not fit is counted but
    /// not kept. Distances are taken in single precision, so that of what is beyond the radius by less than a millionth of it
    /// some is a neighbour.
    #[inline(always)]
    fn row<V: Lanes>(&self, particle: u32, grid: &CellGrid<D>, row: &mut FoundRow) -> usize {
        let centre = self.positions[particle as usize];
        let mut place = [V::Single::splat(0.0); D];
        for axis in 0..D {
            place[axis] = V::Single::load(&[grid.fixed(&centre, axis); LANES]);
        }
        let limit = V::Single::splat(CellGrid::<D>::limit());
        let mut found = 0usize;
        let (ranges, count) = grid.ranges(&centre);
        for range in &ranges[..count] {
            let mut start = range.start;
            while start < range.end {
                let mut distance_squared = V::Single::splat(0.0);
                for axis in 0..D {
                    let Some(coordinates) = grid.coordinates[axis][start..].first_chunk() else { unreachable!() };
                    let difference = place[axis].fixed_difference(V::Single::load(coordinates));
                    distance_squared = distance_squared + difference * difference;
                }
                let Some(indices) = grid.index[start..].first_chunk() else { unreachable!() };
                let near = distance_squared.less_mask(limit);
                let left = range.end - start;
                let inside = FIRST_LANES[if left < LANES { left } else { LANES }];
                let slot = if found < LARGEST_ROW { found } else { LARGEST_ROW };
                let Some(out) = row[slot..].first_chunk_mut() else { unreachable!() };
                found += V::pack(indices, near & inside, particle, out);
                start += LANES;
            }
        }
        if grid.is_cut && found <= LARGEST_ROW { self.without_strays(&centre, &mut row[..found]) } else { found }
    }

    /// Moves those within the radius to the front and returns their number: coordinates that wrap make neighbours of particles
    /// that are many cells apart, if a cell holds both.
    fn without_strays(&self, centre: &Vector<D>, row: &mut [u32]) -> usize {
        let mut near = 0;
        for k in 0..row.len() {
            let distance_squared = (self.positions[row[k] as usize] - centre).norm_squared();
            if distance_squared < self.radius * self.radius {
                row[near] = row[k];
                near += 1;
            }
        }
        near
    }
}
