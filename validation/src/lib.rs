//! Cases, references, metrics, figures and reports around the Bagnold solver.

pub mod case;
pub mod cases;
pub mod cli;
pub mod error;
pub mod figure;
pub mod metric;
pub mod observe;
pub mod output;
pub mod reference;
pub mod report;
pub mod statistics;
pub mod store;
