//! A uniform grid of cells no smaller than the search radius, with the particles sorted by cell.

use crate::cell_order::CellOrder;
use crate::lanes::LANES;
use crate::parallel::prelude::*;
use crate::vector::Vector;
use std::ops::Range;

/// Cells in x-fastest order; the entries of one cell, and of neighbouring cells along x, are contiguous.
#[derive(Debug)]
pub(crate) struct CellGrid<const D: usize> {
    origin: Vector<D>,
    inverse_size: f64,
    cells: [usize; D],
    /// Whether cells at a border hold particles beyond it.
    pub(crate) is_cut: bool,
    order: CellOrder,
    /// Particle index of each entry, and of [`LANES`] more that mean nothing.
    pub(crate) index: Vec<u32>,
    /// Coordinates of the entries along each axis as integers that wrap, in units of a cell over [`UNITS`], and of [`LANES`]
    /// more that mean nothing.
    pub(crate) coordinates: [Vec<f32>; D],
}

/// More cells than this a particle are wasted on empty space: far particles share the border cells instead.
const CELLS_PER_PARTICLE: usize = 8;
/// Units of a coordinate in a cell: cells that touch are far from wrapping, and a unit is an eighth of what f32 leaves of a
/// square of a cell.
const UNITS: f64 = (1_u64 << 27) as f64;

/// Particles a task of the parallel loops.
const TASK: usize = 4096;

impl<const D: usize> CellGrid<D> {
    pub(crate) fn new() -> Self {
        Self {
            origin: Vector::zeros(),
            inverse_size: 1.0,
            cells: [1; D],
            is_cut: false,
            order: CellOrder::default(),
            index: Vec::new(),
            coordinates: std::array::from_fn(|_| Vec::new()),
        }
    }

    /// Lays the grid over the given positions with cells of `size` `[m]`.
    pub(crate) fn cover(&mut self, positions: &[Vector<D>], size: f64) {
        let none = (Vector::<D>::repeat(f64::INFINITY), Vector::<D>::repeat(f64::NEG_INFINITY));
        let joined = |a: (Vector<D>, Vector<D>), b: (Vector<D>, Vector<D>)| {
            (a.0.zip_map(&b.0, f64::min), a.1.zip_map(&b.1, f64::max))
        };
        let (mut lower, mut upper) = positions
            .par_chunks(TASK)
            .map(|positions| positions.iter().fold(none, |all, x| joined(all, (*x, *x))))
            .reduce(|| none, joined);
        if positions.is_empty() {
            (lower, upper) = (Vector::zeros(), Vector::zeros());
        }
        self.origin = lower;
        self.inverse_size = 1.0 / size;
        let limit = CELLS_PER_PARTICLE * positions.len() + 1024;
        let mut total = 1usize;
        self.is_cut = false;
        for axis in 0..D {
            let wanted = ((upper[axis] - lower[axis]) * self.inverse_size).floor() as usize + 1;
            self.cells[axis] = wanted.clamp(1, limit);
            self.is_cut |= self.cells[axis] < wanted;
            total = total.saturating_mul(self.cells[axis]);
        }
        // a stray particle far away must not buy a huge grid
        while total > limit {
            self.is_cut = true;
            let longest = (0..D).max_by_key(|&axis| self.cells[axis]).unwrap_or(0);
            total /= self.cells[longest];
            self.cells[longest] = self.cells[longest].div_ceil(2);
            total *= self.cells[longest];
        }
    }

    #[inline(always)]
    fn coordinate(&self, position: &Vector<D>, axis: usize) -> usize {
        let cell = (position[axis] - self.origin[axis]) * self.inverse_size;
        // truncated and clamped, which keeps neighbours in neighbouring cells; a NaN goes to cell 0
        (cell.max(0.0) as usize).min(self.cells[axis] - 1)
    }

    /// Index of the cell that holds a position.
    #[inline(always)]
    fn cell(&self, position: &Vector<D>) -> usize {
        let mut cell = 0;
        for axis in (0..D).rev() {
            cell = cell * self.cells[axis] + self.coordinate(position, axis);
        }
        cell
    }

    /// A coordinate as an integer that wraps.
    #[inline(always)]
    pub(crate) fn fixed(&self, position: &Vector<D>, axis: usize) -> f32 {
        f32::from_bits((position[axis] * (self.inverse_size * UNITS)) as i64 as u32)
    }

    /// Square of a radius of one cell in units of coordinates, with room for rounding: what is within the radius is found, and
    /// of what is farther only the next millionth.
    pub(crate) fn limit() -> f64 {
        (UNITS * (1.0 + 4.0 * f64::from(f32::EPSILON))).powi(2)
    }

    /// Sorts a number of entries by cell; `member` returns the particle of an entry.
    pub(crate) fn sort(&mut self, positions: &[Vector<D>], entries: usize, member: impl Fn(usize) -> usize + Sync) {
        // taken out while the cells of particles are asked for
        let (mut order, mut index) = (std::mem::take(&mut self.order), std::mem::take(&mut self.index));
        index.resize(entries + LANES, 0);
        index[entries..].fill(0);
        let sorted = &mut index[..entries];
        order.sort(self.cells.iter().product(), |entry| self.cell(&positions[member(entry)]), sorted);
        sorted.par_iter_mut().with_min_len(TASK).for_each(|entry| *entry = member(*entry as usize) as u32);
        (self.order, self.index) = (order, index);
    }

    /// Takes the coordinates of the sorted entries.
    pub(crate) fn take_coordinates(&mut self, positions: &[Vector<D>]) {
        let mut coordinates = std::mem::replace(&mut self.coordinates, std::array::from_fn(|_| Vec::new()));
        for (axis, coordinates) in coordinates.iter_mut().enumerate() {
            coordinates.resize(self.index.len(), 0.0);
            let entries = (&mut coordinates[..], &self.index[..]).with_min_len(TASK);
            entries.for_each(|(place, &index)| *place = self.fixed(&positions[index as usize], axis));
        }
        self.coordinates = coordinates;
    }

    /// The ranges of entries in the cells around `position`, and how many there are.
    #[inline(always)]
    pub(crate) fn ranges(&self, position: &Vector<D>) -> ([Range<usize>; 9], usize) {
        let mut ranges = [const { 0..0 }; 9];
        let mut low = [0; D];
        let mut high = [0; D];
        for axis in 0..D {
            let centre = self.coordinate(position, axis);
            low[axis] = centre.saturating_sub(1);
            high[axis] = (centre + 1).min(self.cells[axis] - 1);
        }
        let planes = if D == 3 { low[2]..high[2] + 1 } else { 0..1 };
        let mut count = 0;
        for plane in planes {
            for row in low[1]..high[1] + 1 {
                let line = (plane * self.cells[1] + row) * self.cells[0];
                ranges[count] = self.order.places(line + low[0], line + high[0]);
                count += 1;
            }
        }
        (ranges, count)
    }
}
