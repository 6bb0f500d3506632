//! A full neighbour list in groups of eight particles: one lane, one particle.
//!
//! Chunk k of a group holds the k-th neighbour of each of its eight particles, so that a pair sum adds up in its
//! lane, in list order, and everything that follows a sum is done for eight particles at once. A group has first its
//! own particles, then their flow neighbours, then their wall neighbours, each part padded with the sentinel: a far
//! particle of no volume, whose contributions are exactly zero. Wall particles have flow neighbours only.

use super::CellGrid;
use super::block_search::{BlockSearch, Extent, GROUPS, Search};
use crate::lanes::{CheckedIndices, InstructionSet, LANES, LaneChunks, LaneIndices};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// Eight particles and their neighbours.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NeighbourGroup<'a> {
    /// The particles themselves.
    pub(crate) own: LaneIndices<'a>,
    /// Flow neighbours and their images.
    pub(crate) flow: LaneChunks<'a>,
    /// Wall neighbours and their images.
    pub(crate) wall: LaneChunks<'a>,
    /// Both items, in this order.
    pub(crate) pairs: LaneChunks<'a>,
    /// Whether images are among the flow neighbours.
    pub(crate) has_images: bool,
    /// Index of the first flow chunk among all chunks; the wall chunks follow the flow chunks.
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

/// The neighbour list of all real particles: groups of the flow, then groups of the walls.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct VerletList {
    /// Flow particles.
    flow: usize,
    sentinel: u32,
    extents: Vec<Extent>,
    indices: CheckedIndices,
    /// Chunks set aside for a block of groups.
    pub(crate) region: usize,
}

impl VerletList {
    /// Whether the list belongs to these numbers of flow particles, real particles and all particles.
    pub(crate) fn belongs_to(&self, flow: usize, real: usize, all: usize) -> bool {
        let groups = flow.div_ceil(LANES) + (real - flow).div_ceil(LANES);
        let is_wall = |chunks: std::ops::Range<usize>| {
            self.indices.part(chunks).raw().iter().flatten().all(|&index| index as usize >= flow)
        };
        let is_sound = |(group, extent): (usize, &Extent)| {
            let (region, start, last) = (group / GROUPS * self.region, extent.start as usize, extent.last_chunk());
            let is_inside = start >= region && last < (region + self.region).min(self.indices.len());
            let walls = start + 1 + usize::from(extent.flow)..last + 1;
            is_inside && is_wall(walls) && (group < self.flow_groups() || is_wall(start..start + 1))
        };
        self.flow == flow
            && self.indices.bound() == all
            && self.sentinel as usize + 1 == all
            && self.extents.len() == groups
            && self.region == self.indices.region()
            && self.extents.iter().enumerate().all(is_sound)
    }

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
    /// nearer than `radius` `[m]`, which is the size of the cells. Of those farther by less than a millionth some are listed
    /// too, since distances are taken in single precision.
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
            let region = self.region;
            let fill = |block, extents: &mut [Extent], chunks: &mut [[u32; LANES]]| {
                let mut result = (0, usize::MAX);
                let result_of_block = &mut result;
                set.run(BlockSearch { search, block, region, chunks, extents, result: result_of_block });
                result
            };
            let first_crowded = (usize::MAX, |a: usize, b: usize| a.min(b));
            let blocks = self.extents.par_chunks_mut(GROUPS);
            let (needed, crowded) = self.indices.refill_regions((positions.len(), region), blocks, fill, first_crowded);
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

#[cfg(test)]
mod tests {
    use super::*;

    fn rebuilt(list: &mut VerletList, positions: &[Vector<2>], radius: f64) {
        let real = positions.len() - 1;
        let mut grids = (CellGrid::new(), CellGrid::new());
        for grid in [&mut grids.0, &mut grids.1] {
            grid.cover(&positions[..real], radius);
        }
        grids.0.sort(positions, real, |entry| entry);
        grids.1.sort(positions, 0, |entry| entry);
        for grid in [&mut grids.0, &mut grids.1] {
            grid.take_coordinates(positions);
        }
        list.rebuild(positions, real, real, radius, (&grids.0, &grids.1), InstructionSet::best()).expect("room");
    }

    #[test]
    fn strays_that_share_a_cell_are_no_neighbours_unless_they_are_near() {
        let mut list = VerletList::default();
        // so far away that they share the last cell; coordinates wrap after 32 cells of the radius
        let far = 1e7;
        let places = (0..500).map(f64::from).chain([far, far + 32.0 * 1.5, far + 64.0 * 1.5, far + 64.0 * 1.5 + 1.0]);
        let positions: Vec<_> = places.map(|x| Vector::<2>::new(x, 0.0)).chain([Vector::<2>::repeat(1e9)]).collect();
        rebuilt(&mut list, &positions, 1.5);
        assert_eq!(list.row(250).flow, [249, 251]);
        assert_eq!([500, 501, 502, 503].map(|stray| list.row(stray).flow), [vec![], vec![], vec![503], vec![502]]);
    }

    #[test]
    fn a_list_whose_walls_are_of_the_flow_or_whose_chunks_lie_in_another_block_belongs_to_no_particles() {
        let places = |count: u32, y: f64| (0..count).map(move |k| Vector::<2>::new(f64::from(k), y));
        let positions: Vec<_> = places(600, 0.0).chain(places(20, -1.0)).chain([Vector::<2>::repeat(1e9)]).collect();
        let (flow, real, mut list, mut grids) = (600, 620, VerletList::default(), [CellGrid::new(), CellGrid::new()]);
        for (grid, range) in grids.iter_mut().zip([0..flow, flow..real]) {
            grid.cover(&positions[..real], 1.5);
            let first = range.start;
            grid.sort(&positions, range.len(), |entry| entry + first);
            grid.take_coordinates(&positions);
        }
        list.rebuild(&positions, flow, real, 1.5, (&grids[0], &grids[1]), InstructionSet::best()).expect("room");
        assert!(list.row(3).wall.len() == 3 && list.belongs_to(flow, real, positions.len()));
        let changes: [fn(&mut Extent); 4] = [
            |extent| (extent.flow, extent.wall) = (extent.flow - 1, extent.wall + 1),
            |extent| extent.start = 0,
            |extent| extent.wall = u16::MAX,
            |extent| extent.start = u32::MAX,
        ];
        for (change, group) in changes.into_iter().zip([0, GROUPS + 8, 0, 1]) {
            let mut other = list.clone();
            change(&mut other.extents[group]);
            assert!(!other.belongs_to(flow, real, positions.len()), "group {group}");
        }
        let walls = list.flow_groups();
        list.extents[walls].start = list.extents[0].start;
        assert!(!list.belongs_to(flow, real, positions.len()), "walls that are flow particles");
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
