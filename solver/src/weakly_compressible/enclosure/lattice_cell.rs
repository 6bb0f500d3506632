//! A cell of the lattice of dummy particles behind a mesh, and the places in it by which its owners are found.

use crate::vector::Vector;

/// Samples of a spacing along each direction, by which it is found what belongs to a part.
pub(super) const SAMPLES: usize = 4;
/// Corners of a cell.
pub(super) const CORNERS: usize = 1 << 3;

/// A cell by its middle and its edges `[m]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell {
    pub(super) middle: Vector<3>,
    pub(super) edges: [Vector<3>; 3],
}

impl Cell {
    /// A place in it, by whole numbers below [`SAMPLES`] along the edges.
    pub(super) fn sample(&self, at: [usize; 3]) -> Vector<3> {
        let offset = |k: usize| (at[k] as f64 + 0.5) / SAMPLES as f64 - 0.5;
        self.middle + self.edges[0] * offset(0) + self.edges[1] * offset(1) + self.edges[2] * offset(2)
    }

    pub(super) fn volume(&self) -> f64 {
        self.edges[0].cross(&self.edges[1]).dot(&self.edges[2]).abs()
    }

    /// Distance of its corners from its middle `[m]`.
    pub(super) fn radius(&self) -> f64 {
        0.5 * self.edges.iter().map(Vector::norm_squared).sum::<f64>().sqrt()
    }
}
