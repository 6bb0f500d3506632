//! A reservoir on a slope: its parameters and its run.

mod parameters;
mod reservoir;
mod run;

pub use parameters::InclineCollapseParameters;
pub use reservoir::Reservoir;
pub(crate) use run::EARLIEST_REST;
pub use run::{SlopeCollapse, SlopeRun};
