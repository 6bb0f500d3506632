//! Boundaries: periodic and mirrored axes as images, solid walls as dummy particles, contact as insurance. Walls are
//! planes normal to an axis ([`wall`]) or shells of segments and triangles ([`shell`], [`shell::Shell::mesh`]); open sides let particles leave ([`enclosure`]).

pub mod backing;
pub mod contact;
pub mod enclosure;
pub mod facet;
pub mod facet_grid;
pub mod gate;
mod images;
mod lattice_cell;
mod mesh;
pub mod mesh_backing;
pub mod shell;
pub(crate) mod shell_contact;
pub mod standing;
pub mod wall;

pub use enclosure::Enclosure;
pub(crate) use images::Images;
pub use wall::{Surface, Wall, WallTreatment};
