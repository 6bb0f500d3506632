//! Particles in the order of their cells: the counting sort under the neighbour searches of both models.

use std::ops::Range;

/// Where the entries of each cell stand in the order. The sort is stable, so the order is a function of the input alone.
#[derive(Debug, Default)]
pub(crate) struct CellOrder {
    start: Vec<u32>,
    cell_of: Vec<u32>,
}

impl CellOrder {
    /// Takes the cell of every entry, of `cells` in all; returns how many entries there are.
    #[inline(always)]
    pub(crate) fn count(&mut self, cells: usize, cell_of: impl Iterator<Item = usize>) -> usize {
        self.start.clear();
        if self.start.capacity() <= cells {
            // room for more: an open axis grows with every splash
            self.start.reserve(2 * (cells + 1));
        }
        self.start.resize(cells + 1, 0);
        self.cell_of.clear();
        for cell in cell_of {
            self.cell_of.push(cell as u32);
            self.start[cell + 1] += 1;
        }
        for cell in 0..cells {
            self.start[cell + 1] += self.start[cell];
        }
        self.cell_of.len()
    }

    /// Shows the place of every entry in the order, as (entry, place).
    #[inline(always)]
    pub(crate) fn place(&mut self, mut show: impl FnMut(usize, usize)) {
        for (entry, &cell) in self.cell_of.iter().enumerate() {
            let next = &mut self.start[cell as usize];
            show(entry, *next as usize);
            *next += 1;
        }
        // every start has moved to its cell's end, which is the next cell's start
        let cells = self.start.len() - 1;
        self.start.copy_within(0..cells, 1);
        self.start[0] = 0;
    }

    /// The places of the entries from one cell to another, both included.
    #[inline(always)]
    pub(crate) fn places(&self, first: usize, last: usize) -> Range<usize> {
        self.start[first] as usize..self.start[last + 1] as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_of_a_cell_stand_together_in_their_order() {
        let cells = [2, 0, 2, 3, 0, 2];
        let mut order = CellOrder::default();
        let mut sorted = vec![0; order.count(5, cells.iter().copied())];
        order.place(|entry, place| sorted[place] = entry);
        assert_eq!(sorted, [1, 4, 0, 2, 5, 3]);
        let of_cell = |cell: usize| &sorted[order.places(cell, cell)];
        assert_eq!((of_cell(0), of_cell(1), of_cell(2)), (&[1, 4][..], &[][..], &[0, 2, 5][..]));
        assert_eq!(order.places(0, 4), 0..6);
        // a second sort leaves nothing of the first
        assert_eq!(order.count(1, std::iter::empty()), 0);
        order.place(|_, _| panic!("there are none"));
        assert_eq!(order.places(0, 0), 0..0);
    }
}
