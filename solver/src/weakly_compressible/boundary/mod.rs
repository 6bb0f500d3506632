//! Boundaries: periodic and mirrored axes as images, solid walls as dummy particles, contact as insurance. Walls are
//! planes normal to an axis ([`wall`]) or shells of segments and triangles ([`shell`], [`shell::Shell::mesh`]); open sides let
//! particles leave ([`enclosure`]), and inlets bring some in ([`inlet`]). Beside a plane flow there may be two plates ([`SideWalls`]).

pub mod backing;
pub mod contact;
pub mod enclosure;
pub mod facet;
pub mod facet_grid;
mod feed_rate;
pub mod gate;
mod images;
pub mod inlet;
mod lattice_cell;
mod mesh;
pub mod mesh_backing;
pub mod shell;
pub(crate) mod shell_contact;
mod side_walls;
pub mod standing;
pub mod wall;

pub use enclosure::Enclosure;
pub use feed_rate::FeedRate;
pub(crate) use images::Images;
pub use inlet::Inlet;
pub use side_walls::SideWalls;
pub use wall::{Surface, Wall, WallTreatment};
