//! The pile of aluminium bars that was measured, among the columns.

use super::column::{ColumnPurpose, ColumnRun, Geometry};
use super::material::ExperimentGrains;
use crate::reference::{ALUMINIUM_BAR_PILE, MeasuredPile};
use crate::statistics::common_slope;

/// The measured pile that a column is, if it is one.
pub(super) fn pile_of(run: &ColumnRun) -> Option<&'static MeasuredPile> {
    let pile = &*ALUMINIUM_BAR_PILE;
    let same = |own: f64, measured: f64| (own / measured - 1.0).abs() < 1e-9;
    let is_it = (run.geometry, run.material.grains) == (Geometry::Planar, ExperimentGrains::Bars)
        && run.purpose == ColumnPurpose::Law
        && same(run.half_width, pile.length)
        && same(run.initial_height() * run.half_width, pile.height);
    is_it.then_some(pile)
}

/// Slope of the measured line of failure `[°]` and its standard error.
pub(super) fn failure_angle(pile: &MeasuredPile) -> Option<(f64, f64)> {
    let fit = common_slope(std::slice::from_ref(&pile.failure))?;
    let error = fit.standard_error / (1.0 + fit.value * fit.value);
    Some((libm::atan(-fit.value).to_degrees(), error.to_degrees()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_of_failure_has_the_slope_between_its_ends() {
        let (angle, error) = failure_angle(&ALUMINIUM_BAR_PILE).expect("points");
        let between = libm::atan((0.0989_f64 - 0.0005) / (0.1794 - 0.0212)).to_degrees();
        assert!((angle - between).abs() < 2.0 && error < 2.0, "{angle} ± {error} for {between}");
    }
}
