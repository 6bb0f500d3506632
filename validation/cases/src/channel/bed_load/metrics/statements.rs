//! `stabilised` against what Kazemi et al. state of the flow, and against the transport formula on the slope held out.

use super::*;
use crate::channel::ProfilePoint;
use crate::channel::bed_load::flow::FITTED;
use crate::channel::bed_load::profiles::LAYERS;
use crate::metric::MetricKind;
use crate::reference::bed_load::LAYER_STATEMENTS;
use crate::statistics::FittedValue;
use bagnold_solver::material::rheology::Rheology;

/// The gentler slope that the paper makes statements of, whose profile and transport are judged `[-]`.
const GENTLE: f64 = 0.03;
/// The steeper one, with more transport `[-]`.
const STEEP: f64 = 0.05;

/// Whether a run is of the default numerics on a slope `[-]`.
fn is_stabilised(run: &BedLoadFlow, slope: f64) -> bool {
    run.formulation == BedLoadFormulation::Stabilised && (run.slope / slope - 1.0).abs() < 1e-9
}

/// Says that nothing is judged by the paper's statements, for want of a run of their slope.
pub(super) fn say_what_is_missing(records: &[BedLoadRecord]) {
    let mut stabilised = records.iter().filter(|(run, _)| run.formulation == BedLoadFormulation::Stabilised).peekable();
    if stabilised.peek().is_some() && !stabilised.any(|(run, _)| is_stabilised(run, GENTLE)) {
        tracing::warn!(
            "no run of `stabilised` has the slope {GENTLE} of the paper's statements: its profile and transport get no verdict"
        );
    }
}

/// Metrics of a run of one particle a grain by the default numerics.
pub(super) fn stabilised(records: &[BedLoadRecord], record: &BedLoadRecord) -> Vec<Metric> {
    let (run, Recorded { data, .. }) = record;
    let variant = run.variant();
    let forgotten = has_forgotten(records, run);
    let judged = forgotten && is_stabilised(run, GENTLE);
    let gate = |limit: Limit| judged.then_some(limit);
    let observed = |quantity, estimate, factor| channel::observed(quantity, &variant, estimate, factor);
    let stated = |metric: Metric, value: Option<f64>, statement: &str| {
        metric.against(value, &format!("statement of the paper: {statement}"), Confidence::Medium)
    };
    let mut metrics = balances(record);
    metrics.extend(common(record, forgotten));
    // of the fitted slopes the transport says nothing
    if judged && run.particles.material == Rheology::CoulombBingham(FITTED) {
        let ratio = observed(TRANSPORT_RATIO, data.mean_transport(), 1.0 / run.formula_transport());
        metrics.push(over_formula(ratio).of_kind(MetricKind::Validation));
    }
    let profile = &data.channel.profile;
    metrics.extend(LAYERS.map(|(lower, upper)| {
        let estimate = profile.estimate(|points| profiles::semi_log_slope(run, points, lower, upper));
        let named = variant.clone().and("height", format!("{}..{}", 1e3 * lower, 1e3 * upper));
        channel::observed(SEMI_LOG_SLOPE, &named, estimate, 1.0).exactly(1.0, "u_*/κ, fitted to u over ln(z + z_0)")
    }));
    metrics.push(number_of_layers(run, data));
    let is_at_rest =
        |(other, _): &&BedLoadRecord| other.formulation == BedLoadFormulation::AtRest && other.slope == run.slope;
    if let Some((_, rest)) = records.iter().find(is_at_rest) {
        let rest = &rest.data.channel.profile;
        // the errors of both means are independent
        let difference = |of: &dyn Fn(&[ProfilePoint]) -> f64| {
            let [own, rest] = [profile, rest].map(|profile| profile.estimate(of));
            let error = own.standard_error.hypot(rest.standard_error);
            FittedValue { value: own.value - rest.value, standard_error: error }
        };
        let (low, middle) = (2.5e-3, 0.5 * run.depth);
        let at = |height: f64| move |points: &[ProfilePoint]| profiles::velocity_at(run, points, height);
        let relative = |points: &[ProfilePoint]| at(low)(points) - at(middle)(points);
        let near = observed(NEAR_BED_DEFICIT, difference(&at(low)), 1.0);
        let far = observed(OUTER_DEFICIT, difference(&at(middle)), 1.0);
        let relative = observed(RELATIVE_DEFICIT, difference(&relative), 1.0);
        let ratios = [profile, rest].map(|profile| profiles::slope_ratio(run, &profile.points()).unwrap_or(f64::NAN));
        let ratio = LAYER_SLOPE_RATIO.of(&variant, ratios[0] / ratios[1]).with_snapshot_tolerance(0.1, 0.0);
        metrics.extend([
            stated(ratio, None, "gentler where grains move than above")
                .gated_by(gate(Limit::AtMost(0.8)), "0.8: at least a fifth gentler than over the bed at rest"),
            stated(near, None, "near the bed slower than without moving grains"),
            stated(far, Some(0.0), "above as fast as without moving grains").gated_by(
                gate(Limit::Within(-0.25, 0.25)),
                "0.25 u_* (friction velocity): 2 % of the depth-averaged velocity",
            ),
            stated(relative, None, "near the bed slower than without moving grains, above as fast").gated_by(
                gate(Limit::AtMost(-0.1)),
                "0.1 u_* slower near the bed than above; a flow slow at all heights fails",
            ),
        ]);
    }
    // particles of grains are too few for a curvature
    metrics.extend(grains(&variant, run, data, false));
    let ratio = DRAG_TOP_RATIO.of(&variant, profiles::drag_top_ratio(&data.drag_profile()));
    metrics.push(stated(ratio, None, "less drag on the topmost grains than below").with_snapshot_tolerance(0.1, 0.0));
    metrics
}

/// Number of layers that a segmented regression finds. It judges nothing: lines are added as long as the information criterion gains
/// by them, and on a mean profile, whose misfit is a curve and no noise, it finds three whatever the slope.
fn number_of_layers(run: &BedLoadFlow, data: &BedLoadObservation) -> Metric {
    let count = profiles::number_of_layers(run, &data.channel.profile.points());
    // of 2 % the paper says nothing
    let published = LAYER_STATEMENTS.iter().find(|statement| statement.slope == run.slope);
    NUMBER_OF_LAYERS
        .of(&run.variant(), count as f64)
        .against(
            published.map(|statement| statement.layers),
            "statement of the paper: two layers at 3 %, three at 5 %",
            published.map_or(Confidence::Medium, |statement| statement.confidence),
        )
        // a break more or less is no drift of the flow
        .with_snapshot_tolerance(0.0, 1.0)
}

/// More transport at 5 % than at 3 %, of flows that have forgotten their start.
pub(super) fn growth(records: &[BedLoadRecord]) -> Option<Metric> {
    let is_judged = |run: &BedLoadFlow| is_fastest(records, run) && has_forgotten(records, run);
    let of = |slope| records.iter().find(|(run, _)| is_stabilised(run, slope) && is_judged(run));
    let ((low, gentle), (high, steep)) = of(GENTLE).zip(of(STEEP))?;
    let variant = Variant::of("formulation", "stabilised").and("slope", Value::list([low.slope, high.slope]));
    let expected = high.formula_transport() / low.formula_transport();
    let transport = steep.data.mean_transport().value / gentle.data.mean_transport().value;
    let metric = TRANSPORT_GROWTH
        .of(&variant, transport)
        .against(Some(expected), "statement of the paper: larger at 5 % than at 3 %", Confidence::Medium)
        .with_snapshot_tolerance(0.05, 0.0)
        .gated(
            Limit::Within(MEASURED_BAND.0 * expected, MEASURED_BAND.1 * expected),
            "a factor of two about the formula's growth: measured rates scatter by as much",
        );
    Some(metric)
}
