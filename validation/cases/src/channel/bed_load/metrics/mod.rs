//! How the runs are judged: each by its formulation, all together by statements and fits.

mod continuum;
mod kept;
mod statements;

pub(super) use kept::SteadyFlow;

use super::fit::{HeldOut, held_out};
use super::flow::{BedLoadFlow, BedLoadFormulation, StartState};
use super::observation::BedLoadObservation;
use super::{BedLoadRecord, profiles};
use crate::case::Flow;
use crate::channel;
use crate::metric::{Confidence, Limit, Metric, Quantity, Value, Variant, quantities};
use crate::observation::Recorded;
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};
use crate::shared::transport_in_units;
use crate::statistics::mean;

quantities! {
    [channel::PARTICLES_LOST, channel::VELOCITY_ITERATIONS, channel::PRESSURE_ITERATIONS, channel::MOMENTUM_RESIDUAL]
    TRANSPORT: validated("transport", "-", "q*, the rate of bed load in units of √((s − 1) g d³)"),
    PREDICTED_TRANSPORT: validated("predicted_transport", "-", "q* of grains that dilate, whose closures are not fitted to transport"),
    TRANSPORT_RATIO:
        verified("transport_ratio", "-", "q* over q* of the 1-D layer, or of the formula on the validation slope"),
    STREAM_VELOCITY:
        verified("stream_velocity", "-", "mean velocity of the water above the bed over that of the logarithmic law of a rough bed"),
    FORGETS_START: verified(
        "forgets_start", "-",
        "mean stream velocity: difference between runs from two starts, over that of the starts",
    ),
    STEADY_START: verified("steady_start", "-", "start over the kept state at which the stream would not change"),
    END_TIME: verified("end_time", "s", "end time of the printed set-up"),
    HIGHEST_PARTICLE: verified("highest_particle", "h", "greatest height of a particle of the printed set-up"),
    LAST_TRANSPORT: validated("last_transport", "-", "q* at the end of the printed set-up"),
    DECAY_LENGTH: verified(
        "decay_length", "mm",
        "e-folding length of the grain velocity below the top of the bed",
    ),
    MOVES_ABOVE: verified("moves_above", "mm", "lowest height at which grains are faster than 1 cm/s"),
    GRAIN_CURVATURE_ABOVE:
        stated("grain_curvature_above", "u_*/d²", "curvature of the grains' profile above the top of the bed"),
    GRAIN_CURVATURE_BELOW: stated("grain_curvature_below", "u_*/d²", "curvature of the grains' profile below the top of the bed"),
    DRAG_PEAK_HEIGHT: verified("drag_peak_height", "mm", "height of the largest drag on the grains"),
    DRAG_TOP_RATIO: stated("drag_top_ratio", "-", "drag on the topmost row of grains over the drag on the row below"),
    DRAG_RATIO: verified("drag_ratio", "-", "drag on the grains over the drag in the 1-D layer"),
    FLUID_VELOCITY_RMS:
        verified("fluid_velocity_rms", "u_*", "√⟨(u_f − u_layer)²⟩ over the depth"),
    FLUID_VELOCITY_MEAN:
        verified("fluid_velocity_mean", "-", "depth-averaged water velocity over that of the 1-D layer"),
    GRAIN_VELOCITY_RMS:
        verified("grain_velocity_rms", "u_*", "√⟨(u_s − u_layer)²⟩ over the moving grains"),
    HELD_OUT_TRANSPORT_RATIO:
        validated("held_out_transport_ratio", "-", "q* over q* of the formula on the validation slope"),
    FITTED_YIELD_STRESS: verified("fitted_yield_stress", "Pa", "yield stress that fits the other slopes"),
    FITTED_VISCOSITY: verified("fitted_viscosity", "Pa·s", "plastic viscosity that fits the other slopes"),
    FIT_AT_BORDER: verified("fit_at_border", "-", "1 where a fit lies on the border of the grid"),
    SEMI_LOG_SLOPE: verified(
        "semi_log_slope", "-",
        "slope of the water's velocity over ln(z + z_0) in a range of heights, over u_*/κ",
    ),
    LAYER_SLOPE_RATIO: stated("layer_slope_ratio", "-", "slope of the water's velocity over ln z next to the bed over that of the outer flow, over the same ratio above the same bed at rest"),
    NEAR_BED_DEFICIT:
        stated("near_bed_deficit", "u_*", "water velocity half a grain above the bed minus the velocity over the same bed with all grains fixed"),
    RELATIVE_DEFICIT: stated("relative_deficit", "u_*", "near-bed deficit minus outer deficit"),
    OUTER_DEFICIT: stated("outer_deficit", "u_*", "water velocity at half the depth minus the velocity over the same bed with all grains fixed"),
    NUMBER_OF_LAYERS: stated("number_of_layers", "-", "layers of different semi-logarithmic slope"),
    TRANSPORT_GROWTH: stated("transport_growth", "-", "q* on the steeper slope over that on the gentler"),
}

/// Share of the difference of two starts that may be left of it `[-]`.
const FORGOTTEN: f64 = 0.05;

pub(super) fn all(records: &[BedLoadRecord]) -> Vec<Metric> {
    let of_run = |record: &BedLoadRecord| match record.0.formulation {
        BedLoadFormulation::Paper => printed(record),
        BedLoadFormulation::Stabilised if is_fastest(records, &record.0) => statements::stabilised(records, record),
        BedLoadFormulation::Stabilised => balances(record).into_iter().chain([transport(record, false)]).collect(),
        BedLoadFormulation::AtRest => balances(record),
        BedLoadFormulation::Fit => vec![transport(record, true)],
        BedLoadFormulation::Porous | BedLoadFormulation::Frozen | BedLoadFormulation::Dilating => {
            continuum::of(record, has_forgotten(records, &record.0))
        }
    };
    let mut metrics: Vec<Metric> = records.iter().flat_map(of_run).collect();
    metrics.extend(records.iter().filter_map(|(run, _)| forgets_start(records, run)));
    metrics.extend(records.iter().flat_map(|record| kept::of_pair(records, record)));
    statements::say_what_is_missing(records);
    metrics.extend(statements::growth(records));
    let held_out = held_out(records);
    if held_out.is_empty() && records.iter().any(|(run, _)| run.formulation == BedLoadFormulation::Fit) {
        tracing::warn!(
            "nothing is fitted: runs of `fit` need all combinations of two yield stresses, two viscosities and three slopes"
        );
    }
    metrics.extend(held_out.iter().flat_map(of_fit));
    metrics
}

/// Transport that a fit to two slopes predicts on the third, and its parameters.
fn of_fit(held: &HeldOut) -> Vec<Metric> {
    let variant = Variant::of("held_out_slope", held.slope);
    let ratio = HELD_OUT_TRANSPORT_RATIO.of(&variant, held.ratio);
    let mut metrics = vec![over_formula(ratio).with_snapshot_tolerance(0.05, 0.0)];
    let values = [
        (FITTED_YIELD_STRESS, held.yield_stress),
        (FITTED_VISCOSITY, held.viscosity),
        (FIT_AT_BORDER, f64::from(u8::from(held.at_border))),
    ];
    metrics.extend(values.map(|(quantity, value)| quantity.of(&variant, value).with_snapshot_tolerance(0.1, 0.05)));
    metrics
}

/// Transport over that of the formula, by grains whose parameters are fitted on other slopes.
fn over_formula(ratio: Metric) -> Metric {
    let formula = TransportFormula::WongParker;
    let reason = "scatter of measured rates; yield stress and viscosity are fitted to the other two slopes";
    let ratio = ratio.against(Some(1.0), formula.name(), formula.confidence());
    ratio.gated(Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1), reason)
}

/// A metric against the transport formula at the Shields number of a run.
fn by_formula(metric: Metric, run: &BedLoadFlow) -> Metric {
    let formula = TransportFormula::WongParker;
    metric.against(Some(run.formula_transport()), formula.name(), formula.confidence())
}

/// The transport, beside the formula where the run has forgotten its start.
fn transport((run, record): &BedLoadRecord, forgotten: bool) -> Metric {
    let mean = record.data.mean_transport();
    let in_units = transport_in_units(&run.stream(), mean.value, mean.standard_error, "the mean over time");
    let rate = channel::observed(TRANSPORT, &run.variant(), mean, 1.0).remarked(in_units);
    if forgotten { by_formula(rate, run) } else { rate }
}

/// Balances of a run of one particle a grain.
fn balances((run, record): &BedLoadRecord) -> Vec<Metric> {
    let (variant, outer) = (run.variant(), record.clone().map(|data| data.channel));
    vec![channel::particles_lost(&variant, &outer), channel::momentum_residual(&variant, &outer)]
}

/// What every run reports.
fn common(record: &BedLoadRecord, forgotten: bool) -> Vec<Metric> {
    let (run, Recorded { data, .. }) = record;
    let variant = run.variant();
    let mean = run.clear_water().mean_velocity();
    let velocity = data.channel.average(&data.stream_velocity);
    let mut metrics = vec![
        transport(record, forgotten),
        channel::observed(STREAM_VELOCITY, &variant, velocity, 1.0 / mean)
            .exactly(1.0, "the logarithmic law of a rough bed"),
    ];
    metrics.extend(channel::iterations(&variant, &data.channel, [None; 2]));
    metrics
}

/// Whether no run that differs from it in its start alone starts faster: the others show only whether the start is forgotten.
pub(super) fn is_fastest(records: &[BedLoadRecord], run: &BedLoadFlow) -> bool {
    !records.iter().any(|(other, _)| run.has_another_start_than(other) && other.start() > run.start())
}

/// A run with the one that differs from it in its start, and the share of their difference that is left in the stream's mean velocity
/// over the averaging window `[-]`; none without such a run.
fn memory<'r>(records: &'r [BedLoadRecord], run: &BedLoadFlow) -> Option<(&'r BedLoadFlow, f64)> {
    let (_, own) = records.iter().find(|(other, _)| other.variant() == run.variant())?;
    let (other_run, other) = records.iter().find(|(other, _)| run.has_another_start_than(other))?;
    let mean = |data: &BedLoadObservation| data.channel.average(&data.stream_velocity).value;
    let first = |data: &BedLoadObservation| data.stream_velocity.first().copied();
    let share = (mean(&own.data) - mean(&other.data)) / (first(&own.data)? - first(&other.data)?);
    Some((other_run, share.abs()))
}

/// Whether a run has forgotten its start; transport and profiles are judged of such runs only.
pub(super) fn has_forgotten(records: &[BedLoadRecord], run: &BedLoadFlow) -> bool {
    memory(records, run).is_some_and(|(_, share)| share <= FORGOTTEN)
}

/// Memory of the start, a gate for each pair of runs, under the name of the faster start.
fn forgets_start(records: &[BedLoadRecord], run: &BedLoadFlow) -> Option<Metric> {
    // pairs from a kept state are judged before they have met
    let is_long = run.continuum.start_state == StartState::Layer;
    let (_, share) = memory(records, run).filter(|(other, _)| is_long && run.start() > other.start())?;
    Some(
        FORGETS_START
            .of(&run.variant(), share)
            .against(Some(0.0), "a steady flow does not depend on its start", Confidence::Exact)
            .gated(
                Limit::AtMost(FORGOTTEN),
                "5 %: starts differ by half the velocity, which leaves 0.25 u_*, the limit of the profile",
            )
            .with_snapshot_tolerance(0.02, 0.005),
    )
}

/// Relative change of the stream's velocity over U/(2 g i) `[-]`.
fn drift(run: &BedLoadFlow, data: &BedLoadObservation) -> f64 {
    let channel = &data.channel;
    let mean = mean(&channel.series.within(&data.stream_velocity, channel.window));
    let adjustment = mean / (2.0 * run.gravity * run.slope);
    channel.trend(&data.stream_velocity) * adjustment / mean
}

/// The printed set-up: no gate, what it does is the result.
fn printed((run, record): &BedLoadRecord) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data);
    let highest = data.channel.series.highest.iter().copied().fold(0.0, f64::max);
    let last = LAST_TRANSPORT.of(&variant, data.transport.last().copied().unwrap_or(f64::NAN));
    vec![
        END_TIME.of(&variant, record.simulated_time).with_snapshot_tolerance(0.05, 0.0),
        HIGHEST_PARTICLE.of(&variant, highest).exactly(1.0, "the depth of the water").with_snapshot_tolerance(0.1, 0.0),
        by_formula(last, run).with_snapshot_tolerance(0.2, 1e-3),
    ]
}

/// Metrics of the grains; of flows that have forgotten their start the shape of their profile is judged by the paper's statement.
fn grains(variant: &Variant, run: &BedLoadFlow, data: &BedLoadObservation, judged: bool) -> Vec<Metric> {
    let layer = data.layer.as_ref();
    let points = data.sediment.points();
    let (decays, moves) = (profiles::decay_length(&points), profiles::moves_above(&points, 0.01));
    let values = [
        (DECAY_LENGTH, decays, layer.and_then(|layer| layer.decay_length(1e-4))),
        (MOVES_ABOVE, moves, layer.and_then(|layer| layer.moves_above(0.01))),
    ];
    let in_millimetres = |(quantity, value, reference): (Quantity, f64, Option<f64>)| {
        let metric = quantity.of(variant, 1e3 * value).with_snapshot_tolerance(0.1, 0.5);
        match reference {
            Some(reference) => metric.exactly(1e3 * reference, "the 1-D layer"),
            None => metric,
        }
    };
    let mut metrics = values.map(in_millimetres).to_vec();
    let curvatures =
        [(GRAIN_CURVATURE_ABOVE, true, Limit::AtMost(0.0)), (GRAIN_CURVATURE_BELOW, false, Limit::AtLeast(0.0))];
    metrics.extend(curvatures.map(|(quantity, above, limit)| {
        let estimate = data.sediment.estimate(|points| profiles::grain_curvature(run, points, above));
        let source = "statement of the paper: concave above the top of the bed (−), convex below (+)";
        channel::observed(quantity, variant, estimate, 1.0).against(None, source, Confidence::Medium).gated_by(
            judged.then_some(limit),
            "0: the paper states only the curvature's sign; profiles with too few points fail",
        )
    }));
    let drag = data.drag_profile();
    let peak = drag
        .iter()
        .copied()
        .fold((f64::NAN, f64::NEG_INFINITY), |best, point| if point.1 > best.1 { point } else { best });
    metrics.push(DRAG_PEAK_HEIGHT.of(variant, 1e3 * peak.0).with_snapshot_tolerance(0.1, 1.0));
    metrics
}
