//! Particles in the order of their cells: the counting sort under the neighbour searches of both models.
//!
//! Threads share the sort by cells: each part of the cells counts and places its own entries, in their order, and skips blocks of
//! entries that have none. The order is a function of the input alone.

use crate::parallel::prelude::*;
use std::ops::Range;

/// Entries of a block, of which the lowest and highest cells are kept.
const BLOCK: usize = 1024;
/// Parts of the cells that threads share.
const PARTS: usize = 64;

/// Ranges of the entries of each cell in the sorted order. The sort is stable.
#[derive(Debug, Default)]
pub(crate) struct CellOrder {
    start: Vec<u32>,
    cell_of: Vec<u32>,
    /// Lowest and highest cell of every block of entries.
    reach: Vec<(u32, u32)>,
}

impl CellOrder {
    /// Sorts a number of entries by their cells, of which there are `cells`: writes into `sorted[place]` which entry it is. What `sorted` has
    /// beyond the entries stays.
    #[inline(always)]
    pub(crate) fn sort(&mut self, cells: usize, cell_of: impl Fn(usize) -> usize + Sync, sorted: &mut [u32]) {
        let Self { start, cell_of: cached, reach } = self;
        let entries = sorted.len();
        cached.resize(entries, 0);
        reach.resize(entries.div_ceil(BLOCK), (0, 0));
        (cached.par_chunks_mut(BLOCK), &mut *reach).enumerate().with_min_len(4).for_each(|(block, (cached, reach))| {
            *reach = (u32::MAX, 0);
            for (offset, cached) in cached.iter_mut().enumerate() {
                *cached = cell_of(block * BLOCK + offset) as u32;
                *reach = (reach.0.min(*cached), reach.1.max(*cached));
            }
        });
        start.clear();
        if start.capacity() <= cells {
            // room for more: an open axis grows with every splash
            start.reserve(2 * (cells + 1));
        }
        start.resize(cells + 1, 0);
        let part = cells.div_ceil(PARTS).max(1);
        let of_part = Entries { cell_of: cached, reach };
        start[1..].par_chunks_mut(part).enumerate().for_each(|(index, counts)| {
            let first = index * part;
            of_part.visit(first, counts.len(), |_, cell| counts[cell] += 1);
        });
        for cell in 0..cells {
            start[cell + 1] += start[cell];
        }
        place(of_part, 0, part, &mut start[..cells], sorted);
        // every start has moved to its cell's end, which is the next cell's start
        start.copy_within(0..cells, 1);
        start[0] = 0;
    }

    /// The places of the entries from one cell to another, both included.
    #[inline(always)]
    pub(crate) fn places(&self, first: usize, last: usize) -> Range<usize> {
        self.start[first] as usize..self.start[last + 1] as usize
    }
}

/// Places the entries of the cells from `first` on, whose places begin at `start` and end with `sorted`.
fn place(entries: Entries<'_>, first: usize, part: usize, start: &mut [u32], sorted: &mut [u32]) {
    if start.is_empty() || sorted.is_empty() {
        // no entry here: what starts here ends here
        return;
    }
    let origin = start[0];
    if start.len() > part {
        let middle = (start.len() / part).div_ceil(2) * part;
        let (start, later_start) = start.split_at_mut(middle);
        let (sorted, later_sorted) = sorted.split_at_mut((later_start[0] - origin) as usize);
        rayon::join(
            || place(entries, first, part, start, sorted),
            || place(entries, first + middle, part, later_start, later_sorted),
        );
        return;
    }
    let cells = start.len();
    entries.visit(first, cells, |entry, cell| {
        let next = &mut start[cell];
        sorted[(*next - origin) as usize] = entry as u32;
        *next += 1;
    });
}

/// The cells of all entries.
#[derive(Clone, Copy)]
struct Entries<'a> {
    cell_of: &'a [u32],
    reach: &'a [(u32, u32)],
}

impl Entries<'_> {
    /// Shows the entries of some cells in their order, as (entry, cell from the first on).
    #[inline(always)]
    fn visit(&self, first: usize, cells: usize, mut show: impl FnMut(usize, usize)) {
        for (block, (cell_of, reach)) in self.cell_of.chunks(BLOCK).zip(self.reach).enumerate() {
            if (reach.1 as usize) < first || reach.0 as usize >= first + cells {
                continue;
            }
            for (offset, &cell) in cell_of.iter().enumerate() {
                let cell = (cell as usize).wrapping_sub(first);
                if cell < cells {
                    show(block * BLOCK + offset, cell);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_of_a_cell_stand_together_in_their_order() {
        let cells = [2, 0, 2, 3, 0, 2];
        let mut order = CellOrder::default();
        let mut sorted = [0; 6];
        order.sort(5, |entry| cells[entry], &mut sorted);
        assert_eq!(sorted, [1, 4, 0, 2, 5, 3]);
        let of_cell = |cell: usize| &sorted[order.places(cell, cell)];
        assert_eq!((of_cell(0), of_cell(1), of_cell(2)), (&[1, 4][..], &[][..], &[0, 2, 5][..]));
        assert_eq!(order.places(0, 4), 0..6);
        // a second sort leaves nothing of the first
        order.sort(1, |_| unreachable!("there are none"), &mut []);
        assert_eq!(order.places(0, 0), 0..0);
    }

    #[test]
    fn any_number_of_threads_sorts_as_the_library_does() {
        for (entries, cells) in [(1, 1), (5000, 3), (5000, 64), (20_000, 1000), (20_000, 65), (300, 40_000)] {
            let cell_of = |entry: usize| (entry * 7919 + entry * entry % 13) % cells;
            let mut expected: Vec<u32> = (0..entries as u32).collect();
            expected.sort_by_key(|&entry| cell_of(entry as usize));
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
                let mut order = CellOrder::default();
                let mut sorted = vec![0; entries];
                pool.install(|| order.sort(cells, cell_of, &mut sorted));
                assert_eq!(sorted, expected, "{entries} entries in {cells} cells, {threads} threads");
                for cell in (0..cells).step_by(1 + cells / 7) {
                    let places = order.places(cell, cell);
                    assert!(sorted[places].iter().all(|&entry| cell_of(entry as usize) == cell));
                }
            }
        }
    }
}
