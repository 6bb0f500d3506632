//! Fits, averages and comparisons, each with its uncertainty.

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

pub use block_average::{Average, BLOCKS, TooFewSamples, block_average, block_jackknife};
pub use block_profile::{BlockProfile, ProfilePoint};
pub use fit::{Exponent, FittedValue, LinearFit, common_slope, linear_fit, log_log_slope, power_law};
pub use grid_convergence::{GridConvergence, Mean, grid_convergence};
pub use groups::grouped;
pub use interpolation::{Extrapolation, interpolated};
pub use mean::{mean, mean_and_variance, relative_l2};
pub use model_bias::{Comparison, ModelBias, model_bias};
pub use neighbour_scatter::neighbour_scatter;
pub use percentile::percentile;
pub use rank_correlation::rank_correlation;
pub use segmented::{Segmented, curvature, number_of_pieces, segmented_regression};
pub use student::{student_quantile, student_quantile_of};
