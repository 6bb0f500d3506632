//! The program `bagnold`: its commands, and the registry of all cases.

pub mod cli;
mod registry;

pub use registry::REGISTRY;

use bagnold_figure as figure;
#[cfg(test)]
use bagnold_harness::observation;
use bagnold_harness::{
    case, checkpoint, control, evaluation, input, interruption, measured, metric, output, result, store,
};
use bagnold_number as number;
use bagnold_report as report;
use bagnold_scenes::study;
use bagnold_tools::{ToolError, calibration, compare, grains, judge, league, prediction, sweep};

#[cfg(test)]
#[path = "../harness/src/case/pendulum.rs"]
mod pendulum;
