//! How the layers are judged.

use super::BedLoad1dRecord;
use super::bed_at_rest;
use super::others;
use super::records::{literature, of};
use super::regimes;
use super::run::{BedLoad1dRun, LayerPurpose, ONE_STATE, ONE_STATE_REASON};
use super::sensitivities::model_input_uncertainty;
use super::suspension;
use crate::case::Run;
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity, Value, Variant, quantities};
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};
use crate::reference::one_dimension::bed_load::{LayerState, SAME_STATE};
use crate::shared::printed_laws;
use crate::statistics::curvature;

quantities! {
    [
        bed_at_rest::VELOCITY_DEFICIT, bed_at_rest::LAYER_SLOPE_RATIO, others::FRACTION_DIFFERENCE, others::GRAIN_VELOCITY_DIFFERENCE, others::FLUID_VELOCITY_DIFFERENCE,
        others::TURBULENT_STRESS_DIFFERENCE, regimes::ROWS_IN_MOTION, regimes::POWER_LAW_MISFIT_RATIO,
        regimes::POWER_LAW_MISFIT,
        regimes::LOWEST_LAYER_EXPONENT, regimes::TRANSPORT_OVER_MEASURED, printed_laws::LAW_ERROR, suspension::DUCT_VELOCITY_DIFFERENCE,
        suspension::SUSPENDED_TRANSPORT, suspension::SETTLING_RATIO,
    ]
    TRANSPORT_RATIO: validated("transport_ratio", "-", "q* over q* of the formula or of a published layer"),
    TRANSPORT: validated("transport", "-", "q*, the rate of bed load in units of √((s − 1) g d³)"),
    MEAN_FLUID_VELOCITY: verified("mean_fluid_velocity", "m/s", "depth mean of the water's velocity"),
    STRESS_BALANCE_ERROR: verified("stress_balance_error", "-", "largest imbalance of the stresses of both phases with the weight component above, over the bed stress"),
    DRAG_BALANCE_ERROR:
        verified("drag_balance_error", "-", "largest imbalance of drag, grain stress and grain weight, over the bed stress"),
    START_DIFFERENCE:
        verified("start_difference", "-", "difference between the steady states from rest and from a fast start"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence with the height of a cell"),
    MOVES_ABOVE: verified("moves_above", "mm", "lowest height at which grains are faster than 1 cm/s"),
    TOP_OF_GRAINS: verified("top_of_grains", "mm", "height up to which there are grains"),
    DECAY_LENGTH: verified("decay_length", "mm", "e-folding length of the grain velocity in the bed"),
    GRAIN_CURVATURE: stated("grain_curvature", "u_*/d²", "curvature of the grains' velocity over the height, above or below the bed's level"),
    DRAG_PEAK_HEIGHT: verified("drag_peak_height", "mm", "height of the largest drag on the grains"),
    DRAG_FROM: verified("drag_from", "mm", "lower end of the range in which the drag on the grains exceeds a tenth of its peak"),
    DRAG_TO: verified("drag_to", "mm", "upper end of the range in which the drag on the grains exceeds a tenth of its peak"),
    LOGARITHMIC_SLOPE:
        verified("logarithmic_slope", "-", "slope of the water's velocity over ln z in a range of heights, over u_*/κ"),
    MOTION_DEPTH_GROWTH:
        stated("motion_depth_growth", "-", "least ratio of the depth of motion from a slope to the next"),
    DECAY_LENGTH_GROWTH: stated("decay_length_growth", "-", "least ratio of the decay length from a slope to the next"),
    DRAG_DEPTH_GROWTH: stated("drag_depth_growth", "-", "least ratio, from a slope to the next, of the depth down to which the drag exceeds a tenth of its peak"),
    ONSET_RATIO: validated("onset_ratio", "-", "Shields number at the onset of motion over Shields' curve"),
    ONSET: validated("onset", "-", "Shields number at the onset of motion"),
    ONSET_OVER_MEASURED:
        validated("onset_over_measured", "-", "Shields number at the onset of motion over the median of thresholds measured with grains of this size"),
    TRANSPORT_SENSITIVITY:
        verified("transport_sensitivity", "-", "q* with one closure replaced, over q* with the closures of the literature"),
}

/// Speed above which a grain counts as moving `[m/s]`.
pub(super) const MOVING: f64 = 0.01;

/// Part of u_s at z = 0 down to which its decay is fitted `[-]`.
const TAIL: f64 = 0.01;

/// Part of the largest drag that bounds its range `[-]`.
const DRAG_RANGE: f64 = 0.1;

/// Ranges of height over which the slope of u_f against ln z is fitted `[mm]`.
const LOGARITHMIC_RANGES: [(f64, f64); 4] = [(0.5, 3.0), (3.0, 8.0), (8.0, 18.0), (15.0, 43.0)];

/// Height below which studies of the order do not look `[m]`: nothing moves there.
const STUDIED_ABOVE: f64 = -0.01;

const MODEL: &str = "the layer's own equations";

pub(super) fn all(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, state) in literature(records) {
        transport(&mut metrics, records, run, state);
        balances(&mut metrics, run, state);
        let on_slope = |other: &BedLoad1dRun| other.stream.slope == run.stream.slope;
        for (_, other) in
            of(records, |purpose| matches!(purpose, LayerPurpose::FastStart(_))).filter(|(run, _)| on_slope(run))
        {
            start(&mut metrics, run, state, other);
        }
        for (purpose, limit) in [(LayerPurpose::DilatingOrder, 1.0), (LayerPurpose::FrozenOrder, 1.8)] {
            let study: Vec<&LayerState> = of(records, |other| *other == purpose)
                .filter(|(run, _)| on_slope(run))
                .map(|(_, state)| state)
                .collect();
            order(&mut metrics, run, &study, purpose, limit);
        }
        profiles(&mut metrics, run, state);
        if let Some((_, rest)) =
            of(records, |purpose| *purpose == LayerPurpose::BedAtRest).find(|(run, _)| on_slope(run))
        {
            metrics.extend(bed_at_rest::metrics(run, state, rest));
        }
        metrics.extend(regimes::metrics(run, state, MOVING));
    }
    similar(&mut metrics, records);
    second_states(&mut metrics, records);
    metrics.extend(super::onset::metrics(records, [ONSET_RATIO, ONSET, ONSET_OVER_MEASURED], START_DIFFERENCE));
    metrics.extend(others::metrics(records, TRANSPORT_RATIO, TRANSPORT, START_DIFFERENCE));
    metrics.extend(suspension::metrics(records, TRANSPORT));
    with_slope(&mut metrics, &literature(records).collect::<Vec<_>>());
    for (run, state) in of(records, |purpose| matches!(purpose, LayerPurpose::Sensitivity(_))) {
        if let Some((_, own)) = literature(records).find(|(other, _)| other.stream.slope == run.stream.slope) {
            let ratio = state.transport() / own.transport();
            metrics.push(
                TRANSPORT_SENSITIVITY
                    .of(&run.variant(), ratio)
                    .against(Some(1.0), "the layer with the literature's closures", Confidence::Exact)
                    .with_snapshot_tolerance(1e-3, 0.0),
            );
        }
    }
    metrics
}

/// Transport against the formula.
fn transport(metrics: &mut Vec<Metric>, records: &[BedLoad1dRecord], run: &BedLoad1dRun, state: &LayerState) {
    let formula = TransportFormula::WongParker;
    let expected = formula.transport(run.stream.shields_number());
    let variant = run.variant();
    if expected > 0.0 {
        let metric = TRANSPORT_RATIO
            .of(&variant, state.transport() / expected)
            .against(Some(1.0), formula.name(), formula.confidence())
            .gated_by(
                is_bed_load(run).then_some(Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1)),
                "nine tenths of measured rates lie so about the formula, and the closures leave as much open: the length \
                 over which the bed's roughness fades is no literature's, and from 0.01 to 0.3 grain diameters takes the ratio at 2 % \
                 from 1.15 to 0.33",
            )
            .with_snapshot_tolerance(1e-3, 0.0);
        metrics.push(match model_input_uncertainty(records, run, state) {
            Some((standard, source)) => metric.known_to(Origin::Input, Some(standard), &source),
            None => metric,
        });
    }
    if is_bed_load(run) {
        metrics.extend(regimes::beside_measured(run, state, model_input_uncertainty(records, run, state)));
    }
    metrics.push(
        TRANSPORT
            .of(&variant, state.transport())
            .against(Some(expected), formula.name(), formula.confidence())
            .with_snapshot_tolerance(1e-3, 0.0),
    );
    metrics.push(MEAN_FLUID_VELOCITY.of(&variant, state.mean_fluid_velocity()).with_snapshot_tolerance(1e-3, 0.0));
}

/// Whether the layer is one of bed load: elsewhere no formula of bed load judges it.
fn is_bed_load(run: &BedLoad1dRun) -> bool {
    run.stream.outside_bed_load().is_none()
}

/// The other state of a layer that has two.
fn second_variant(run: &BedLoad1dRun) -> Variant {
    run.variant().and("start", "fast")
}

/// Both states of layers with other closures and of those of others, where there are two.
fn second_states(metrics: &mut Vec<Metric>, records: &[BedLoad1dRecord]) {
    for (run, record) in records.iter().filter(|(run, _)| run.purpose != LayerPurpose::Similar) {
        let Some(second) = &record.data.second else { continue };
        metrics.push(TRANSPORT.of(&second_variant(run), second.transport()));
        if matches!(run.purpose, LayerPurpose::Sensitivity(_)) {
            metrics.push(START_DIFFERENCE.of(&run.variant(), record.data.start_difference));
        }
    }
}

/// The layer of a sweep: judged where the layer is one of bed load, and both of its states if there are two.
fn similar(metrics: &mut Vec<Metric>, records: &[BedLoad1dRecord]) {
    let formula = TransportFormula::WongParker;
    for (run, record) in records.iter().filter(|(run, _)| run.purpose == LayerPurpose::Similar) {
        let expected = formula.transport(run.stream.shields_number());
        let mut state = |variant: &Variant, state: &LayerState| {
            metrics.push(TRANSPORT.of(variant, state.transport()).against(
                Some(expected),
                formula.name(),
                formula.confidence(),
            ));
            if expected > 0.0 {
                let limit = Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1);
                metrics.push(
                    TRANSPORT_RATIO
                        .of(variant, state.transport() / expected)
                        .against(Some(1.0), formula.name(), formula.confidence())
                        .gated_by(is_bed_load(run).then_some(limit), "the scatter of the formula's own data"),
                );
            }
        };
        state(&run.variant(), &record.data.state);
        if let Some(second) = &record.data.second {
            state(&second_variant(run), second);
        }
        metrics.push(START_DIFFERENCE.of(&run.variant(), record.data.start_difference));
    }
}

/// Both balances of momentum.
fn balances(metrics: &mut Vec<Metric>, run: &BedLoad1dRun, state: &LayerState) {
    let errors = [
        (STRESS_BALANCE_ERROR, state.stress_balance_error(), "τ_f + τ_s = g sinθ ∫ ρ dz, error over ρ_f g h tanθ"),
        (
            DRAG_BALANCE_ERROR,
            state.drag_balance_error(),
            "K (u_f − u_s) = −∂τ_s/∂z − φ ρ_s g sinθ, error over the largest drag",
        ),
    ];
    for ((quantity, error, identity), largest) in errors.into_iter().zip([1e-7, 1e-6]) {
        metrics.push(
            quantity
                .of(&run.variant(), error)
                .against(Some(0.0), identity, Confidence::Exact)
                .gated(
                    Limit::AtMost(largest),
                    "exact in a steady state for any closure; a smaller `steady_change` brings it down",
                )
                .with_snapshot_tolerance(1.0, 0.1 * largest),
        );
    }
}

/// Two starts, one state.
fn start(metrics: &mut Vec<Metric>, run: &BedLoad1dRun, rest: &LayerState, fast: &LayerState) {
    let difference = rest.start_difference(fast);
    if difference > SAME_STATE {
        metrics.push(TRANSPORT.of(&run.variant().and("second", "fast"), fast.transport()));
    }
    // the two starts of the runs behind it, as one word
    let variant = Variant::of("slope", run.stream.slope).and("start", "rest_fast");
    metrics.push(
        START_DIFFERENCE
            .of(&variant, difference)
            .against(Some(0.0), "the layer from rest: q*, u_f and φ u_s", Confidence::Exact)
            .gated(Limit::AtMost(ONE_STATE), ONE_STATE_REASON)
            .with_snapshot_tolerance(1.0, 0.1 * ONE_STATE),
    );
}

/// The order of convergence: from the profiles where the fraction is given, from q* where it is not. The topmost grains
/// end inside a cell, so that profiles of a dilating layer converge everywhere but there.
fn order(metrics: &mut Vec<Metric>, run: &BedLoad1dRun, study: &[&LayerState], purpose: LayerPurpose, least: f64) {
    let differences: Vec<f64> = study.windows(2).map(|pair| difference(pair[0], pair[1], purpose)).collect();
    let [.., coarse, fine] = differences[..] else { return };
    let heights = Value::list(study.iter().map(|state| state.cell_height));
    let variant = Variant::of("slope", run.stream.slope).and("grains", purpose.grains()).and("cell_height", heights);
    metrics.push(
        OBSERVED_ORDER
            .of(&variant, libm::log2(coarse / fine))
            .against(Some(2.0), MODEL, Confidence::Exact)
            .gated(Limit::AtLeast(least), "second order with a given fraction, at least first with dilation")
            .with_snapshot_tolerance(0.02, 0.0),
    );
}

/// What is taken for the error of the coarser of two layers `[-]`.
pub(super) fn difference(coarse: &LayerState, fine: &LayerState, purpose: LayerPurpose) -> f64 {
    match purpose {
        LayerPurpose::FrozenOrder => coarse.difference(fine, STUDIED_ABOVE),
        _ => (coarse.transport() / fine.transport() - 1.0).abs(),
    }
}

/// What the profiles look like: observed, for there is no table to gate them by.
fn profiles(metrics: &mut Vec<Metric>, run: &BedLoad1dRun, state: &LayerState) {
    let variant = run.variant();
    let millimetres = |quantity: Quantity, value: Option<f64>| {
        quantity.of(&variant, 1e3 * value.unwrap_or(f64::NAN)).with_snapshot_tolerance(0.01, 0.01)
    };
    let drag = state.drag_peak(DRAG_RANGE);
    metrics.extend([
        millimetres(MOVES_ABOVE, state.moves_above(MOVING)),
        millimetres(TOP_OF_GRAINS, Some(state.top_of_grains())),
        millimetres(DECAY_LENGTH, state.decay_length(TAIL)),
        millimetres(DRAG_PEAK_HEIGHT, Some(drag.height)),
        millimetres(DRAG_FROM, Some(drag.from)),
        millimetres(DRAG_TO, Some(drag.to)),
    ]);
    for (side, curved, limit) in [
        ("above", curvature(&grains_beside(run, state, 0.0..state.top_of_grains())), Limit::AtMost(0.0)),
        ("below", curvature(&grains_beside(run, state, -run.stream.bed_depth..0.0)), Limit::AtLeast(0.0)),
    ] {
        metrics.push(
            GRAIN_CURVATURE
                .of(&variant.clone().and("side", side), curved.unwrap_or(f64::NAN))
                .against(
                    None,
                    "statement of the bed-load paper: concave above the bed's level (−), convex below (+)",
                    Confidence::Medium,
                )
                .gated_by(is_bed_load(run).then_some(limit), "the sign is what the paper states")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    for (from, to) in LOGARITHMIC_RANGES {
        if let Some(slope) = state.logarithmic_slope(1e-3 * from, 1e-3 * to, run.closures.karman) {
            let variant = variant.clone().and("height", from..=to);
            metrics.push(
                LOGARITHMIC_SLOPE
                    .of(&variant, slope)
                    .against(Some(1.0), "clear water, du_f/d ln z = u_*/κ", Confidence::High)
                    .with_snapshot_tolerance(0.01, 0.0),
            );
        }
    }
}

/// (z/d, u_s/u_*) of the moving grains in a range of heights `[m]`.
fn grains_beside(run: &BedLoad1dRun, state: &LayerState, range: std::ops::Range<f64>) -> Vec<(f64, f64)> {
    let cells = state.height.iter().zip(&state.grain_velocity);
    let moving = cells.filter(|(z, velocity)| range.contains(*z) && **velocity > MOVING);
    moving.map(|(z, velocity)| (z / run.stream.grain_diameter, velocity / run.stream.shear_velocity())).collect()
}

/// What must grow from slope to slope: the smallest ratio of two neighbours.
fn with_slope(metrics: &mut Vec<Metric>, layers: &[(&BedLoad1dRun, &LayerState)]) {
    let mut layers = layers.to_vec();
    layers.sort_by(|a, b| a.0.stream.slope.total_cmp(&b.0.stream.slope));
    if layers.len() < 2 {
        return;
    }
    let variant = Variant::of("slope", Value::list(layers.iter().map(|(run, _)| run.stream.slope)));
    let growth = |value: fn(&LayerState) -> Option<f64>| {
        let values: Vec<f64> = layers.iter().map(|(_, state)| value(state).unwrap_or(f64::NAN)).collect();
        values
            .windows(2)
            .map(|pair| pair[1] / pair[0])
            .fold(f64::INFINITY, |least, ratio| if ratio >= least { least } else { ratio })
    };
    let depth = growth(|state| state.moves_above(MOVING).map(|z| -z));
    let decay = growth(|state| state.decay_length(TAIL));
    let drag = growth(|state| Some(-state.drag_peak(DRAG_RANGE).from));
    let deeper = "the bed-load paper's figures 10 and 11: motion reaches deeper on the steeper slope";
    let drag_deeper = "the bed-load paper's figures 12 and 13: drag reaches deeper on the steeper slope";
    for (quantity, value, statement) in [
        (MOTION_DEPTH_GROWTH, depth, deeper),
        (DECAY_LENGTH_GROWTH, decay, deeper),
        (DRAG_DEPTH_GROWTH, drag, drag_deeper),
    ] {
        metrics.push(
            quantity
                .of(&variant, value)
                .against(None, statement, Confidence::Medium)
                .gated(Limit::AtLeast(1.05), "grows from each slope to the next; 5 % is above any error of the cells")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
}
