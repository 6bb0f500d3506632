//! Tools for any case: calibrations, predictions, sweeps, judging of external codes and their league, fields of grains, comparisons of folders.

pub mod calibration;
pub mod compare;
mod error;
pub mod grains;
pub mod judge;
pub mod league;
pub mod prediction;
pub mod sweep;

pub use error::ToolError;

use bagnold_figure as figure;
use bagnold_harness::{case, evaluation, evidence, input, measured, metric, observation, output, page, result, store};
use bagnold_inference::{inference, sampling, statistics};
use bagnold_number as number;
use bagnold_report as report;
