//! How the case is judged.

use super::start_stop::REFERENCE_CELLS;
use super::{
    FlowThicknessParameters, FlowThicknessRecord, FlowThicknessRun, StartStop, StartStopRun, SteadyRun, collapses,
    flows_of, searches,
};
use crate::case::Run;
use crate::collapse::metrics::conservation;
use crate::collapse::metrics::quantities::{MOMENTUM_RESIDUAL, PARTICLES_LOST};
use crate::layer::LayerObservation;
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity, Variant, quantities};
use crate::reference::collapse::RoughIncline;
use crate::reference::grains::GLASS_BEADS_FLOW_RULE;
use crate::setup::energy_ledger::{self, EnergyScale};
use crate::statistics::mean;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::material::rheology::field::FieldBoundary;

quantities! {
    [PARTICLES_LOST, MOMENTUM_RESIDUAL, energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    LARGEST_THICKNESS: stated("largest_thickness", "cm", "largest thickness of the flow at a station"),
    STOPPING_ANGLE: verified("stopping_angle", "°", "slope at which a layer stops"),
    EXPERIMENTAL_EXCESS:
        validated("experimental_excess", "°", "measured minus computed stopping slope"),
    FLOW_COEFFICIENT: verified("flow_coefficient", "-", "β of (42) from the steady flows"),
    PROFILE_L2: verified("profile_l2", "%", "relative L2 error of the velocity profile of a steady flow under the nonlocal law"),
    FLUIDITY_FROUDE: verified("froude_number", "-", "depth mean of the velocity over √(gh) of a steady flow under the nonlocal law"),
    FLOW_COEFFICIENT_PUBLISHED:
        verified("flow_coefficient_published", "-", "β of (42) from the steady flows, against the published β from which the I_0 of the beads follows by (41)"),
}

/// Part of a steady flow's time series that its mean velocity is taken over, the last `[-]`.
const WINDOW: f64 = 0.3;

pub(super) fn all(parameters: &FlowThicknessParameters, records: &[FlowThicknessRecord]) -> Vec<Metric> {
    let Some(incline) = incline(parameters) else { return Vec::new() };
    let mut metrics = thicknesses(&incline, parameters, records);
    metrics.extend(searches(records).flat_map(|(run, found)| stopping(&incline, run, found)));
    metrics.extend(flow_rule(&incline, parameters, records));
    metrics.extend(flows_of(records, true).flat_map(|(run, data)| profile(run, data)));
    metrics
}

/// The incline that the grains make rough; they are those of μ(I), as the parameters were checked to be.
pub(super) fn incline(parameters: &FlowThicknessParameters) -> Option<RoughIncline> {
    let Rheology::MuI(grains) = &parameters.collapse.material else { return None };
    Some(RoughIncline {
        length_scale: parameters.deposit_length * grains.grain_diameter,
        static_friction: grains.static_friction,
        limiting_friction: grains.limiting_friction,
    })
}

/// Part (i): the thickness of the flow at the stations.
fn thicknesses(
    incline: &RoughIncline,
    parameters: &FlowThicknessParameters,
    records: &[FlowThicknessRecord],
) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, data) in collapses(records) {
        metrics.extend(conservation(&run.variant(), &data.collapse, &run.numerics, EnergyScale::Fall));
        let law = incline.flow_thickness(run.initial_height, run.slope_angle.to_radians());
        let source = "h_s of (44) as reconstructed: the paper's estimate of the flow's thickness";
        for &station in &parameters.stations {
            let history = data.thickness_at(station / run.reservoir_length);
            let largest = history.iter().fold(0.0_f64, |most, &h| most.max(h)) * run.reservoir_length;
            // 0 where the front did not come so far
            if largest != 0.0 {
                let variant = Variant::of("station", station).followed_by(&run.variant());
                let metric = LARGEST_THICKNESS.of(&variant, 100.0 * largest).with_snapshot_tolerance(1e-3, 1e-3);
                metrics.push(metric.against(law.map(|law| 100.0 * law), source, Confidence::Medium));
            }
        }
    }
    metrics
}

/// Part (ii): the slope at which a layer stops.
fn stopping(incline: &RoughIncline, run: &StartStopRun, found: &StartStop) -> [Metric; 3] {
    let variant = FlowThicknessRun::StartStop(run.clone()).variant();
    let lost = found.trials.iter().map(|trial| trial.lost).sum::<usize>();
    let local = libm::atan(run.layer.material.static_friction).to_degrees();
    // the slope of the layer does not enter its stopping angle
    let nonlocal = run.layer.exact(0.0).map(|layer| layer.stopping_angle().to_degrees());
    let (exact, source) = match nonlocal {
        Some(angle) => {
            (angle, "slope below which the first mode of the fluidity decays, an exact statement of the nonlocal law")
        }
        None => (local, "arctan μ_s: the local μ(I) law, whatever the thickness"),
    };
    // a bracket of this width has its middle within half of it of the true angle
    let (limit, reason) = if nonlocal.is_some() {
        (0.5 * run.tolerance, "half the width of the bracket: the layer stops at its lower and flows at its upper end")
    } else {
        (
            run.tolerance,
            "the width of the bracket: its middle lies within half of it of the true angle, the rest is the solver's",
        )
    };
    // which condition holds at a free surface experiments say, not the model: they favour that under which the fluidity vanishes
    let judged = run.layer.nonlocal.is_none_or(|choice| choice.surface == FieldBoundary::Vanishing);
    let bracket = found.bracket();
    let measured = bracket.map_or(f64::NAN, |(stops, flows)| 0.5 * (stops + flows));
    let experiment = incline.stopping_angle(run.layer.layer.layer_height).to_degrees();
    [
        PARTICLES_LOST
            .of(&variant, lost as f64)
            .exactly(0.0, "no particle passes the bed")
            .gated(Limit::AtMost(0.0), "grains do not vanish"),
        STOPPING_ANGLE
            .of(&variant, measured)
            .with_snapshot_tolerance(0.0, 1e-6)
            .exactly(exact, source)
            .gated(Limit::Within(exact - limit, exact + limit), reason),
        EXPERIMENTAL_EXCESS.of(&variant, experiment - measured).with_snapshot_tolerance(0.0, 1e-6).against(
            None,
            "Forterre & Pouliquen 2003, the slope at which h_stop(θ) = L (μ_2 − tanθ)/(tanθ − μ_s), a fit to experiments, equals the \
             thickness, less the angle found: what a local law does not know, and the nonlocal one knows but for the exponent of its h_stop",
            GLASS_BEADS_FLOW_RULE.confidence,
        )
        .known_to(
            Origin::Numerical,
            bracket.map(|(stops, flows)| (flows - stops) / 12.0_f64.sqrt()),
            "the angle found is the middle of a bracket: an even spread of its width",
        )
        .gated_by(
            judged.then_some(Limit::Within(-0.5, 0.5)),
            "half a degree, to which angles of repose are measured; a law without a length cannot stop a thin layer on a \
             steeper slope, and the h_stop of the nonlocal law rises as (θ − θ_s)^(−1/2) instead of (θ − θ_s)^(−1)",
        ),
    ]
}

/// The profile of a steady flow under the nonlocal law, against the solution without particles.
fn profile(run: &SteadyRun, data: &LayerObservation) -> Vec<Metric> {
    let Some(layer) = run.layer.exact(run.slope_angle) else { return Vec::new() };
    let Ok(exact) = layer.steady(REFERENCE_CELLS) else { return Vec::new() };
    let variant = FlowThicknessRun::Steady(run.clone()).variant();
    let error = 100.0 * data.profile.velocity_l2(|height| exact.velocity(height));
    let froude = exact.depth_mean() / (run.layer.layer.gravity * run.layer.layer.layer_height).sqrt();
    let allowed = 20.0 / run.layer.layer.resolution as f64;
    vec![
        PROFILE_L2
            .of(&variant, error)
            .with_snapshot_tolerance(2e-2, 1e-3)
            .exactly(0.0, "steady solution of the nonlocal law in finite volumes over 4000 cells, without particles")
            .gated(
                Limit::AtMost(allowed),
                "1 % at 20 rows and half of it at twice as many: near h_stop an error of 0.1 % of the friction coefficient is one of 1.2 % of the velocity",
            ),
        FLUIDITY_FROUDE
            .of(&variant, froude_number(run, data))
            .with_snapshot_tolerance(1e-2, 0.0)
            .exactly(froude, "the same solution"),
    ]
}

/// Depth mean of the velocity over √(gh) of a steady flow, over its last part `[-]`.
pub(super) fn froude_number(run: &SteadyRun, data: &LayerObservation) -> f64 {
    let means = &data.series.mean_velocity;
    let window = &means[means.len() - ((WINDOW * means.len() as f64) as usize).clamp(1, means.len())..];
    mean(window) / (run.layer.layer.gravity * run.layer.layer.layer_height).sqrt()
}

/// h/h_stop(θ) of a steady flow `[-]`.
pub(super) fn relative_thickness(incline: &RoughIncline, run: &SteadyRun) -> Option<f64> {
    incline.deposit_thickness(run.slope_angle.to_radians()).map(|h| run.layer.layer.layer_height / h)
}

/// Part (iii): β of (42) from the steady flows.
fn flow_rule(
    incline: &RoughIncline,
    parameters: &FlowThicknessParameters,
    records: &[FlowThicknessRecord],
) -> Vec<Metric> {
    let (mut xx, mut xy, mut count) = (0.0, 0.0, 0);
    let mut expected = 0.0;
    for (run, data) in flows_of(records, false) {
        let Some(relative) = relative_thickness(incline, run) else { continue };
        let froude = froude_number(run, data);
        // relative residuals: every flow counts the same
        (xx, xy, count) = (xx + 1.0, xy + froude / relative, count + 1);
        let grains = &run.layer.material;
        // (41) solved for β at this slope
        expected += 0.4 * grains.reference_inertia * incline.length_scale / grains.grain_diameter
            * (run.layer.solid_fraction * libm::cos(run.slope_angle.to_radians())).sqrt();
    }
    if count == 0 {
        return Vec::new();
    }
    let (measured, expected) = (xy / xx, expected / f64::from(count));
    let of = |quantity: Quantity| quantity.of(&Variant::default(), measured).with_snapshot_tolerance(2e-3, 0.0);
    let (published, confidence) = (parameters.flow_coefficient, GLASS_BEADS_FLOW_RULE.confidence);
    vec![
        of(FLOW_COEFFICIENT)
            .exactly(expected, "(41) solved for β at the slopes of the flows: an identity of the law")
            .gated(
                Limit::Within(0.97 * expected, 1.03 * expected),
                "3 %: an error of 0.1 % of the friction coefficient is one of 0.8 % (25°) to 2 % (22°) of the velocity",
            ),
        of(FLOW_COEFFICIENT_PUBLISHED).against(Some(published), "Table 1, β of glass beads", confidence).gated(
            Limit::Within(0.95 * published, 1.05 * published),
            "5 %: the beads' I_0 follows from this β by (41) at 25°, so that the flows give it back by an identity of the law and no \
             experiment is met; β is printed as 0.136, √cosθ varies by 1 % over the slopes, and an error of 0.1 % of the friction \
             coefficient is one of up to 2 % of β",
        ),
    ]
}
