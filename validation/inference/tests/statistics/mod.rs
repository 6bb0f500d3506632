//! Fits, averages and comparisons.

mod block_average;
mod block_profile;
mod fit;
mod grid_convergence;
mod groups;
mod interpolation;
mod mean;
mod model_bias;
mod neighbour_scatter;
mod percentile;
mod rank_correlation;
mod segmented;
mod student;
