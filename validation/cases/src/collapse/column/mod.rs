//! Columns on a horizontal bed, planar and round: the flow and its grains.

mod flow;
mod material;
mod pile;

pub use flow::ColumnFlow;
pub(crate) use flow::{EARLIEST_REST, PICTURES};
pub use material::{Alteration, ExperimentGrains, Material};
pub(crate) use pile::{failure_angle, pile_of, with_friction};
