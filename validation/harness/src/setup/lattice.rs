//! Sites of particles in the plane.

use super::displaced;
use bagnold_solver::vector::Vector;

/// Rows and columns of particles, each in the middle of its cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Edge of a cell `[m]`.
    pub spacing: f64,
    /// Rows of particles above each other.
    pub rows: usize,
    /// Columns along the period.
    pub columns: usize,
    /// Height of the lower edge `[m]`.
    pub bottom: f64,
}

impl Lattice {
    /// Height `[m]`.
    pub fn height(&self) -> f64 {
        self.rows as f64 * self.spacing
    }

    /// Length of the period `[m]`.
    pub fn length(&self) -> f64 {
        self.columns as f64 * self.spacing
    }

    /// As many particles as there are cells.
    #[expect(clippy::len_without_is_empty, reason = "a lattice has particles")]
    pub fn len(&self) -> usize {
        self.rows * self.columns
    }

    /// The rows below it, as walls are made of `[m]`.
    pub fn below(&self, rows: usize) -> Self {
        Self { rows, bottom: self.bottom - rows as f64 * self.spacing, ..*self }
    }

    /// Positions row by row from below `[m]`.
    pub fn sites(&self) -> impl Iterator<Item = Vector<2>> {
        let Self { spacing, bottom, columns, .. } = *self;
        (0..self.len()).map(move |site| {
            let (row, column) = (site / columns, site % columns);
            Vector::<2>::new((column as f64 + 0.5) * spacing, bottom + (row as f64 + 0.5) * spacing)
        })
    }

    /// Positions `[m]` displaced at random by at most `jitter` spacings along each axis.
    pub fn displaced(&self, jitter: f64, seed: u64) -> Vec<Vector<2>> {
        displaced(self.sites(), jitter * self.spacing, seed).map(|(_, place)| place).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LATTICE: Lattice = Lattice { spacing: 0.5, rows: 2, columns: 3, bottom: 1.0 };

    #[test]
    fn sites_fill_their_cells_and_walls_go_on_below() {
        let sites: Vec<Vector<2>> = LATTICE.sites().collect();
        assert_eq!(sites.len(), 6);
        assert_eq!(sites[0], Vector::<2>::new(0.25, 1.25));
        assert_eq!(sites[5], Vector::<2>::new(1.25, 1.75));
        assert_eq!((LATTICE.height(), LATTICE.length()), (1.0, 1.5));
        let wall = LATTICE.below(4);
        assert_eq!((wall.height(), wall.bottom), (2.0, -1.0));
    }

    #[test]
    fn displacements_stay_within_their_bound_and_belong_to_their_seed() {
        let displaced = LATTICE.displaced(0.2, 7);
        let shifts: Vec<f64> = displaced.iter().zip(LATTICE.sites()).map(|(x, site)| (x - site).amax()).collect();
        assert!(shifts.iter().all(|shift| *shift <= 0.1) && shifts.iter().any(|shift| *shift > 0.05), "{shifts:?}");
        assert_eq!(displaced, LATTICE.displaced(0.2, 7));
        assert_ne!(displaced, LATTICE.displaced(0.2, 8));
    }
}
