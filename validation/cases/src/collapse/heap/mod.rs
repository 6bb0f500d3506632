//! A spreading heap on any bed: the block at its start, its front and thickness, its pictures.

mod block;
mod camera;
mod deposit;
mod fronts;
mod observer;
mod toe;

pub(crate) use block::{GrainBlock, STIFFNESS};
pub(crate) use deposit::{AT_REST, Surveyor, radius};
pub use deposit::{BIN_WIDTH, Collapse};
pub(crate) use fronts::with_resolution;
pub use fronts::{FRONT_THICKNESS, Fronts};
pub(crate) use observer::CollapseObserver;
