//! What a column's results are known to.

use crate::collapse::heap::with_resolution;
use crate::metric::{Metric, Origin};

/// Relative standard deviation of results over the seeds of an ensemble `[-]`: what a single run leaves open.
#[derive(Debug, Clone, Copy)]
pub(super) struct EnsembleSpread {
    pub(super) run_out: f64,
    pub(super) height: f64,
}

/// What studies of the resolution tell of a column's results, as relative standard uncertainties, and the spread over the
/// seeds `[-]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct ColumnUncertainty {
    pub(super) run_out: Option<f64>,
    pub(super) height: Option<f64>,
    pub(super) spread: EnsembleSpread,
}

/// A metric with the parts of its uncertainty: that of the spacing, and the scatter over the seeds, relative `[-]`. The laws
/// that it is compared with give none of their own.
pub(super) fn with_uncertainty(metric: Metric, study: Option<f64>, row: Option<f64>, spread: f64) -> Metric {
    let scale = metric.value.abs();
    with_resolution(metric, study, row).known_to(
        Origin::Repeat,
        Some(spread * scale),
        "largest relative standard deviation over the seeds of the initial displacements",
    )
}
