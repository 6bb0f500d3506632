//! A reservoir on a slope.

mod flow;

pub(crate) use flow::EARLIEST_REST;
pub use flow::{SlopeCollapse, SlopeFlow};
