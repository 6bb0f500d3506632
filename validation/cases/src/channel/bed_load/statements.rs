//! `stabilised` against what Kazemi et al. state of the flow, and against the transport formula on the slope held out.

use super::BedLoadRecord;
use super::metrics::{balances, common, grains, has_forgotten};
use super::observation::BedLoadObservation;
use super::parameters::GrainParticles;
use super::profiles::{self, LAYERS};
use super::quantities::{
    DRAG_TOP_RATIO, LAYER_BORDER, LAYER_SLOPE, LAYER_SLOPE_RATIO, NEAR_BED_DEFICIT, NUMBER_OF_LAYERS, OUTER_DEFICIT,
    RELATIVE_DEFICIT, SEMI_LOG_SLOPE, SHEARED_FROM, SHEARED_THICKNESS_GROWTH, SHEARED_UP_TO, TRANSPORT_GROWTH,
    TRANSPORT_RATIO,
};
use super::run::{BedLoadRun, GrainKind};
use super::tiers::FITTED;
use crate::case::Run;
use crate::channel::{self, ProfilePoint};
use crate::metric::{Confidence, Limit, Metric, MetricKind, Quantity, Value, Variant};
use crate::observation::Recorded;
use crate::reference::bed_load::{LAYER_STATEMENTS, MEASURED_BAND, TransportFormula};
use crate::statistics::{FittedValue, Segmented};
use bagnold_solver::material::rheology::Rheology;

/// A slope `[-]` that the paper makes statements of.
struct Stated {
    slope: f64,
}

/// The gentler slope, whose profile and transport are judged.
const GENTLE: Stated = Stated { slope: 0.03 };
/// The steeper slope, with more transport and a thicker sheared layer.
const STEEP: Stated = Stated { slope: 0.05 };

impl Stated {
    /// Whether a run is of this slope.
    fn is_of(&self, run: &BedLoadRun) -> bool {
        (run.slope / self.slope - 1.0).abs() < 1e-9
    }
}

/// Says that nothing is judged by the paper's statements, for want of a run of their slope.
pub(super) fn say_what_is_missing(records: &[BedLoadRecord]) {
    let runs = || records.iter().map(|(run, _)| run);
    let of_the_recipe = || runs().filter(|run| run.formulation.kind() == Some(GrainKind::Stabilised));
    if of_the_recipe().next().is_some() && !of_the_recipe().any(|run| GENTLE.is_of(run)) {
        tracing::warn!(
            "no run of `stabilised` has the slope {} that the paper's statements are of: its profile and transport are \
             observed, but not judged",
            GENTLE.slope
        );
    }
}

pub(super) fn stabilised(
    metrics: &mut Vec<Metric>,
    records: &[BedLoadRecord],
    run: &BedLoadRun,
    record: &Recorded<BedLoadObservation>,
    bed: &GrainParticles,
) {
    let (variant, data) = (run.variant(), &record.data);
    balances(metrics, run, record);
    let forgotten = has_forgotten(records, run);
    common(metrics, run, record, forgotten);
    let judged = forgotten && GENTLE.is_of(run);
    let observed = |quantity, estimate, factor| channel::observed(quantity, &variant, estimate, factor);
    // of the fitted slopes the transport says nothing
    if judged && bed.material == Rheology::CoulombBingham(FITTED) {
        let formula = TransportFormula::WongParker;
        let reference = formula.transport(run.stream().shields_number());
        let ratio = observed(TRANSPORT_RATIO, data.channel.average(&data.transport), 1.0 / reference);
        let reason = "yield stress and viscosity are fitted to the two other slopes";
        let metric = ratio.against(Some(1.0), formula.name(), formula.confidence()).of_kind(MetricKind::Validation);
        metrics.push(metric.gated(Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1), reason));
    }
    let gate = |limit: Limit| judged.then_some(limit);
    let profile = &data.channel.profile;
    for (lower, upper) in LAYERS {
        let estimate = profile.estimate(|points| profiles::semi_log_slope(run, points, lower, upper));
        let named = variant.clone().and("height", 1e3 * lower..=1e3 * upper);
        let slope = channel::observed(SEMI_LOG_SLOPE, &named, estimate, 1.0);
        metrics.push(slope.exactly(1.0, "u_*/κ, fitted to u over ln(z + z_0)"));
    }
    let stated = |metric: Metric, value: Option<f64>, statement: &str| {
        metric.against(value, &format!("statement of the paper: {statement}"), Confidence::Medium)
    };
    layers(metrics, run, record);
    let is_at_rest =
        |(other, _): &&BedLoadRecord| other.formulation.kind() == Some(GrainKind::AtRest) && other.slope == run.slope;
    if let Some((_, rest)) = records.iter().find(is_at_rest) {
        let rest = &rest.data.channel.profile;
        // the errors of both means are independent
        let difference = |of: &dyn Fn(&[ProfilePoint]) -> f64| {
            let [own, rest] = [profile, rest].map(|profile| profile.estimate(of));
            let error = own.standard_error.hypot(rest.standard_error);
            FittedValue { value: own.value - rest.value, standard_error: error }
        };
        let (low, middle) = (2.5e-3, 0.5 * run.materials.depth);
        let at = |height: f64| move |points: &[ProfilePoint]| profiles::velocity_at(run, points, height);
        let relative = |points: &[ProfilePoint]| at(low)(points) - at(middle)(points);
        let near = observed(NEAR_BED_DEFICIT, difference(&at(low)), 1.0);
        let far = observed(OUTER_DEFICIT, difference(&at(middle)), 1.0);
        let relative = observed(RELATIVE_DEFICIT, difference(&relative), 1.0);
        let ratios = [profile, rest].map(|profile| profiles::slope_ratio(run, &profile.points()).unwrap_or(f64::NAN));
        let ratio = LAYER_SLOPE_RATIO.of(&variant, ratios[0] / ratios[1]).with_snapshot_tolerance(0.1, 0.0);
        metrics.extend([
            stated(ratio, None, "gentler where grains move than above")
                .gated_by(gate(Limit::AtMost(0.8)), "gentler by a fifth than above the same bed at rest"),
            stated(near, None, "near the bed slower than without moving grains"),
            stated(far, Some(0.0), "above as fast as without moving grains").gated_by(
                gate(Limit::Within(-0.25, 0.25)),
                "a quarter of u_*, as clear water itself is judged: 2 % of the depth mean",
            ),
            stated(relative, None, "near the bed slower than without moving grains, above as fast").gated_by(
                gate(Limit::AtMost(-0.1)),
                "slower near the bed than above by a tenth of u_*, so that a flow that is slow as a whole does not show it",
            ),
        ]);
    }
    let above = profile.estimate(|points| profiles::sheared_borders(run, points).1);
    let below = profile.estimate(|points| profiles::sheared_borders(run, points).0);
    metrics.extend([observed(SHEARED_UP_TO, above, 1e3), observed(SHEARED_FROM, below, 1e3)]);
    // particles of grains are too few for a curvature
    grains(metrics, run, data, false);
    let ratio = DRAG_TOP_RATIO.of(&variant, profiles::drag_top_ratio(&data.drag_profile()));
    metrics.push(stated(ratio, None, "less drag on the topmost grains than below").with_snapshot_tolerance(0.1, 0.0));
}

/// The layers that a segmented regression finds, with the errors of their slopes and borders. Their number judges nothing: lines are
/// added as long as the information criterion gains by them, and on a mean profile, whose misfit is a curve and no noise, it finds
/// three whatever the slope.
fn layers(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let variant = run.variant();
    let profile = &record.data.channel.profile;
    let count = profiles::number_of_layers(run, &profile.points());
    // of 2 % the paper says nothing
    let published = LAYER_STATEMENTS.iter().find(|statement| statement.slope == run.slope);
    metrics.push(
        NUMBER_OF_LAYERS
            .of(&variant, count as f64)
            .against(
                published.map(|statement| statement.layers),
                "statement of the paper: two layers at 3 %, three at 5 %",
                published.map_or(Confidence::Medium, |statement| statement.confidence),
            )
            // a break more or less is no drift of the flow
            .with_snapshot_tolerance(0.0, 1.0),
    );
    let scale = run.clear_water().semi_logarithmic_slope() / run.clear_water().friction_velocity();
    for layer in 0..count {
        let of = |read: &dyn Fn(&Segmented) -> f64| {
            profile.estimate(|points| profiles::layers(run, points, count).map_or(f64::NAN, |fit| read(&fit)))
        };
        let named = variant.clone().and("layer", layer + 1);
        let slope = of(&|fit| fit.slopes[layer] / scale);
        metrics.push(channel::observed(LAYER_SLOPE, &named, slope, 1.0).exactly(1.0, "u_*/κ"));
        if layer + 1 < count {
            let border = of(&|fit| profiles::height_of(run, fit.breaks[layer]));
            metrics.push(channel::observed(LAYER_BORDER, &named, border, 1.0 / run.materials.grain_diameter));
        }
    }
}

/// More transport and a thicker sheared layer at 5 % than at 3 %, of flows that have forgotten their start.
pub(super) fn growth(metrics: &mut Vec<Metric>, records: &[BedLoadRecord]) {
    let pair = |is_own: &dyn Fn(&BedLoadRun) -> bool| {
        let of = |stated: Stated| records.iter().find(|(run, _)| stated.is_of(run) && is_own(run));
        of(GENTLE).zip(of(STEEP))
    };
    let stabilised =
        |run: &BedLoadRun| run.formulation.kind() == Some(GrainKind::Stabilised) && has_forgotten(records, run);
    if let Some((gentle, steep)) = pair(&stabilised) {
        metrics.push(transport_growth(gentle, steep));
        // the thickness of one row of grains is the grains', whatever the slope
        metrics.push(thickness_growth("stabilised", gentle, steep));
    }
}

/// Variant and reference of a growth from one slope to the other.
fn grown(quantity: Quantity, formulation: &str, slopes: [f64; 2], value: f64, expected: Option<f64>) -> Metric {
    let variant = Variant::of("formulation", formulation).and("slope", Value::list(slopes));
    quantity
        .of(&variant, value)
        .against(expected, "statement of the paper: larger at 5 % than at 3 %", Confidence::Medium)
        .with_snapshot_tolerance(0.05, 0.0)
}

fn thickness_growth(formulation: &str, (low, gentle): &BedLoadRecord, (high, steep): &BedLoadRecord) -> Metric {
    let thickness = |run: &BedLoadRun, record: &Recorded<BedLoadObservation>| {
        let (lower, upper) = profiles::sheared_borders(run, &record.data.channel.profile.points());
        upper - lower
    };
    let growth = thickness(high, steep) / thickness(low, gentle);
    grown(SHEARED_THICKNESS_GROWTH, formulation, [low.slope, high.slope], growth, None)
}

fn transport_growth((low_run, low): &BedLoadRecord, (high_run, high): &BedLoadRecord) -> Metric {
    let transport = |record: &Recorded<BedLoadObservation>| record.data.channel.average(&record.data.transport).value;
    let formula = |run: &BedLoadRun| TransportFormula::WongParker.transport(run.stream().shields_number());
    let expected = formula(high_run) / formula(low_run);
    let growth = transport(high) / transport(low);
    grown(TRANSPORT_GROWTH, "stabilised", [low_run.slope, high_run.slope], growth, Some(expected)).gated(
        Limit::Within(MEASURED_BAND.0 * expected, MEASURED_BAND.1 * expected),
        "a factor of two about the growth of the formula, by which measured rates scatter",
    )
}
