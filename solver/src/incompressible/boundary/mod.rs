//! Where a phase ends: at its free surface and at its bed.

mod bed;
mod surface;

pub(super) use bed::{WallMirror, friction};
pub(super) use surface::{AT_SURFACE, Surface};
