//! A uniform grid over facets: finds those that can be nearer to a place than a range, without a look at the others.

use super::facet::Facet;
use crate::vector::Vector;

/// Cells that a grid has for every facet at most, and cells in all: memory.
const CELLS_PER_FACET: usize = 8;
const MOST_CELLS: f64 = 262_144.0;

/// Lists of facets, cell by cell.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetGrid<const D: usize> {
    /// Distance up to which the facets around a place are found `[m]`.
    range: f64,
    lower: Vector<D>,
    /// Edge of a cell `[m]`.
    edge: f64,
    counts: [usize; D],
    /// Start of each cell's list; one more than there are cells.
    starts: Vec<u32>,
    facets: Vec<u32>,
}

impl<const D: usize> FacetGrid<D> {
    /// The grid by which facets nearer than `range` `[m]` are found.
    #[must_use]
    pub fn new(facets: &[Facet<D>], range: f64) -> Self {
        let none = (Vector::<D>::repeat(f64::INFINITY), Vector::<D>::repeat(f64::NEG_INFINITY));
        let boxes: Vec<_> = facets.iter().map(|facet| around(facet, range)).collect();
        let (lower, upper) = boxes.iter().fold(none, |(l, u), (low, high)| (l.inf(low), u.sup(high)));
        let mut grid = Self { range, lower, edge: range, counts: [0; D], starts: vec![0], facets: Vec::new() };
        let size = upper - lower;
        if facets.is_empty() || !size.iter().all(|length| length.is_finite()) || range <= 0.0 {
            return grid;
        }
        let most = MOST_CELLS.min((CELLS_PER_FACET * (facets.len() + CELLS_PER_FACET)) as f64);
        let cells = |edge: f64| size.iter().map(|length| (length / edge).floor() + 1.0).product::<f64>();
        while cells(grid.edge) > most {
            grid.edge *= 1.25;
        }
        grid.counts = std::array::from_fn(|axis| (size[axis] / grid.edge) as usize + 1);
        grid.fill(facets, &boxes);
        grid
    }

    /// Counts what each cell lists, and lists it in the order of the facets.
    fn fill(&mut self, facets: &[Facet<D>], boxes: &[(Vector<D>, Vector<D>)]) {
        let cells = self.counts.iter().product();
        let mut ends = vec![0_u32; cells + 1];
        for (facet, corners) in facets.iter().zip(boxes) {
            self.visit(facet, &facet.edges(), self.block(corners), &mut |cell| ends[cell + 1] += 1);
        }
        for cell in 0..cells {
            ends[cell + 1] += ends[cell];
        }
        self.facets = vec![0; ends[cells] as usize];
        self.starts.clone_from(&ends);
        let mut entries = std::mem::take(&mut self.facets);
        for (index, (facet, corners)) in facets.iter().zip(boxes).enumerate() {
            self.visit(facet, &facet.edges(), self.block(corners), &mut |cell| {
                entries[ends[cell] as usize] = index as u32;
                ends[cell] += 1;
            });
        }
        self.facets = entries;
    }

    /// The first and the last cell of a box.
    fn block(&self, (lower, upper): &(Vector<D>, Vector<D>)) -> [[usize; D]; 2] {
        [lower, upper].map(|place| {
            std::array::from_fn(|axis| {
                (((place[axis] - self.lower[axis]) / self.edge).max(0.0) as usize).min(self.counts[axis] - 1)
            })
        })
    }

    /// Shows the cells of a block that a facet can be near to, halving the block: of the cells in the box of a long thin facet, few
    /// are near it.
    fn visit(
        &self,
        facet: &Facet<D>,
        edges: &[(Vector<D>, f64); D],
        [first, last]: [[usize; D]; 2],
        show: &mut impl FnMut(usize),
    ) {
        let size = Vector::<D>::from_fn(|axis, _| (last[axis] - first[axis] + 1) as f64 * self.edge);
        let middle = Vector::<D>::from_fn(|axis, _| self.lower[axis] + first[axis] as f64 * self.edge) + size * 0.5;
        // the corners of a block are half its diagonal from its middle; a little more for rounding
        let reach = self.range + 0.51 * size.norm();
        if facet.height(&middle).abs() > reach || edges.iter().any(|(out, at)| out.dot(&middle) - at > reach) {
            return;
        }
        if first == last {
            return show(self.index(&first));
        }
        let axis = size.imax();
        let (mut end, mut start) = (last, first);
        end[axis] = usize::midpoint(first[axis], last[axis]);
        start[axis] = end[axis] + 1;
        self.visit(facet, edges, [first, end], show);
        self.visit(facet, edges, [start, last], show);
    }

    fn index(&self, cell: &[usize; D]) -> usize {
        (0..D).rev().fold(0, |index, axis| index * self.counts[axis] + cell[axis])
    }

    /// The facets that can be nearer to a place than the range, in their order; some that are farther may be among them.
    #[inline(always)]
    #[must_use]
    pub fn near(&self, place: &Vector<D>) -> &[u32] {
        let mut cell = [0; D];
        for axis in 0..D {
            let offset = (place[axis] - self.lower[axis]) / self.edge;
            if !(offset >= 0.0 && offset < self.counts[axis] as f64) {
                return &[];
            }
            cell[axis] = offset as usize;
        }
        let index = self.index(&cell);
        &self.facets[self.starts[index] as usize..self.starts[index + 1] as usize]
    }

    /// Lower and upper corners of the cells that list any facet `[m]`, in their order. They do not overlap.
    pub(super) fn occupied(&self) -> impl Iterator<Item = (Vector<D>, Vector<D>)> {
        let occupied = (0..self.starts.len() - 1).filter(|&index| self.starts[index] < self.starts[index + 1]);
        occupied.map(|index| {
            let mut rest = index;
            let cell: [usize; D] = std::array::from_fn(|axis| {
                let at = rest % self.counts[axis];
                rest /= self.counts[axis];
                at
            });
            let corner = |beyond: usize| {
                Vector::<D>::from_fn(|axis, _| self.lower[axis] + (cell[axis] + beyond) as f64 * self.edge)
            };
            (corner(0), corner(1))
        })
    }
}

/// Corners of a facet's box, `range` farther out `[m]`.
fn around<const D: usize>(facet: &Facet<D>, range: f64) -> (Vector<D>, Vector<D>) {
    let none = (Vector::<D>::repeat(f64::INFINITY), Vector::<D>::repeat(f64::NEG_INFINITY));
    let (lower, upper) = facet.corners.iter().fold(none, |(l, u), corner| (l.inf(corner), u.sup(corner)));
    (lower.map(|place| place - range), upper.map(|place| place + range))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    fn agrees<const D: usize>(facets: &[Facet<D>], range: f64, seed: u64) {
        let grid = FacetGrid::new(facets, range);
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
        let (mut found, mut can_be, mut in_lists) = (0, 0, 0);
        for _ in 0..500 {
            let place = Vector::<D>::from_fn(|_, _| 2.0 * random.random::<f64>() - 0.5);
            let near = (0..facets.len()).filter(|&facet| (facets[facet].nearest(&place) - place).norm() < range);
            let listed = grid.near(&place);
            let reach = range + grid.edge * (D as f64).sqrt();
            can_be += facets.iter().filter(|facet| (facet.nearest(&place) - place).norm() < reach).count();
            in_lists += listed.len();
            assert!(listed.is_sorted() && near.clone().all(|facet| listed.contains(&(facet as u32))), "{place}");
            found += near.count();
        }
        assert!(found > 12 && in_lists < can_be, "{found}, {in_lists} in lists, {can_be} can be near");
    }

    #[test]
    fn it_finds_what_a_look_at_all_facets_finds() {
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(3);
        for size in [0.05, 0.3, 2.0] {
            let mut corner = |middle: f64| middle + size * (random.random::<f64>() - 0.5);
            let segments: Vec<_> = (0..40)
                .filter_map(|k| {
                    let (x, y) = (f64::from(k % 7) / 7.0, f64::from(k) / 40.0);
                    Facet::segment([corner(x), corner(y)].into(), [corner(x), corner(y)].into())
                })
                .collect();
            let triangles: Vec<_> = (0..200)
                .filter_map(|k| {
                    let at = [f64::from(k % 7) / 7.0, f64::from(k % 11) / 11.0, f64::from(k) / 200.0];
                    Facet::triangle([(); 3].map(|()| Vector::<3>::from(at.map(&mut corner))))
                })
                .collect();
            agrees(&segments, 0.1, 1);
            agrees(&triangles, 0.07, 2);
        }
        // a fan of slivers around one corner
        let at = |k: u32| f64::from(k) * std::f64::consts::TAU / 300.0;
        let rim = |k| Vector::<3>::new(libm::cos(at(k)), libm::sin(at(k)), 0.2);
        let fan = (0..300).filter_map(|k| Facet::triangle([Vector::zeros(), rim(k), rim(k + 1)]));
        agrees(&fan.collect::<Vec<_>>(), 0.05, 3);
        let none = FacetGrid::<2>::new(&[], 0.1);
        assert!(none.near(&Vector::zeros()).is_empty() && none.occupied().next().is_none());
    }
}
