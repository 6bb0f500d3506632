//! Comparison with the avalanches of Pailha, Nicolas & Pouliquen (2008).

use super::Record;
use super::quantities::{
    ACCELERATION_TIME, DRAINED_FRACTION, EARLY_PRESSURE, END_PRESSURE, END_VELOCITY, ONSET_GROWTH, ONSET_TIME,
};
use super::run::{LayerPurpose, SubmergedLayerObservation, SubmergedLayerRun};
use super::verification::{ACCELERATED_VELOCITY, EARLY_TIME, ONSET_VELOCITY};
use crate::case::Run;
use crate::metric::{Confidence, Limit, Metric, Quantity, Value, Variant};
use crate::reference::submerged::{SUBMERGED_AVALANCHES, SubmergedAvalanche};

/// Solid fractions whose onset is gated, and whose early pressure is `[-]`.
const GATED_ONSETS: [f64; 2] = [0.584, 0.588];
const GATED_PRESSURES: [f64; 2] = [0.578, 0.584];

/// Densest layer whose final velocity is gated `[-]`.
const DENSEST_GATED_VELOCITY: f64 = 0.588;

/// Loosest layer that dilates for a minute and more before it moves `[-]`.
const LOOSEST_DELAYED: f64 = 0.584;

/// Densest layer whose measured pressure carries no offset `[-]`.
const DENSEST_WITHOUT_OFFSET: f64 = 0.584;

const SCATTER: &str =
    "30 % is 1.2 to 1.4 times u_input, mainly of φ_c, the slope and η; without dilatancy the layer moves at once";
const RATE: &str =
    "30 % is about twice u_input or more: ±0.005 in μ_c is 10 % of tanθ − μ_c, and K1 and η leave 10 % each";
const DARCY: &str =
    "35 % is 1.6 to 2.4 times u_input, mainly of φ_c and the slope; the measured points scatter by 0.3 Pa";

pub(super) fn metrics(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    let mut onsets = Vec::new();
    for (run, record) in records.iter().filter(|(run, _)| run.purpose == LayerPurpose::Experiment) {
        let fraction = run.solid_fraction;
        let Some(measured) = SUBMERGED_AVALANCHES.of(fraction) else { continue };
        metrics.extend(beside(run, &record.data, measured));
        if fraction >= LOOSEST_DELAYED {
            onsets.push((fraction, record.data.velocity_curve().time_to(ONSET_VELOCITY).unwrap_or(f64::NAN)));
        }
    }
    metrics.extend(growth(onsets));
    metrics
}

fn is_one_of(fractions: &[f64], fraction: f64) -> bool {
    fractions.iter().any(|own| (own - fraction).abs() < 1e-9)
}

/// A value beside the measured one, gated within a part of it where it is.
fn compared(quantity: Quantity, variant: &Variant, value: f64, measured: f64) -> Metric {
    quantity
        .of(variant, value)
        .against(Some(measured), &SUBMERGED_AVALANCHES.source, SUBMERGED_AVALANCHES.confidence)
        .with_snapshot_tolerance(1e-3, 1e-3)
}

/// Limit of a part of the measured value on both sides; none where nothing is gated.
fn within(part: f64, measured: f64, is_gated: bool) -> Option<Limit> {
    let (one, other) = ((1.0 - part) * measured, (1.0 + part) * measured);
    is_gated.then(|| Limit::Within(one.min(other), one.max(other)))
}

fn beside(run: &SubmergedLayerRun, data: &SubmergedLayerObservation, measured: &SubmergedAvalanche) -> Vec<Metric> {
    let (variant, fraction) = (run.variant(), run.solid_fraction);
    let (velocity, pressure) = (data.velocity_curve(), data.pressure_curve());
    let mut metrics = Vec::new();
    let times = [(ONSET_TIME, ONSET_VELOCITY), (ACCELERATION_TIME, ACCELERATED_VELOCITY)];
    for (quantity, level) in times {
        let Some(reached) = measured.surface_velocity.time_to(level) else { continue };
        let own = velocity.time_to(level).unwrap_or(f64::NAN);
        let is_gated = quantity == ONSET_TIME && is_one_of(&GATED_ONSETS, fraction);
        metrics.push(compared(quantity, &variant, own, reached).gated_by(within(0.3, reached, is_gated), SCATTER));
    }
    let (end, last) = measured.surface_velocity.end();
    let is_gated = fraction < DENSEST_GATED_VELOCITY + 1e-9;
    metrics.push(compared(END_VELOCITY, &variant, velocity.at(end), last).gated_by(within(0.3, last, is_gated), RATE));
    let early = measured.pore_pressure.at(EARLY_TIME);
    let is_gated = is_one_of(&GATED_PRESSURES, fraction);
    metrics.push(
        compared(EARLY_PRESSURE, &variant, pressure.at(EARLY_TIME), early)
            .gated_by(within(0.35, early, is_gated), DARCY),
    );
    let (end, last) = measured.pore_pressure.end();
    metrics.push(compared(END_PRESSURE, &variant, pressure.at(end), last));
    metrics.push(drained(run, &variant, measured));
    metrics
}

/// Final solid fraction of a layer that dilates uniformly, dφ/dt = 2 k φ p/(η h²), from the measured pressure alone: no friction
/// enters.
fn drained(run: &SubmergedLayerRun, variant: &Variant, measured: &SubmergedAvalanche) -> Metric {
    let layer = &run.layer;
    let mut fraction = run.solid_fraction;
    for pair in measured.pore_pressure.points.windows(2) {
        let depth = layer.depth * run.solid_fraction / fraction;
        let rate = 2.0 * layer.permeability(fraction) / (layer.viscosity * depth * depth);
        let impulse = 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1);
        fraction *= libm::exp(rate * impulse);
    }
    let source = if run.solid_fraction > DENSEST_WITHOUT_OFFSET + 1e-9 {
        "φ_eq of the slope; the measured pressure probably carries an offset of −1.5 to −2 Pa"
    } else {
        "φ_eq of the slope, to which the integrated pressures of the looser layers lead within 0.005"
    };
    DRAINED_FRACTION
        .of(variant, fraction)
        .against(Some(layer.steady_fraction()), source, Confidence::Medium)
        .with_snapshot_tolerance(1e-3, 0.0)
}

/// Smallest ratio of the onset times of neighbours among the dense layers.
fn growth(mut onsets: Vec<(f64, f64)>) -> Option<Metric> {
    onsets.sort_by(|one, other| one.0.total_cmp(&other.0));
    if onsets.len() < 2 {
        return None;
    }
    let ratio = |pair: &[(f64, f64)]| pair[1].1 / pair[0].1;
    // a ratio that is not a number stays
    let smallest =
        onsets.windows(2).map(ratio).fold(f64::INFINITY, |least, own| if own >= least { least } else { own });
    let variant = Variant::of("solid_fraction", Value::list(onsets.iter().map(|onset| onset.0)));
    let metric = ONSET_GROWTH
        .of(&variant, smallest)
        .against(None, &SUBMERGED_AVALANCHES.source, SUBMERGED_AVALANCHES.confidence)
        .gated(Limit::AtLeast(1.0), "the measured onset is later for every denser layer: 98, 177 and 315 s")
        .with_snapshot_tolerance(0.01, 0.0);
    Some(metric)
}
