//! How the layers are judged.

mod bed_at_rest;
mod lowest_layer;
mod measured;
mod onset;
mod suspension;

pub(super) use suspension::RESTING;

use super::BedLoad1dRecord;
use super::draws::{DrawnLayer, known_to_closures};
use super::flow::{BedLoad1dFlow, BedMotion, LayerStart, LayerStream};
use super::quantities::{
    DECAY_LENGTH, DECAY_LENGTH_GROWTH, DRAG_BALANCE_ERROR, DRAG_DEPTH_GROWTH, DRAG_FROM, DRAG_PEAK_HEIGHT, DRAG_TO,
    GRAIN_CURVATURE, LOGARITHMIC_SLOPE, MEAN_FLUID_VELOCITY, MOTION_DEPTH_GROWTH, MOVES_ABOVE, OBSERVED_ORDER,
    START_DIFFERENCE, STRESS_BALANCE_ERROR, TOP_OF_GRAINS, TRANSPORT_RATIO,
};
use super::records::{SolvedLayer, of, on_slope, second_variant};
use crate::case::Flow;
use crate::metric::{Confidence, Limit, Metric, Quantity, Value, Variant};
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};
use crate::reference::one_dimension::bed_load::{LayerState, SAME_STATE};
use crate::shared::transport_in_units;
use crate::statistics::curvature;

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

const SCATTER: &str = "scatter of the data that the formula is fitted to";

/// Largest difference between the steady states from two starts `[-]`.
const ONE_STATE: f64 = 1e-6;

pub(super) fn all(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let judged: Vec<SolvedLayer<'_>> = of(records, BedLoad1dFlow::is_from_rest).collect();
    for &(run, state) in &judged {
        transport(&mut metrics, run, state);
        balances(&mut metrics, run, state);
        let starts_fast = |other: &BedLoad1dFlow| {
            other.is_on_slope(BedMotion::Dilating) && matches!(other.start, LayerStart::Moving { .. })
        };
        for (_, fast) in on_slope(records, run, starts_fast) {
            start(&mut metrics, run, state, fast);
        }
        metrics.extend(
            [BedMotion::Dilating, BedMotion::Frozen].into_iter().filter_map(|motion| order(records, run, motion)),
        );
        let rest = on_slope(records, run, |other| other.is_on_slope(BedMotion::AtRest)).next();
        form(&mut metrics, run, state, rest.map(|rest| rest.1));
    }
    for (run, record) in records {
        metrics.extend(record.data.draws.paper.iter().flat_map(|paper| bed_at_rest::of_paper(run, paper)));
    }
    similar(&mut metrics, records);
    metrics.extend(onset::metrics(records));
    metrics.extend(measured::metrics(records));
    metrics.extend(suspension::metrics(records));
    let draws = of_draws(records, &judged);
    with_slope(&mut metrics, judged.clone());
    in_units(known_to_closures(metrics, &draws), &judged)
}

/// Adds the transport in the units of flumes, with what the closures leave open of it; nothing where no closures were drawn.
fn in_units(metrics: Vec<Metric>, judged: &[SolvedLayer<'_>]) -> Vec<Metric> {
    let with_units = |metric: Metric| {
        let is_own = |(run, _): &&SolvedLayer<'_>| is_bed_load(run) && metric.variant == run.variant();
        let Some((run, state)) = judged.iter().find(is_own).filter(|_| metric.name == TRANSPORT_RATIO.name) else {
            return metric;
        };
        let rate = state.transport();
        let uncertainty = metric.uncertainty.standard().map(|own| own * rate / metric.value);
        let words = uncertainty.and_then(|own| transport_in_units(&run.stream(), rate, own, "the closures"));
        metric.remarked(words)
    };
    metrics.into_iter().map(with_units).collect()
}

/// The metrics that draws of the closures have as well: those of each number, over all slopes.
fn of_draws(records: &[BedLoad1dRecord], judged: &[SolvedLayer<'_>]) -> Vec<Vec<Metric>> {
    let on_slopes: Vec<(&BedLoad1dFlow, &[Option<DrawnLayer>])> = judged
        .iter()
        .filter_map(|(run, _)| {
            let drawn =
                records.iter().find(|(other, _)| other.closure_draws > 0 && other.stream().slope == run.stream().slope);
            Some((*run, &drawn?.1.data.draws.drawn[..]))
        })
        .collect();
    let number = on_slopes.iter().map(|(_, draws)| draws.len()).max().unwrap_or(0);
    let of_number = |number: usize| {
        let layers = on_slopes.iter().filter_map(|(run, draws)| {
            let layer = draws.get(number)?.as_ref()?;
            Some((BedLoad1dFlow { closures: layer.closures, ..(*run).clone() }, layer))
        });
        let layers: Vec<(BedLoad1dFlow, &DrawnLayer)> = layers.collect();
        let mut metrics = Vec::new();
        for (run, layer) in &layers {
            transport(&mut metrics, run, &layer.state);
            form(&mut metrics, run, &layer.state, Some(&layer.rest));
        }
        with_slope(&mut metrics, layers.iter().map(|(run, layer)| (run, &layer.state)).collect());
        metrics
    };
    (0..number).map(of_number).collect()
}

/// The form of the profiles, of water and of grains.
fn form(metrics: &mut Vec<Metric>, run: &BedLoad1dFlow, state: &LayerState, rest: Option<&LayerState>) {
    profiles(metrics, run, state);
    metrics.extend(rest.into_iter().flat_map(|rest| bed_at_rest::metrics(run, state, rest)));
    metrics.extend(lowest_layer::metrics(run, state, MOVING));
}

/// The difference of the states from two starts, judged.
fn one_state(variant: &Variant, difference: f64, source: &str) -> Metric {
    START_DIFFERENCE
        .of(variant, difference)
        .exactly(0.0, source)
        .gated(
            Limit::AtMost(ONE_STATE),
            "1e-6: two starts must reach one steady state; they still differed by 8e-8 (measured)",
        )
        .with_snapshot_tolerance(1.0, 0.1 * ONE_STATE)
}

/// Transport over that of the formula, judged where the layer is one of bed load; none where the formula has no transport.
fn over_formula(variant: &Variant, run: &BedLoad1dFlow, state: &LayerState, reason: &str) -> Option<Metric> {
    let formula = TransportFormula::WongParker;
    let expected = formula.transport(run.stream().shields_number());
    let limit = is_bed_load(run).then_some(Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1));
    let metric = || TRANSPORT_RATIO.of(variant, state.transport() / expected);
    (expected > 0.0).then(|| metric().against(Some(1.0), formula.name(), formula.confidence()).gated_by(limit, reason))
}

/// Transport against the formula and against measured runs.
fn transport(metrics: &mut Vec<Metric>, run: &BedLoad1dFlow, state: &LayerState) {
    let reason = "limits enclose 90 % of measured rates; the closures' uncertainty is listed separately";
    let ratio = over_formula(&run.variant(), run, state, reason);
    metrics.extend(ratio.map(|ratio| ratio.with_snapshot_tolerance(1e-3, 0.0)));
    if is_bed_load(run) {
        metrics.extend(lowest_layer::beside_measured(run, state));
    }
    metrics
        .push(MEAN_FLUID_VELOCITY.of(&run.variant(), state.mean_fluid_velocity()).with_snapshot_tolerance(1e-3, 0.0));
}

/// Whether the layer is one of bed load: elsewhere no formula of bed load judges it.
fn is_bed_load(run: &BedLoad1dFlow) -> bool {
    run.stream().outside_bed_load().is_none()
}

/// The layer of a sweep, and both of its states if there are two.
fn similar(metrics: &mut Vec<Metric>, records: &[BedLoad1dRecord]) {
    for (run, record) in records.iter().filter(|(run, _)| matches!(run.stream, LayerStream::ShieldsNumber(_))) {
        let data = &record.data;
        metrics.extend(over_formula(&run.variant(), run, &data.state, SCATTER));
        let second = data.second.as_ref();
        metrics.extend(second.and_then(|second| over_formula(&second_variant(run), run, second, SCATTER)));
        metrics.push(START_DIFFERENCE.of(&run.variant(), data.start_difference));
    }
}

/// Both balances of momentum.
fn balances(metrics: &mut Vec<Metric>, run: &BedLoad1dFlow, state: &LayerState) {
    let errors = [
        (STRESS_BALANCE_ERROR, state.stress_balance_error(), "τ_f + τ_s = g sinθ ∫ ρ dz, error over ρ_f g h tanθ"),
        (
            DRAG_BALANCE_ERROR,
            state.drag_balance_error(),
            "K (u_f − u_s) = −∂τ_s/∂z − φ ρ_s g sinθ, error over the largest drag",
        ),
    ];
    // rounding of a stress's difference over a cell, above 20 cells in a diameter
    let fine = (run.grain_diameter / (20.0 * state.cell_height)).powi(2).max(1.0);
    for ((quantity, error, identity), largest) in errors.into_iter().zip([1e-7, 1e-6 * fine]) {
        metrics.push(
            quantity
                .of(&run.variant(), error)
                .exactly(0.0, identity)
                .gated(
                    Limit::AtMost(largest),
                    "limit near 0, the value of an exactly steady state; a smaller `steady_change` reduces the imbalance",
                )
                .with_snapshot_tolerance(1.0, 0.1 * largest),
        );
    }
}

/// Two starts, one state.
fn start(metrics: &mut Vec<Metric>, run: &BedLoad1dFlow, rest: &LayerState, fast: &LayerState) {
    let difference = rest.start_difference(fast);
    if difference > SAME_STATE {
        metrics.extend(over_formula(&run.variant().and("second", "fast"), run, fast, SCATTER));
    }
    // the two starts of the runs behind it, as one word
    let variant = Variant::of("slope", run.stream().slope).and("start", "rest_fast");
    metrics.push(one_state(&variant, difference, "the layer from rest: q*, u_f and φ u_s"));
}

/// The order of convergence: from the profiles where the fraction is given, from q* where it is not. The topmost grains
/// end inside a cell, so that profiles of a dilating layer converge everywhere but there. None without three heights of a cell, each half the
/// one before.
fn order(records: &[BedLoad1dRecord], run: &BedLoad1dFlow, motion: BedMotion) -> Option<Metric> {
    let study = order_study(records, run, motion);
    let differences: Vec<f64> = study.windows(2).map(|pair| difference(pair[0], pair[1], motion)).collect();
    let [.., coarse, fine] = differences[..] else { return None };
    let (grains, least) = if motion == BedMotion::Frozen { ("frozen", 1.8) } else { ("dilating", 1.0) };
    let heights = Value::list(study.iter().map(|state| state.cell_height));
    let variant = Variant::of("slope", run.stream().slope).and("grains", grains).and("cell_height", heights);
    let metric = OBSERVED_ORDER
        .of(&variant, libm::log2(coarse / fine))
        .exactly(2.0, MODEL)
        .gated(Limit::AtLeast(least), "1.8 with given solid fraction, 1 with dilation: orders 2 and 1 are expected")
        .with_snapshot_tolerance(0.02, 0.0);
    Some(metric)
}

/// Layers on the slope of a run that differ in the height of a cell alone, from the coarsest on, each of half the height of the one before.
fn order_study<'a>(records: &'a [BedLoad1dRecord], run: &'a BedLoad1dFlow, motion: BedMotion) -> Vec<&'a LayerState> {
    let is_of_study = |other: &BedLoad1dFlow| {
        other.closures == run.closures
            && other.closure_draws == 0
            && other.is_on_slope(motion)
            && !matches!(other.start, LayerStart::Moving { .. })
    };
    let mut study: Vec<&LayerState> = on_slope(records, run, is_of_study).map(|(_, state)| state).collect();
    study.sort_by(|a, b| b.cell_height.total_cmp(&a.cell_height));
    let is_half = |pair: &[&LayerState]| (pair[0].cell_height / pair[1].cell_height - 2.0).abs() < 1e-6;
    if study.windows(2).all(is_half) { study } else { Vec::new() }
}

/// What is taken for the error of the coarser of two layers `[-]`.
fn difference(coarse: &LayerState, fine: &LayerState, motion: BedMotion) -> f64 {
    match motion {
        BedMotion::Frozen => coarse.difference(fine, STUDIED_ABOVE),
        BedMotion::Dilating | BedMotion::AtRest => (coarse.transport() / fine.transport() - 1.0).abs(),
    }
}

/// What the profiles look like: observed, for there is no table to gate them by.
fn profiles(metrics: &mut Vec<Metric>, run: &BedLoad1dFlow, state: &LayerState) {
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
        ("below", curvature(&grains_beside(run, state, -run.stream().bed_depth..0.0)), Limit::AtLeast(0.0)),
    ] {
        metrics.push(
            GRAIN_CURVATURE
                .of(&variant.clone().and("side", side), curved.unwrap_or(f64::NAN))
                .against(
                    None,
                    "statement of the bed-load paper: concave above the bed's level (−), convex below (+)",
                    Confidence::Medium,
                )
                .gated_by(is_bed_load(run).then_some(limit), "0: the paper states only the sign of the curvature")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    for (from, to) in LOGARITHMIC_RANGES {
        if let Some(slope) = state.logarithmic_slope(1e-3 * from, 1e-3 * to, run.closures.karman) {
            let variant = variant.clone().and("height", format!("{from}..{to}"));
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
fn grains_beside(run: &BedLoad1dFlow, state: &LayerState, range: std::ops::Range<f64>) -> Vec<(f64, f64)> {
    let cells = state.height.iter().zip(&state.grain_velocity);
    let moving = cells.filter(|(z, velocity)| range.contains(*z) && **velocity > MOVING);
    let unit = run.stream().shear_velocity();
    moving.map(|(z, velocity)| (z / run.grain_diameter, velocity / unit)).collect()
}

/// What must grow from slope to slope: the smallest ratio of two neighbours.
fn with_slope(metrics: &mut Vec<Metric>, mut layers: Vec<SolvedLayer<'_>>) {
    layers.sort_by(|a, b| a.0.stream().slope.total_cmp(&b.0.stream().slope));
    if layers.len() < 2 {
        return;
    }
    let variant = Variant::of("slope", Value::list(layers.iter().map(|(run, _)| run.stream().slope)));
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
                .gated(Limit::AtLeast(1.05), "1.05: growth by 5 % from slope to slope exceeds the discretisation error")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
}
