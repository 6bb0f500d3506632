//! Series that gauges are compared with.

use bagnold_solver::parameter::{between, filled};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A measured series that a gauge is compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeasuredSeries {
    /// Name of the gauge, whose first column it is.
    pub gauge: String,
    /// Source of the numbers.
    pub source: String,
    /// Times `[s]` and values in the gauge's unit, positive.
    #[schemars(transform = filled("at least one row", "give time and value of every point, or name a `file` of measurements"))]
    pub points: Vec<(f64, f64)>,
    /// File of measurements with these points, where they stand in one: any units, repeats as their mean.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub file: String,
    /// Largest root mean square of the relative error `[%]`; 0 where it is only observed.
    #[serde(default)]
    #[schemars(transform = between(0.0, 100.0, "give it in per cent, such as 10"))]
    pub limit: f64,
}
