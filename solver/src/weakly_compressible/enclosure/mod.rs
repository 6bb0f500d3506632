//! Boundaries of free-form scenes: walls of segments and triangles ([`facet_wall`]) with the dummy particles behind them, open sides by
//! which particles leave ([`boundary_set`]), and inlets that bring some in ([`inlet`]).
//!
//! The kernel calls a narrow interface. A scene holds a [`BoundarySet`]; [`backing`] and [`mesh_backing`] lay the dummy particles of
//! its walls; the state holds a `BoundaryState`. That one has a method for each place in a step: `release` and `assign_owners` at a
//! neighbour search, `feed` before a step, `book_wall_forces` after the forces, `press` and `touch` after the velocities, `advance` with the
//! positions. This folder reads particles, passes and walls of the kernel, but neither its scene nor its state.

pub mod backing;
pub mod boundary_set;
pub(crate) mod boundary_state;
mod boundary_step;
mod driven_out;
pub mod facet;
mod facet_contact;
mod facet_fan;
pub mod facet_grid;
pub mod facet_side;
pub mod facet_tree;
pub mod facet_wall;
mod feed_rate;
mod inflow_step;
pub mod inlet;
mod lattice_cell;
mod loaded_step;
mod mesh;
pub mod mesh_backing;
pub mod pose;
mod time_table;
mod turned_step;
pub mod wall_load;
pub mod wall_turn;

pub use boundary_set::BoundarySet;
pub use feed_rate::FeedRate;
pub use inlet::Inlet;
pub use mesh::largest_fan;
