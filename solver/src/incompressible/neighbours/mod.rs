//! Neighbour search: cells, pairs and their separations by the shortest way, and the time at which a search is due.

mod grid;
mod lane_list;
mod layers;
mod pairs;
mod periods;

pub use grid::Grid;
pub(crate) use lane_list::SavedList;
pub use lane_list::{LaneList, Sources};
pub(crate) use layers::{Layers, Places};
pub use pairs::Pairs;
pub(crate) use pairs::SavedPairs;
pub use periods::{Across, Periods};

use crate::lanes::LANES;

/// Particles a task of a parallel loop has at least.
pub(crate) const LEAST_TASK: usize = 512;

/// Groups of particles, one a lane, that a task has at least.
pub(crate) const LEAST_GROUPS: usize = LEAST_TASK / LANES;
