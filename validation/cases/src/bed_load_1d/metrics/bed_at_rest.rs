//! The water over a moving bed beside that over the same bed at rest: two layers that differ in nothing but that grains may move.

use super::super::flow::BedLoad1dFlow;
use super::super::quantities::{LAYER_SLOPE_RATIO, VELOCITY_DEFICIT};
use crate::case::Flow;
use crate::metric::{Confidence, Limit, Metric};
use crate::reference::one_dimension::bed_load::LayerState;

/// The slope on which the paper shows the water with and without moving grains `[-]`.
const SHOWN_WITH_AND_WITHOUT: f64 = 0.03;

/// Heights between which the slope next to the bed is fitted `[m]`.
const NEAR_BED: (f64, f64) = (0.5e-3, 3e-3);

/// The water over the moving bed beside that over the same bed at rest; judged on the slope that the paper shows both of.
pub(super) fn metrics(run: &BedLoad1dFlow, state: &LayerState, rest: &LayerState) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let variant = run.variant();
    let stream = run.stream();
    let is_shown = stream.slope == SHOWN_WITH_AND_WITHOUT;
    let deficit = |height| (state.at(height).fluid_velocity - rest.at(height).fluid_velocity) / stream.shear_velocity();
    let statements = [
        (
            2.5e-3,
            None,
            "near the bed slower than without moving grains",
            Limit::AtMost(-0.1),
            "slower by a tenth of u_*, so that equal velocities do not show it",
        ),
        (
            0.025,
            Some(0.0),
            "above as fast as without moving grains",
            Limit::Within(-0.25, 0.25),
            "a quarter of u_*, as clear water itself is judged: 2 % of the depth mean",
        ),
    ];
    for (height, expected, statement, limit, reason) in statements {
        let source = format!("statement of the bed-load paper at 3 %: {statement}");
        metrics.push(
            VELOCITY_DEFICIT
                .of(&variant.clone().and("height", 1e3 * height), deficit(height))
                .against(expected, &source, Confidence::Medium)
                .gated_by(is_shown.then_some(limit), reason)
                .with_snapshot_tolerance(0.01, 0.01),
        );
    }
    let slope = |of: &LayerState| of.logarithmic_slope(NEAR_BED.0, NEAR_BED.1, run.closures.karman);
    if let Some((own, without)) = slope(state).zip(slope(rest)) {
        metrics.push(
            LAYER_SLOPE_RATIO
                .of(&variant, own / without)
                .against(None, "statement of the bed-load paper at 3 %: gentler where grains move", Confidence::Medium)
                .gated_by(is_shown.then_some(Limit::AtMost(0.95)), "gentler by 5 %, above any error of the cells")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    metrics
}
