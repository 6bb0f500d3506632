//! The mathematics of calibration: the parameters that agree best with data, how well the data determine them, and what they leave open.
//!
//! Parameters are coordinates u of the unit cube; the caller maps them to physical values. A weighted residual is
//! r = (model − datum)/σ with the datum's standard uncertainty σ, and χ² = Σ r². Nothing here runs on a clock or an
//! unseeded generator, so a search that is begun anew asks for the same points in the same order.

pub(crate) mod box_least_squares;
pub(crate) mod descent;
pub mod diagnosis;
pub mod emulator;
pub mod ends;
pub mod explore;
pub mod identifiability;
pub(crate) mod loss;
pub mod posterior;
mod profile;
pub mod region;
mod scatter;
pub mod scores;
pub mod search;
pub mod sensitivity;
pub(crate) mod serial_correlation;
pub mod solve;

pub use descent::LocalMinimum;
pub use emulator::Emulator;
pub use ends::IntervalEnd;
pub use explore::{Explored, explore};
pub use identifiability::{ParameterLabel, assess};
pub use loss::Loss;
pub use profile::{ProfileLikelihood, ProfileLikelihoodPoint};
pub use region::{Region, Uncertainties, chi_squared_quantile, chi_squared_tail};
pub use scatter::Repeatability;
pub use search::{
    Budget, Evaluated, Method, SearchError, SearchResult, Termination, continue_search, search, search_design,
};
pub use serial_correlation::{SerialCorrelation, serial_correlation};

pub use solve::{Answer, SolvePlan, UNLIKELY, solve};

/// The model as the search sees it.
pub trait Evaluate {
    /// Error other than a run that diverges.
    type Error;

    /// Weighted residuals `[-]` at each point of the unit cube; `None` where the model failed (a run diverged). Points
    /// may be evaluated in parallel; the caller caches, so asking twice costs nothing and counts once.
    ///
    /// # Errors
    /// Failures that stop the whole search, such as a full disk.
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Self::Error>;
}

/// Largest difference of a coordinate.
fn largest_distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// χ² of weighted residuals `[-]`.
pub fn chi_squared(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}
