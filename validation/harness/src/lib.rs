//! The frame of every judgement: what a case is, how its runs are recorded and stored, and what their metrics are compared with.
//! It knows no case and no flow; cases, scenes and tools stand on it.

pub mod case;
pub mod checkpoint;
pub mod control;
pub mod evaluation;
pub mod evidence;
pub mod input;
pub mod interruption;
pub mod measured;
pub mod metric;
pub mod observation;
pub mod output;
pub mod page;
pub mod result;
pub mod setup;
pub mod store;

use bagnold_figure as figure;
use bagnold_inference::{sampling, statistics};
use bagnold_number as number;
