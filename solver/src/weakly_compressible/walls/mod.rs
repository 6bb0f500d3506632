//! Walls of every flow: planes of dummy particles ([`wall`]), periodic and mirrored axes as ghost particles, contact as insurance,
//! a gate, and two plates beside a plane flow ([`SideWalls`]). Walls of any shape are in [`enclosure`](super::enclosure).

pub mod contact;
pub mod gate;
mod images;
mod side_walls;
pub mod wall;

pub use images::Images;
pub use side_walls::SideWalls;
pub use wall::{Surface, Wall, WallTreatment};
