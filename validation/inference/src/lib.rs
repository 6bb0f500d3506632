//! Calibration of models that cost minutes, designs of points to try, and the statistics behind both. Nothing here knows a
//! solver, a case or a file.
//!
//! - [`inference`]: the parameters that agree best with data, within a budget of evaluations, and the intervals of those that
//!   agree as well. A model is anything that gives weighted residuals ([`inference::Evaluate`]).
//! - [`sampling`]: grids, Latin hypercubes and Sobol points, and parameters with bounds and scales.
//! - [`statistics`]: fits, means with their uncertainty, order of convergence, and other quantities that are read off series.
//!
//! Everything is the same to the last bit on every machine: random numbers come from seeds, sums run in a fixed order.
//!
//! # A first calibration
//! The decay rate k `[1/s]` of a voltage, measured four times to 0.01 V:
//!
//! ```
//! use bagnold_inference::inference::{Budget, Evaluate, Method, Repeatability, SolvePlan, solve};
//! use std::convert::Infallible;
//!
//! /// (time `[s]`, voltage `[V]`)
//! const MEASURED: [(f64, f64); 4] = [(0.5, 0.78), (1.0, 0.61), (2.0, 0.36), (4.0, 0.14)];
//!
//! struct Decay;
//!
//! impl Evaluate for Decay {
//!     type Error = Infallible;
//!     fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
//!         // the unit cube's coordinate stands for k from 0 to 2 per second
//!         let of_point = |point: &Vec<f64>| {
//!             let model = |time: f64| (-2.0 * point[0] * time).exp();
//!             MEASURED.iter().map(|(time, voltage)| (model(*time) - voltage) / 0.01).collect()
//!         };
//!         Ok(points.iter().map(|point| Some(of_point(point))).collect())
//!     }
//! }
//!
//! let plan = SolvePlan {
//!     start: vec![0.5],
//!     method: Method::TrustRegion,
//!     design: Vec::new(),
//!     budget: Budget::default(),
//!     region_evaluations: 20,
//!     runs: Repeatability::Smooth,
//!     series: Vec::new(),
//! };
//! let answer = solve(&mut Decay, &plan).expect("the model cannot fail");
//! assert!((2.0 * answer.search.best[0] - 0.5).abs() < 0.01, "k is 0.5 per second");
//! let [lower, upper] = &answer.explored.expect("evaluations enough").ends[0];
//! assert!(2.0 * lower.point[0] < 0.5 && 0.5 < 2.0 * upper.point[0] && lower.settled && upper.settled);
//! ```

pub mod inference;
pub mod sampling;
pub mod statistics;

/// For the tests of this package alone: parts of private modules.
#[doc(hidden)]
pub mod internals {
    pub use crate::inference::box_least_squares::box_least_squares;
    pub use crate::inference::descent::{Smooth, descend};
    pub use crate::inference::emulator::correction::KrigingCorrection;
    pub use crate::inference::loss::CORNER;
    pub use crate::inference::posterior::middles;
    pub use crate::inference::search::differences::{Iterate, differences};
    pub use crate::inference::search::recorder::{Halt, Recorder};
    pub use crate::inference::serial_correlation::Fit;
}
