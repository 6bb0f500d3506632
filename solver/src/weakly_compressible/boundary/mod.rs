//! Boundaries: periodic and mirrored axes as images, solid walls as dummy particles, contact as insurance.

pub mod contact;
pub mod gate;
mod images;
pub mod wall;

pub(crate) use images::Images;
pub use wall::{Surface, Wall, WallTreatment};
