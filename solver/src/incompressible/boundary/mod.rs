//! Where a phase ends: at its free surface and at its bed.

mod bed;
mod surface;

pub(super) use bed::friction;
pub(super) use surface::find_surface;
