//! Nested lattices of multilinear functions under the diagonal, each with its diagonal alone (Bramble, Pasciak & Xu 1990):
//! z = D⁻¹ r + Σ_l Φ_l D_l⁻¹ Φ_lᵀ r.
//!
//! The operator is one of particles that acts like Σ_a κ_a |∇p|² + h_a p², with a stiffness κ and what holds p at a row, h.
//! The finest lattice is a few spacings wide, and each of the next is twice as wide, down to a few cells, so that what is
//! smooth over the whole domain needs no more iterations than what is rough. A diagonal is Σ_a κ_a |∇φ|² + h_a φ² with the
//! means of |∇φ|² and φ² over a cell. Sums run by cell, node and particle in a fixed order, on any number of threads. The
//! lattices are made anew from the present positions before a solve and remember nothing.

mod transfer;

#[cfg(test)]
mod tests;

use super::conjugate_gradient::Preconditioner;
use crate::cell_order::CellOrder;
use crate::domain::{AxisBoundary, Domain};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use transfer::{for_each_cell_around, from_coarser, from_finer, join, share, split};

/// Cell of the finest lattice over the spacing of the particles `[-]`.
const WIDTH: f64 = 2.5;
/// Cells along a period of the coarsest lattice, at least.
const LEAST_CELLS: f64 = 3.0;
/// Most cells along an axis without a period: a stray particle far away must not buy memory.
const MOST_CELLS: usize = 4096;
/// Corners of a cell in space.
const CORNERS: usize = 8;
/// Cells, nodes or particles of a task at least.
const LEAST_TASK: usize = 128;

/// One lattice; cells and nodes follow each other along the first axis first.
#[derive(Debug, Clone)]
struct Level<const D: usize> {
    cells: [usize; D],
    nodes: [usize; D],
    /// Cells of the finer lattice in one of this, along each axis: two, or one where that has no more to halve.
    ratio: [usize; D],
    /// Σ κ and Σ h of every cell.
    sums: Vec<(f64, f64)>,
    /// One over the diagonal of every node, 0 where there are no particles.
    inverse: Vec<f64>,
    /// A residual, then its correction.
    value: Vec<f64>,
}

/// The lattices over a set of particles, reused from solve to solve.
#[derive(Debug)]
pub(crate) struct Lattices<const D: usize> {
    levels: Vec<Level<D>>,
    /// Number of lattices in use, the finest first.
    number: usize,
    periodic: [bool; D],
    order: CellOrder,
    /// Particles in the order of their cells.
    particle: Vec<u32>,
    /// Cell of every particle, and its place in it, from 0 to 1 along each axis.
    cell: Vec<u32>,
    place: Vec<[f64; D]>,
    /// Nodes of the finest lattice at the corners of every cell, for given numbers of cells and nodes along the axes.
    node: Vec<[u32; CORNERS]>,
    finest: ([usize; D], [usize; D]),
    /// Contributions of every cell to its corners.
    corner: Vec<[f64; CORNERS]>,
    inverse_diagonal: Vec<f64>,
}

impl<const D: usize> Default for Lattices<D> {
    fn default() -> Self {
        Self {
            levels: Vec::new(),
            number: 0,
            periodic: [false; D],
            order: CellOrder::default(),
            particle: Vec::new(),
            cell: Vec::new(),
            place: Vec::new(),
            node: Vec::new(),
            finest: ([0; D], [0; D]),
            corner: Vec::new(),
            inverse_diagonal: Vec::new(),
        }
    }
}

impl<const D: usize> Lattices<D> {
    /// Lays lattices over particles a spacing `[m]` apart for an operator with the inverse diagonal that is given (0 for a row
    /// that is no unknown), the stiffness κ and the hold h of every row.
    pub(crate) fn lay(
        &mut self,
        positions: &[Vector<D>],
        domain: &Domain<D>,
        spacing: f64,
        inverse_diagonal: impl Iterator<Item = f64>,
        row: impl Fn(usize) -> (f64, f64) + Sync,
    ) {
        self.inverse_diagonal.clear();
        self.inverse_diagonal.extend(inverse_diagonal);
        let (lower, size) = self.size(positions, domain, spacing);
        let finest = &self.levels[0];
        let cells = finest.cells;
        self.cell.resize(positions.len(), 0);
        self.place.resize(positions.len(), [0.0; D]);
        (&mut self.cell, &mut self.place, positions).with_min_len(LEAST_TASK).for_each(|(cell, place, position)| {
            let mut index = 0;
            for axis in (0..D).rev() {
                let along = (position[axis] - lower[axis]) / size[axis];
                // truncated and clamped; a NaN goes to cell 0
                let k = (along.max(0.0) as usize).min(cells[axis] - 1);
                place[axis] = (along - k as f64).clamp(0.0, 1.0);
                index = index * cells[axis] + k;
            }
            *cell = index as u32;
        });
        let number = finest.sums.len();
        self.particle.resize(positions.len(), 0);
        let Self { order, particle, cell, .. } = self;
        order.sort(number, |entry| cell[entry] as usize, particle);
        self.corner.resize(self.levels[0].sums.len(), [0.0; CORNERS]);
        self.find_nodes();
        self.find_diagonals(size, row);
    }

    /// Chooses the cells of all levels; returns the lower end `[m]` and the size of a cell of the finest `[m]`.
    fn size(&mut self, positions: &[Vector<D>], domain: &Domain<D>, spacing: f64) -> ([f64; D], [f64; D]) {
        let (mut lower, mut length) = ([0.0; D], [0.0; D]);
        for axis in 0..D {
            self.periodic[axis] = matches!(domain.axes[axis], AxisBoundary::Periodic { .. });
            let (low, high) = domain.extent(axis, positions.iter().map(|x| x[axis]));
            (lower[axis], length[axis]) = (low, (high - low).max(spacing));
        }
        let width = WIDTH * spacing;
        // as often as the shortest period or, without one, the longest side can be halved
        let periods = (0..D).filter(|&axis| self.periodic[axis]).map(|axis| length[axis]);
        let shortest = periods.fold(f64::INFINITY, f64::min);
        let side = if shortest.is_finite() { shortest } else { length.iter().copied().fold(spacing, f64::max) };
        let (mut factor, mut levels) = (1, 1);
        while side / (width * (2 * factor) as f64) >= LEAST_CELLS && factor < MOST_CELLS {
            factor *= 2;
            levels += 1;
        }
        let (mut cells, mut size, mut halvings) = ([0; D], [width; D], [levels - 1; D]);
        for axis in 0..D {
            let wanted = length[axis] / width;
            if self.periodic[axis] {
                cells[axis] = (wanted / factor as f64).round().max(1.0) as usize * factor;
                size[axis] = length[axis] / cells[axis] as f64;
            } else {
                let least = (wanted.ceil() as usize).clamp(1, MOST_CELLS);
                let factor = least.next_power_of_two().min(factor);
                cells[axis] = least.next_multiple_of(factor);
                halvings[axis] = factor.ilog2() as usize;
                size[axis] = width.max(length[axis] / cells[axis] as f64);
            }
        }
        self.number = levels;
        if self.levels.len() < levels {
            let (sums, inverse, value) = (Vec::new(), Vec::new(), Vec::new());
            let none = Level { cells: [0; D], nodes: [0; D], ratio: [1; D], sums, inverse, value };
            self.levels.resize(levels, none);
        }
        for (number, level) in self.levels[..levels].iter_mut().enumerate() {
            level.ratio = std::array::from_fn(|axis| if (1..=halvings[axis]).contains(&number) { 2 } else { 1 });
            cells = std::array::from_fn(|axis| cells[axis] / level.ratio[axis]);
            level.cells = cells;
            level.nodes = std::array::from_fn(|axis| cells[axis] + usize::from(!self.periodic[axis]));
            let (of_cells, of_nodes) = (cells.iter().product(), level.nodes.iter().product::<usize>());
            if level.sums.capacity() < of_cells {
                // room for more: an open axis grows with every splash
                level.sums.reserve(2 * of_cells);
                level.inverse.reserve(2 * of_nodes);
                level.value.reserve(2 * of_nodes);
            }
            level.sums.resize(of_cells, (0.0, 0.0));
            level.inverse.resize(of_nodes, 0.0);
            level.value.resize(of_nodes, 0.0);
        }
        if self.corner.capacity() < self.levels[0].sums.len() {
            self.corner.reserve(2 * self.levels[0].sums.len());
            self.node.reserve(2 * self.levels[0].sums.len());
        }
        (lower, size)
    }

    /// The nodes at the corners of every cell of the finest lattice: what lies behind a period is its first node. They change only
    /// where the lattice does.
    fn find_nodes(&mut self) {
        let Self { levels, node, finest, .. } = self;
        let Level { cells, nodes, sums, .. } = &levels[0];
        if *finest == (*cells, *nodes) {
            return;
        }
        *finest = (*cells, *nodes);
        node.resize(sums.len(), [0; CORNERS]);
        node.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(cell, node)| {
            let cell = split(cell, *cells);
            for (corner, node) in node.iter_mut().take(1 << D).enumerate() {
                let place = std::array::from_fn(|axis| (cell[axis] + (corner >> axis & 1)) % nodes[axis]);
                *node = join(place, *nodes) as u32;
            }
        });
    }

    /// Diagonals of all levels, from the sums over their cells.
    fn find_diagonals(&mut self, mut size: [f64; D], row: impl Fn(usize) -> (f64, f64) + Sync) {
        let Self { levels, number, periodic, order, particle, .. } = self;
        let levels = &mut levels[..*number];
        levels[0].sums.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(cell, sums)| {
            let rows = particle[order.places(cell, cell)].iter().map(|&a| row(a as usize));
            *sums = rows.fold((0.0, 0.0), |sums, row| (sums.0 + row.0, sums.1 + row.1));
        });
        for level in 1..levels.len() {
            let (before, after) = levels.split_at_mut(level);
            let (fine, coarse) = (&before[level - 1], &mut after[0]);
            let (cells, ratio) = (coarse.cells, coarse.ratio);
            coarse.sums.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(cell, sums)| {
                let place = split(cell, cells);
                *sums = (0.0, 0.0);
                for child in 0..ratio.iter().product() {
                    let beside = split(child, ratio);
                    let child = join(std::array::from_fn(|axis| ratio[axis] * place[axis] + beside[axis]), fine.cells);
                    *sums = (sums.0 + fine.sums[child].0, sums.1 + fine.sums[child].1);
                }
            });
        }
        for level in levels {
            for axis in 0..D {
                size[axis] *= level.ratio[axis] as f64;
            }
            // means over a cell of φ² and |∇φ|² of a product of straight lines from 0 to 1
            let square = (1.0_f64 / 3.0).powi(D as i32);
            let slope = 3.0 * square * size.iter().map(|size| 1.0 / (size * size)).sum::<f64>();
            let Level { cells, nodes, sums, inverse, .. } = level;
            inverse.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(node, inverse)| {
                let mut diagonal = 0.0;
                for_each_cell_around(split(node, *nodes), *cells, *periodic, |cell, _| {
                    diagonal += slope * sums[cell].0 + square * sums[cell].1;
                });
                *inverse = if diagonal > 0.0 { 1.0 / diagonal } else { 0.0 };
            });
        }
    }

    /// Φᵀ r on the finest lattice.
    fn restrict(&mut self, residual: &[f64]) {
        let Self { levels, periodic, order, particle, place, corner, .. } = self;
        corner.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(cell, corner)| {
            *corner = [0.0; CORNERS];
            for &a in &particle[order.places(cell, cell)] {
                let a = a as usize;
                for (k, corner) in corner.iter_mut().take(1 << D).enumerate() {
                    *corner += residual[a] * share(&place[a], k);
                }
            }
        });
        let Level { cells, nodes, value, .. } = &mut levels[0];
        value.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(node, value)| {
            *value = 0.0;
            for_each_cell_around(split(node, *nodes), *cells, *periodic, |cell, k| *value += corner[cell][k]);
        });
    }
}

impl<const D: usize> Preconditioner<f64> for Lattices<D> {
    fn weights(&self) -> &[f64] {
        &self.inverse_diagonal
    }

    fn apply(&mut self, residual: &[f64], out: &mut [f64]) {
        self.restrict(residual);
        let Self { levels, number, periodic, cell, place, node, inverse_diagonal, .. } = self;
        let levels = &mut levels[..*number];
        for level in 1..levels.len() {
            let (before, after) = levels.split_at_mut(level);
            let (fine, coarse) = (&before[level - 1], &mut after[0]);
            let (nodes, ratio) = (coarse.nodes, coarse.ratio);
            coarse.value.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(node, value)| {
                *value = from_finer(split(node, nodes), ratio, fine, *periodic);
            });
        }
        for level in levels.iter_mut() {
            for (value, inverse) in level.value.iter_mut().zip(&level.inverse) {
                *value *= inverse;
            }
        }
        for level in (1..levels.len()).rev() {
            let (before, after) = levels.split_at_mut(level);
            let (fine, coarse) = (&mut before[level - 1], &after[0]);
            let nodes = fine.nodes;
            fine.value.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(node, value)| {
                *value += from_coarser(split(node, nodes), coarse);
            });
        }
        let (finest, node) = (&levels[0], &*node);
        (out, residual, &*inverse_diagonal, &*cell, &*place).with_min_len(LEAST_TASK).for_each(
            |(out, residual, weight, &cell, place)| {
                let mut sum = residual * weight;
                for (k, &node) in node[cell as usize].iter().take(1 << D).enumerate() {
                    sum += finest.value[node as usize] * share(place, k);
                }
                *out = if *weight > 0.0 { sum } else { 0.0 };
            },
        );
    }
}
