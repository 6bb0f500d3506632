//! Scenes that a file describes, in two and three dimensions, and the studies that judge the runs of any case.

pub mod enclosed;
pub mod scene;
pub mod scene_space;
pub mod study;

use bagnold_figure as figure;
use bagnold_harness::{
    case, checkpoint, control, evaluation, evidence, input, measured, metric, observation, output, setup, store,
};
use bagnold_inference::statistics;
