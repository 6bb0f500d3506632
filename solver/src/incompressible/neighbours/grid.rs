//! Cells for the search of candidate pairs, with periods that are wrapped instead of copied.

use crate::cell_order::CellOrder;
use crate::domain::{AxisBoundary, Domain};
use crate::vector::Vector;

/// Particles sorted by cell.
#[derive(Debug)]
pub struct Grid<const D: usize> {
    lower: Vector<D>,
    inverse_size: Vector<D>,
    cells: [usize; D],
    periodic: [bool; D],
    order: CellOrder,
    pub(super) index: Vec<u32>,
}

/// Most cells along an axis: a stray particle far away must not buy a huge grid.
const MOST_CELLS: usize = 4096;

/// Most stretches around a position: two for each of nine rows of cells in space.
pub(crate) const MOST_STRETCHES: usize = 18;

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
    pub fn sort(&mut self, positions: &[Vector<D>], domain: &Domain<D>, size: f64) {
        for axis in 0..D {
            let (lower, upper) = domain.extent(axis, positions.iter().map(|x| x[axis]));
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

    /// The stretches of that order that lie in the cells around a position, from a place to the next one behind, and how many
    /// there are; together they hold every particle there once.
    #[inline(always)]
    pub(crate) fn stretches(&self, position: &Vector<D>) -> ([(usize, usize); MOST_STRETCHES], usize) {
        let centre = self.coordinates(position);
        let (along, cells_along) = (centre[0], self.cells[0]);
        let mut stretches = [(0, 0); MOST_STRETCHES];
        let mut number = 0;
        'offsets: for code in 0..3usize.pow(D as u32 - 1) {
            let mut rest = code;
            let mut cell = [0; D];
            for axis in 1..D {
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
            // cells along the first axis follow each other
            let first = self.cell(&cell);
            let around_period = self.periodic[0] && cells_along <= 3;
            let (low, high) = if around_period {
                (0, cells_along - 1)
            } else {
                (along.saturating_sub(1), (along + 1).min(cells_along - 1))
            };
            stretches[number] = self.places(first + low, first + high);
            number += 1;
            if self.periodic[0] && !around_period && (along == 0 || along + 1 == cells_along) {
                let across = first + if along == 0 { cells_along - 1 } else { 0 };
                stretches[number] = self.places(across, across);
                number += 1;
            }
        }
        (stretches, number)
    }

    /// Calls `visit` for every particle in the cells around a position, each once.
    pub(crate) fn visit_near(&self, position: &Vector<D>, mut visit: impl FnMut(u32)) {
        let (stretches, number) = self.stretches(position);
        for &(start, end) in &stretches[..number] {
            self.index[start..end].iter().for_each(|&index| visit(index));
        }
    }

    #[inline(always)]
    fn places(&self, first: usize, last: usize) -> (usize, usize) {
        let places = self.order.places(first, last);
        (places.start, places.end)
    }

    #[inline(always)]
    fn coordinates(&self, position: &Vector<D>) -> [usize; D] {
        std::array::from_fn(|axis| {
            // truncated and clamped, which keeps neighbours in neighbouring cells; a NaN goes to cell 0
            let cell = (position[axis] - self.lower[axis]) * self.inverse_size[axis];
            (cell.max(0.0) as usize).min(self.cells[axis] - 1)
        })
    }

    #[inline(always)]
    fn cell(&self, coordinates: &[usize; D]) -> usize {
        coordinates.iter().zip(&self.cells).rev().fold(0, |cell, (&coordinate, &cells)| cell * cells + coordinate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid whose particles share a cell misses no pair either, but a search in it tries them all.
    #[test]
    fn cells_around_a_place_hold_near_particles_only() {
        let place = |k: usize| Vector::<2>::new((k % 24) as f64 * 0.5 - 0.9, (k / 24) as f64 * 0.5 + 3.0);
        let positions: Vec<_> = (0..24 * 20).map(place).collect();
        let axes = [AxisBoundary::Periodic { lower: -1.0, upper: 11.0 }, AxisBoundary::Open];
        let mut grid = Grid::new();
        grid.sort(&positions, &Domain { axes }, 1.0);
        for target in &positions {
            grid.visit_near(target, |source| {
                let way = positions[source as usize] - target;
                let along = way[0].abs().min(12.0 - way[0].abs());
                // two cells of 1 and of 9.5/9
                assert!(along < 2.0 && way[1].abs() < 2.2, "{way:?} apart");
            });
        }
    }
}
