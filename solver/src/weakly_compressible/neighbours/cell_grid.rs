//! A uniform grid of cells no smaller than the search radius, with the particles sorted by cell.

use crate::cell_order::CellOrder;
use crate::lanes::LANES;
use crate::vector::Vector;
use std::ops::Range;

/// Cells in x-fastest order; the entries of one cell, and of neighbouring cells along x, are contiguous.
#[derive(Debug)]
pub(crate) struct CellGrid<const D: usize> {
    origin: Vector<D>,
    inverse_size: f64,
    cells: [usize; D],
    order: CellOrder,
    /// Particle index of each entry, and of [`LANES`] more that mean nothing.
    pub(crate) index: Vec<u32>,
    /// Coordinates of the entries along each axis `[m]`, and of [`LANES`] more that mean nothing.
    pub(crate) coordinates: [Vec<f64>; D],
}

/// More cells than this a particle are wasted on empty space: far particles share the border cells instead.
const CELLS_PER_PARTICLE: usize = 8;

impl<const D: usize> CellGrid<D> {
    pub(crate) fn new() -> Self {
        Self {
            origin: Vector::zeros(),
            inverse_size: 1.0,
            cells: [1; D],
            order: CellOrder::default(),
            index: Vec::new(),
            coordinates: std::array::from_fn(|_| Vec::new()),
        }
    }

    /// Lays the grid over the given positions with cells of `size` `[m]`.
    pub(crate) fn cover<'a>(&mut self, positions: impl Iterator<Item = &'a Vector<D>>, size: f64) {
        let mut lower = Vector::<D>::repeat(f64::INFINITY);
        let mut upper = Vector::<D>::repeat(f64::NEG_INFINITY);
        let mut count = 0usize;
        for position in positions {
            for axis in 0..D {
                lower[axis] = lower[axis].min(position[axis]);
                upper[axis] = upper[axis].max(position[axis]);
            }
            count += 1;
        }
        if count == 0 {
            (lower, upper) = (Vector::zeros(), Vector::zeros());
        }
        self.origin = lower;
        self.inverse_size = 1.0 / size;
        let limit = CELLS_PER_PARTICLE * count + 1024;
        let mut total = 1usize;
        for axis in 0..D {
            let wanted = ((upper[axis] - lower[axis]) * self.inverse_size).floor() as usize + 1;
            self.cells[axis] = wanted.clamp(1, limit);
            total = total.saturating_mul(self.cells[axis]);
        }
        // a stray particle far away must not buy a huge grid
        while total > limit {
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

    /// Sorts `entries` (index, position) by cell.
    pub(crate) fn sort<'a>(&mut self, mut entries: impl Iterator<Item = (u32, &'a Vector<D>)> + Clone) {
        // taken out while the cells of particles are asked for
        let mut order = std::mem::take(&mut self.order);
        let cells = entries.clone().map(|(_, position)| self.cell(position));
        let count = order.count(self.cells.iter().product(), cells);
        self.index.resize(count + LANES, 0);
        for coordinates in &mut self.coordinates {
            coordinates.resize(count + LANES, 0.0);
        }
        order.place(|_, place| {
            let Some((index, position)) = entries.next() else { return };
            self.index[place] = index;
            for axis in 0..D {
                self.coordinates[axis][place] = position[axis];
            }
        });
        self.order = order;
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
