//! Who is near whom: cells, pairs and their separations by the shortest way, and when a search is due.

mod grid;
mod layers;
mod pairs;
mod periods;

pub(crate) use grid::Grid;
pub(crate) use layers::{Layers, Places, SavedLayers};
pub(crate) use pairs::{Pair, Pairs, SavedPairs, Sources};
pub(crate) use periods::Periods;

/// Particles a task of a parallel loop has at least.
pub(crate) const LEAST_TASK: usize = 512;
