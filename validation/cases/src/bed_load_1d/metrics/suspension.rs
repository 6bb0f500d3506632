//! Grains that eddies also carry: two measured sheet flows and the slopes of the case, with the uncertain inputs varied.

use super::super::BedLoad1dRecord;
use super::super::flow::{BedLoad1dFlow, LayerStart};
use super::super::quantities::DUCT_VELOCITY_DIFFERENCE;
use super::super::records::{InputSpread, of};
use crate::case::Flow;
use crate::metric::{Metric, Origin};
use crate::reference::bed_load::SHEET_FLOW_LOWEST_VELOCITY;
use crate::reference::one_dimension::bed_load::LayerState;

/// Speed of grains at the level below which they rest, and the range of it, over u_* `[-]`: the source states no level.
pub(in crate::bed_load_1d) const RESTING: (f64, f64, f64) = (0.1, 0.03, 1.0);

/// Whether a layer is one with suspension, and not one of its inputs varied.
fn is_own(run: &BedLoad1dFlow) -> bool {
    run.is_suspended() && run.start == LayerStart::Both
}

/// A metric of a published flow with the uncertainty of its inputs and of its cells.
pub(super) fn with_spread(
    metric: Metric,
    records: &[BedLoad1dRecord],
    (own_run, own): (&BedLoad1dFlow, &LayerState),
    value: impl Fn(&BedLoad1dFlow, &LayerState) -> f64,
) -> Metric {
    let (mut spread, mut numerical) = (InputSpread::default(), None);
    let own = value(own_run, own);
    let is_varied = |run: &BedLoad1dFlow| run.published() == own_run.published() && run.is_suspended() && !is_own(run);
    for (run, state) in of(records, is_varied) {
        let other = value(run, state);
        match run.inputs().into_iter().zip(own_run.inputs()).find(|(input, own)| input != own) {
            Some(((name, _), _)) => spread.add(name, own, other),
            None => numerical = Some((other - own).abs() / 3.0),
        }
    }
    let metric = metric.known_to(Origin::Input, Some(spread.standard()), &spread.words());
    metric.known_to(Origin::Numerical, numerical, "a third of the change with cells twice as high (second order)")
}

/// Root mean square of u_f less theirs over their largest `[%]`, from the level where grains have a speed over u_*.
fn duct_difference(run: &BedLoad1dFlow, state: &LayerState, resting: f64) -> f64 {
    let measured = &SHEET_FLOW_LOWEST_VELOCITY.points;
    let unit = run.stream().shear_velocity();
    let Some(level) = state.moves_above(resting * unit) else { return f64::NAN };
    let at = |height: f64| state.at(level + height * run.grain_diameter).fluid_velocity / unit;
    let squares: f64 = measured.iter().map(|&(height, u)| (at(height) - u) * (at(height) - u)).sum();
    let largest = measured.iter().fold(0.0_f64, |most, point| most.max(point.1));
    100.0 * (squares / measured.len() as f64).sqrt() / largest
}

/// Velocity of the duct, transport of the slopes, and how fast grains settle.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let measured = &*SHEET_FLOW_LOWEST_VELOCITY;
    for (run, state) in of(records, |run| run.published() == Some("duct")) {
        let metric = DUCT_VELOCITY_DIFFERENCE
            .of(&run.variant(), duct_difference(run, state, RESTING.0))
            .against(Some(0.0), &measured.source, measured.confidence)
            .with_snapshot_tolerance(1e-3, 0.0);
        if !is_own(run) {
            metrics.push(metric);
            continue;
        }
        let ends = [RESTING.1, RESTING.2].map(|speed| duct_difference(run, state, speed));
        let words = format!(
            "level where grains have {} to {} u_* instead of {}: {:.1} to {:.1} %",
            RESTING.1, RESTING.2, RESTING.0, ends[0], ends[1]
        );
        let value = |run: &BedLoad1dFlow, state: &LayerState| duct_difference(run, state, RESTING.0);
        let metric = with_spread(metric, records, (run, state), value);
        let by_level = Some((ends[0] - ends[1]).abs() / 12.0_f64.sqrt());
        metrics.push(metric.known_to(Origin::Digitisation, by_level, &words));
    }
    metrics
}
