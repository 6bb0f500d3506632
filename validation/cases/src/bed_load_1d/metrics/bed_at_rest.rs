//! The water over a moving bed beside that over the same bed at rest: two layers that differ in nothing but that grains may move.

use super::super::draws::DrawnLayer;
use super::super::flow::BedLoad1dFlow;
use super::super::quantities::{LAYER_SLOPE_RATIO, VELOCITY_DEFICIT};
use crate::case::Flow;
use crate::metric::{Confidence, Limit, Metric, Variant};
use crate::reference::one_dimension::bed_load::LayerState;

/// The slope on which the paper shows the water with and without moving grains `[-]`.
const SHOWN_WITH_AND_WITHOUT: f64 = 0.03;

/// Half a grain above the bed, and where there are no grains `[m]`.
const NEAR: f64 = 2.5e-3;
const ABOVE: f64 = 0.025;

/// Heights between which the slope next to the bed is fitted `[m]`.
const NEAR_BED: (f64, f64) = (0.5e-3, 3e-3);

/// The difference of the water's velocities at a height, over u_* `[-]`.
fn deficit(run: &BedLoad1dFlow, state: &LayerState, rest: &LayerState, height: f64) -> f64 {
    (state.at(height).fluid_velocity - rest.at(height).fluid_velocity) / run.stream().shear_velocity()
}

/// The same with the paper's own drag law and all else as usual: observed, for one law is no range.
pub(super) fn of_paper(run: &BedLoad1dFlow, layer: &DrawnLayer) -> Vec<Metric> {
    let variant = Variant::of("slope", run.stream().slope).and("drag", layer.closures.drag.name());
    let metric = |height: f64| {
        let value = deficit(run, &layer.state, &layer.rest, height);
        VELOCITY_DEFICIT.of(&variant.clone().and("height", 1e3 * height), value).with_snapshot_tolerance(0.01, 0.01)
    };
    vec![metric(NEAR), metric(ABOVE)]
}

/// The water over the moving bed beside that over the same bed at rest; judged on the slope that the paper shows both of.
pub(super) fn metrics(run: &BedLoad1dFlow, state: &LayerState, rest: &LayerState) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let variant = run.variant();
    let is_shown = run.stream().slope == SHOWN_WITH_AND_WITHOUT;
    let statements = [
        (
            NEAR,
            None,
            "near the bed slower than without moving grains",
            Limit::AtMost(-0.1),
            "−0.1 u_* (friction velocity): slower by enough that equal velocities fail",
        ),
        (
            ABOVE,
            Some(0.0),
            "above as fast as without moving grains",
            Limit::Within(-0.25, 0.25),
            "0.25 u_* (friction velocity): 2 % of the depth-averaged velocity",
        ),
    ];
    for (height, expected, statement, limit, reason) in statements {
        let source = format!("statement of the bed-load paper at 3 %: {statement}");
        metrics.push(
            VELOCITY_DEFICIT
                .of(&variant.clone().and("height", 1e3 * height), deficit(run, state, rest, height))
                .against(expected, &source, Confidence::Medium)
                .gated_by(is_shown.then_some(limit), reason)
                .with_snapshot_tolerance(0.01, 0.01),
        );
    }
    let slope = |of: &LayerState| of.logarithmic_slope(NEAR_BED.0, NEAR_BED.1, run.closures.karman);
    if let Some((own, without)) = slope(state).zip(slope(rest)) {
        let statement = "statement of the bed-load paper at 3 %: slower below and equal above, so that u grows faster with ln z where \
                         grains move (its figures have u on the abscissa, where that is the gentler line)";
        metrics.push(
            LAYER_SLOPE_RATIO
                .of(&variant, own / without)
                .against(None, statement, Confidence::Medium)
                .gated_by(
                    is_shown.then_some(Limit::AtLeast(1.05)),
                    "1.05: a slope steeper by 5 % exceeds the discretisation error",
                )
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    metrics
}
