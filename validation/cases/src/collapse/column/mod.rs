//! Columns on a horizontal bed, planar and round: grains, release and run.

mod material;
mod pile;
mod release;
mod run;

pub use material::{Alteration, ExperimentGrains, Material};
pub(crate) use pile::{failure_angle, pile_of, with_friction};
pub use release::Release;
pub use run::{ColumnPurpose, ColumnRun, Geometry};
pub(crate) use run::{EARLIEST_REST, PICTURES, TALLEST_FINE};
