//! A full neighbour list of fixed stride in chunks of eight lanes.
//!
//! Each row holds first the flow neighbours, then the wall neighbours, each part padded with the sentinel: a far
//! particle of no volume, whose contributions are exactly zero. Rows of wall particles hold flow neighbours only.

use super::CellGrid;
use crate::lanes::LANES;
use crate::vector::Vector;
use rayon::prelude::*;

/// Chunks of eight neighbour indices of one particle.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    /// Flow neighbours and their images.
    pub flow: &'a [[u32; LANES]],
    /// Wall neighbours and their images.
    pub wall: &'a [[u32; LANES]],
}

/// The neighbour list of all real particles.
#[derive(Debug, Default)]
pub struct VerletList {
    stride: usize,
    chunks: Vec<[u32; LANES]>,
    counts: Vec<(u8, u8)>,
}

/// Rows a block of the parallel loops.
pub(crate) const BLOCK: usize = 256;
const LARGEST_ROW: usize = 1024;

impl VerletList {
    /// The row of real particle `particle`.
    #[inline(always)]
    #[must_use]
    pub fn row(&self, particle: usize) -> Row<'_> {
        let (flow, wall) = self.counts[particle];
        let (flow, wall) = (flow as usize, wall as usize);
        let row = &self.chunks[particle * self.stride..particle * self.stride + flow + wall];
        let (flow, wall) = row.split_at(flow);
        Row { flow, wall }
    }

    /// Chunks a row.
    #[inline(always)]
    #[must_use]
    pub fn stride(&self) -> usize {
        self.stride
    }

    /// The neighbours of `particle` without padding, in list order.
    #[must_use]
    pub fn neighbours(&self, particle: usize, sentinel: u32) -> Vec<u32> {
        let row = self.row(particle);
        row.flow.iter().chain(row.wall).flatten().copied().filter(|&index| index != sentinel).collect()
    }

    /// Fills the list for the first `flow + wall` positions with all neighbours nearer than `radius` `[m]`.
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
    ) -> Result<(), usize> {
        let sentinel = positions.len() as u32 - 1;
        if self.stride == 0 {
            self.stride = if D == 2 { 8 } else { 20 };
        }
        loop {
            let stride = self.stride;
            self.chunks.resize(real * stride, [sentinel; LANES]);
            self.counts.resize(real, (0, 0));
            let worst = (
                self.chunks[..real * stride].par_chunks_mut(BLOCK * stride),
                self.counts[..real].par_chunks_mut(BLOCK),
            )
                .into_par_iter()
                .enumerate()
                .with_min_len(4)
                .map(|(block, (chunks, counts))| {
                    let mut buffer = [0u32; LARGEST_ROW];
                    let mut largest = (0, 0);
                    for (row, count) in counts.iter_mut().enumerate() {
                        let particle = block * BLOCK + row;
                        let chunks = &mut chunks[row * stride..(row + 1) * stride];
                        let flow_found = search(positions, particle, radius, grids.0, &mut buffer);
                        let flow_chunks = store(&buffer[..flow_found.min(LARGEST_ROW)], sentinel, chunks)
                            .max(flow_found.div_ceil(LANES));
                        let mut wall_chunks = 0;
                        if particle < flow {
                            let wall_found = search(positions, particle, radius, grids.1, &mut buffer);
                            let rest = flow_chunks.min(stride);
                            wall_chunks = store(&buffer[..wall_found.min(LARGEST_ROW)], sentinel, &mut chunks[rest..])
                                .max(wall_found.div_ceil(LANES));
                        }
                        *count = (flow_chunks.min(255) as u8, wall_chunks.min(255) as u8);
                        largest = largest.max((flow_chunks + wall_chunks, particle));
                    }
                    largest
                })
                .reduce(|| (0, 0), std::cmp::Ord::max);
            if worst.0 <= stride {
                return Ok(());
            }
            if worst.0 > LARGEST_ROW / LANES {
                return Err(worst.1);
            }
            self.stride = worst.0 + 1;
        }
    }
}

/// Collects the neighbours of one particle in a grid; a full buffer reports its capacity.
#[inline(always)]
fn search<const D: usize>(
    positions: &[Vector<D>],
    particle: usize,
    radius: f64,
    grid: &CellGrid<D>,
    buffer: &mut [u32; LARGEST_ROW],
) -> usize {
    let centre = positions[particle];
    let limit = radius * radius;
    let mut found = 0usize;
    grid.ranges(&centre, |range| {
        for (position, &index) in grid.position[range.clone()].iter().zip(&grid.index[range]) {
            let mut distance_squared = 0.0;
            for axis in 0..D {
                let difference = centre[axis] - position[axis];
                distance_squared += difference * difference;
            }
            // branch-free: the slot is written always and kept only for a neighbour
            buffer[found.min(LARGEST_ROW - 1)] = index;
            found += usize::from(distance_squared < limit && index as usize != particle);
        }
    });
    found
}

/// Writes indices as padded chunks as far as they fit and returns how many chunks are needed.
#[inline(always)]
fn store(found: &[u32], sentinel: u32, chunks: &mut [[u32; LANES]]) -> usize {
    for (chunk, indices) in chunks.iter_mut().zip(found.chunks(LANES)) {
        *chunk = [sentinel; LANES];
        chunk[..indices.len()].copy_from_slice(indices);
    }
    found.len().div_ceil(LANES)
}
