//! Cases, references, metrics, figures and reports around the Bagnold solver.

pub mod calibration;
pub mod case;
pub mod cases;
pub mod checkpoint;
pub mod cli;
pub mod compare;
pub mod evaluation;
pub mod input;
pub mod interruption;
pub mod judge;
pub mod metric;
pub mod mutation;
pub mod observation;
pub mod output;
mod page;
pub mod reference;
pub mod report;
pub mod result;
pub mod setup;
pub mod store;
pub mod study;
pub mod sweep;

pub use bagnold_figure as figure;
pub use bagnold_inference::{inference, sampling, statistics};
pub use bagnold_number as number;
