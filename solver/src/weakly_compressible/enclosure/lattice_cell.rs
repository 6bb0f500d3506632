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
    /// A place in the triangle, by whole numbers below [`SAMPLES`] along the edges.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::Tensor;

    #[test]
    fn samples_are_the_middles_of_equal_parts_of_a_cell() {
        let middle = Vector::<3>::new(4.0, -2.0, 7.0);
        let edges = [[2.0, 0.5, 0.0], [-0.2, 1.0, 0.3], [0.1, 0.1, 3.0]].map(Vector::<3>::from);
        let cell = Cell { middle, edges };
        let inside = Tensor::<3>::from_columns(&edges).try_inverse().expect("a volume");
        let (mut sum, mut squares, mut seen) = (Vector::<3>::zeros(), Tensor::<3>::zeros(), Vec::new());
        for k in 0..SAMPLES.pow(3) {
            let place = inside * (cell.sample([k / 16, k / 4 % 4, k % 4]) - middle);
            assert!(place.amax() < 0.5 && seen.iter().all(|other: &Vector<3>| (other - place).norm() > 0.2));
            sum += place;
            squares += place * place.transpose();
            seen.push(place);
        }
        assert!(sum.norm() < 1e-13);
        // 1/12 of a whole edge less 1/12 of a part
        assert!((squares / 64.0 - Tensor::identity() * ((1.0 - 1.0 / 16.0) / 12.0)).norm() < 1e-13);
        assert!((cell.volume() - 1.0 / inside.determinant()).abs() < 1e-13);
    }
}
