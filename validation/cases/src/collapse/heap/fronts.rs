//! The fronts of a heap that are judged, and what they are known to.

use super::toe::Toe;
use crate::metric::{Metric, Origin};
use serde::{Deserialize, Serialize};

/// Thickness at the front over the initial half width `[-]`: the front that run-outs are judged by, a grain of Lagrée's.
///
/// A row of particles is thicker up to 50 over the half width, so that the toe counts by its mass (`Toe`). With 20
/// particles over r_0 the run-out of his grains is then 0.7, 1.9 and 2 % longer than what finer columns approach (a = 0.5, 1
/// and 3; 13, 7 and 3 % by thickness in bins of 0.1 r_0), and scatters by 1.0, 1.0 and 0.5 % from seed to seed
/// (2.8, 1.7 and 1.4 %).
pub const FRONT_THICKNESS: f64 = 0.02;
/// A thickness that one row of particles has from 20 over the half width on `[-]`: the front at it, by thickness in bins, leaves out
/// what creeps on beyond and repeats to four digits when particles are displaced by 1e-10 of a spacing, so that the time of the stop
/// is told by it.
pub(crate) const ROW_THICKNESS: f64 = 0.05;
/// Share of a row to which the thickness at a front is known, as a standard uncertainty `[-]`: within two fifths of a row lies
/// what runs with 20, 40 and 80 particles over r_0 differ by from what they approach (0.05, 0.3 and 0.4 rows at a = 0.5;
/// 0.1, 0.2 and 0.2 at 1; 0.2 and 0.2 at 3), taken as evenly spread.
const KNOWN_SHARE_OF_ROW: f64 = 0.23;

/// Fronts of a heap over its initial half width `[-]`.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Fronts {
    /// Front at [`FRONT_THICKNESS`].
    pub thin: f64,
    /// Shift of the fronts for one row more or less of thickness: a row over the slope of the toe.
    pub length_of_row: f64,
}

impl Fronts {
    /// Fronts of a toe, over a half width `[m]`.
    pub(super) fn of(toe: &Toe, half_width: f64) -> Self {
        Self {
            thin: toe.front(FRONT_THICKNESS * half_width) / half_width,
            length_of_row: toe.length_of_row() / half_width,
        }
    }

    /// Standard uncertainty of a front from the spacing, where no study of the resolution tells it `[-]`: the thickness at the
    /// toe is known to a share of a row.
    pub fn uncertainty(self) -> f64 {
        KNOWN_SHARE_OF_ROW * self.length_of_row
    }
}

/// A metric with the part of its uncertainty that comes from the spacing: by a study of the column, relative `[-]`, else,
/// for a front, by what a share of a row makes of it, in the metric's unit.
pub(crate) fn with_resolution(metric: Metric, study: Option<f64>, row: Option<f64>) -> Metric {
    let by_study = "half of the 95 % interval of the extrapolated value of this column's resolution study";
    let by_row = "thickness at the toe known within 0.4 particle rows, over the toe's slope: error of columns with 20 to 80 particles over r_0";
    let scale = metric.value.abs();
    let (standard, source) = study.map_or((row, by_row), |relative| (Some(relative * scale), by_study));
    metric.known_to(Origin::Numerical, standard, source)
}
