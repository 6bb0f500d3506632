//! Boundaries of free-form scenes: shells of segments and triangles ([`shell`], [`shell::Shell::mesh`]) with the dummy particles behind
//! them, open sides by which particles leave ([`boundary_set`]), and inlets that bring some in ([`inlet`]).

pub mod backing;
pub mod boundary_set;
mod enclosure_step;
pub mod facet;
pub mod facet_grid;
mod feed_rate;
mod inflow_step;
pub mod inlet;
mod lattice_cell;
mod mesh;
pub mod mesh_backing;
pub mod shell;
mod shell_contact;
pub mod standing;
pub(crate) mod surroundings;

pub use boundary_set::Enclosure;
pub use feed_rate::FeedRate;
pub use inlet::Inlet;
