//! The pile of aluminium bars that was measured, among the columns.

use super::flow::ColumnFlow;
use super::material::{Alteration, ExperimentGrains};
use crate::collapse::CollapseRecord;
use crate::metric::{Metric, Origin};
use crate::reference::collapse::{ALUMINIUM_BAR_PILE, MeasuredPile};
use crate::statistics::common_slope;

const RATE: &str = "rate dependence of friction, not measured for the rods (difference from a pile with the rate dependence of Lagrée's grains, over √3)";
const FRICTION: &str = "meaning of the friction angle (difference from a pile with the sine instead of the tangent of the measured angle, over √3)";

/// The measured pile that a column is, if it is one.
pub(crate) fn pile_of<const D: usize>(run: &ColumnFlow<D>) -> Option<&'static MeasuredPile> {
    let pile = &*ALUMINIUM_BAR_PILE;
    let same = |own: f64, measured: f64| (own / measured - 1.0).abs() < 1e-9;
    let is_it = (D, run.grains) == (2, ExperimentGrains::Bars)
        && run.ensemble_member == 0
        && same(run.half_width, pile.length)
        && same(run.initial_height() * run.half_width, pile.height);
    is_it.then_some(pile)
}

/// Slope of the measured line of failure `[°]` and its standard error.
pub(crate) fn failure_angle(pile: &MeasuredPile) -> Option<(f64, f64)> {
    let fit = common_slope(std::slice::from_ref(&pile.failure))?;
    let error = fit.standard_error / (1.0 + fit.value * fit.value);
    Some((libm::atan(-fit.value).to_degrees(), error.to_degrees()))
}

/// A metric with what it moves by if the pile's friction has another meaning or rises with the rate, as standard uncertainties: the pile
/// stands at one end of each even spread.
pub(crate) fn with_friction<const D: usize>(
    metric: Metric,
    records: &[CollapseRecord<D>],
    run: &ColumnFlow<D>,
    difference: impl Fn(&CollapseRecord<D>) -> Option<f64>,
) -> Metric {
    if !run.made_of().is_published() {
        return metric;
    }
    let widest = |altered: Alteration| {
        let altered = records.iter().filter(|(other, _)| {
            pile_of(other).is_some() && other.altered == altered && other.resolution == run.resolution
        });
        Some(altered.filter_map(|other| Some(difference(other)?.abs())).fold(0.0, f64::max) / 3.0_f64.sqrt())
    };
    let metric = metric.known_to(Origin::Input, widest(Alteration::Friction), FRICTION);
    metric.known_to(Origin::Input, widest(Alteration::LimitingFriction), RATE)
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
