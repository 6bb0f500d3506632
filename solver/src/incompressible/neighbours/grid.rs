//! Cells for the search of candidate pairs, with periods that are wrapped instead of copied.

use crate::cell_order::CellOrder;
use crate::domain::{AxisBoundary, Domain};
use crate::vector::Vector;

/// Particles sorted by cell.
#[derive(Debug)]
pub(crate) struct Grid<const D: usize> {
    lower: Vector<D>,
    inverse_size: Vector<D>,
    cells: [usize; D],
    periodic: [bool; D],
    order: CellOrder,
    index: Vec<u32>,
}

/// Most cells along an axis: a stray particle far away must not buy a huge grid.
const MOST_CELLS: usize = 4096;

impl<const D: usize> Grid<D> {
    pub(crate) fn new() -> Self {
        Self {
            lower: Vector::zeros(),
            inverse_size: Vector::zeros(),
            cells: [1; D],
            periodic: [false; D],
            order: CellOrder::default(),
            index: Vec::new(),
        }
    }

    /// Sorts the particles into cells of at least `size` `[m]`.
    pub(crate) fn sort(&mut self, positions: &[Vector<D>], domain: &Domain<D>, size: f64) {
        for axis in 0..D {
            let (lower, upper) = match domain.axes[axis] {
                AxisBoundary::Periodic { lower, upper } => (lower, upper),
                AxisBoundary::Open | AxisBoundary::Mirror { .. } => positions
                    .iter()
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x[axis]), high.max(x[axis]))),
            };
            self.periodic[axis] = matches!(domain.axes[axis], AxisBoundary::Periodic { .. });
            let length = (upper - lower).max(size);
            self.cells[axis] = ((length / size).floor() as usize).clamp(1, MOST_CELLS);
            self.lower[axis] = lower;
            self.inverse_size[axis] = self.cells[axis] as f64 / length;
        }
        // taken out while the cells of particles are asked for
        let mut order = std::mem::take(&mut self.order);
        let mut index = std::mem::take(&mut self.index);
        index.resize(positions.len(), 0);
        let cell_of = |particle: usize| self.cell(&self.coordinates(&positions[particle]));
        order.sort(self.cells.iter().product(), cell_of, &mut index);
        (self.order, self.index) = (order, index);
    }

    /// Calls `visit` for every particle in the cells around a position, each once.
    pub(crate) fn visit_near(&self, position: &Vector<D>, mut visit: impl FnMut(u32)) {
        let centre = self.coordinates(position);
        'offsets: for code in 0..3usize.pow(D as u32) {
            let mut rest = code;
            let mut cell = [0; D];
            for axis in 0..D {
                let offset = rest % 3;
                rest /= 3;
                let cells = self.cells[axis];
                // with one or two cells along a period, both sides lead to the same one
                if self.periodic[axis] {
                    if offset >= cells {
                        continue 'offsets;
                    }
                    cell[axis] = (centre[axis] + offset + cells - 1) % cells;
                } else {
                    let shifted = centre[axis] + offset;
                    if shifted == 0 || shifted > cells {
                        continue 'offsets;
                    }
                    cell[axis] = shifted - 1;
                }
            }
            let cell = self.cell(&cell);
            for &index in &self.index[self.order.places(cell, cell)] {
                visit(index);
            }
        }
    }

    fn coordinates(&self, position: &Vector<D>) -> [usize; D] {
        std::array::from_fn(|axis| {
            // truncated and clamped, which keeps neighbours in neighbouring cells; a NaN goes to cell 0
            let cell = (position[axis] - self.lower[axis]) * self.inverse_size[axis];
            (cell.max(0.0) as usize).min(self.cells[axis] - 1)
        })
    }

    fn cell(&self, coordinates: &[usize; D]) -> usize {
        coordinates.iter().zip(&self.cells).rev().fold(0, |cell, (&coordinate, &cells)| cell * cells + coordinate)
    }
}
