//! Uncertainty of a column's results.

use crate::collapse::heap::with_resolution;
use crate::metric::{Metric, Origin};

/// Relative standard uncertainties of a result: by a study of the resolution, and over the seeds, which a single run leaves open `[-]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    pub(super) study: Option<f64>,
    pub(super) spread: f64,
}

impl Known {
    /// A metric with both parts; without a study, with what a row makes of it in the metric's unit. The laws that it is compared with
    /// give none of their own.
    pub(super) fn of(self, metric: Metric, row: Option<f64>) -> Metric {
        let source = "largest relative standard deviation over the seeds of the initial displacements";
        let spread = Some(self.spread * metric.value.abs());
        with_resolution(metric, self.study, row).known_to(Origin::Repeat, spread, source)
    }
}
