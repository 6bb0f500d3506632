//! Neighbour search: a cell grid that fills a Verlet list, in groups of eight particles.

mod block_search;
mod cell_grid;
mod verlet_list;

pub(crate) use block_search::{BLOCK, LARGEST_ROW};
pub(crate) use cell_grid::CellGrid;
pub(crate) use verlet_list::NeighbourGroup;
pub use verlet_list::{Row, VerletList};

/// Particles that the neighbour list can address, walls included.
pub(crate) const MOST_PARTICLES: usize = i32::MAX as usize / 64;
