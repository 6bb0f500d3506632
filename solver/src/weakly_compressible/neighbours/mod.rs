//! Neighbour search: a cell grid that fills a Verlet list of fixed stride.

pub mod brute_force;
mod cell_grid;
mod verlet_list;

pub(crate) use cell_grid::CellGrid;
pub(crate) use verlet_list::{BLOCK, LARGEST_ROW, NeighbourGroup};
pub use verlet_list::{Row, VerletList};
