//! Boundaries of a phase: its free surface and its bed.

mod bed;
mod surface;

pub(super) use bed::{WallMirror, friction};
pub(super) use surface::{AT_SURFACE, Surface};
