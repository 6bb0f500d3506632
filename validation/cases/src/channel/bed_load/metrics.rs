//! What is measured of a run, and how that is judged.

use super::BedLoadRecord;
use super::observation::BedLoadObservation;
use super::parameters::Stage;
use super::profiles;
use super::quantities::{
    DECAY_LENGTH, DRAG_PEAK_HEIGHT, DRAG_RATIO, END_TIME, FLUID_VELOCITY_MEAN, FLUID_VELOCITY_RMS, FORGETS_START,
    GRAIN_CURVATURE_ABOVE, GRAIN_CURVATURE_BELOW, GRAIN_VELOCITY_RMS, HIGHEST_PARTICLE, LAST_TRANSPORT, MOVES_ABOVE,
    PREDICTED_TRANSPORT, STREAM_VELOCITY, TRANSPORT, TRANSPORT_RATIO,
};
use super::run::{BedLoadRun, ContinuumRun};
use crate::case::Run;
use crate::channel;
use crate::metric::{Confidence, Limit, Metric};
use crate::observation::Recorded;
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};

/// Averaging time from which on a run beside the 1-D layer is judged whether it still changes or not `[s]`.
const JUDGED_FROM: f64 = 1.5;
/// Shortest averaging time of a flow that is judged because it no longer changes `[s]`.
const SHORTEST: f64 = 0.5;
/// Largest change of the stream's velocity over U/(2 g i) of such a flow `[-]`.
const STEADY: f64 = 0.02;

/// Spacing below which the transport of dilating grains is judged more closely `[m]`.
const FINE: f64 = 6e-4;

/// The transport, beside the formula where the run has forgotten its start.
pub(super) fn transport(run: &BedLoadRun, record: &Recorded<BedLoadObservation>, forgotten: bool) -> Metric {
    let formula = TransportFormula::WongParker;
    let rate = channel::observed(TRANSPORT, &run.variant(), record.data.channel.average(&record.data.transport), 1.0);
    let expected = || formula.transport(run.stream().shields_number());
    if forgotten { rate.against(Some(expected()), formula.name(), formula.confidence()) } else { rate }
}

/// Balances of a run of one particle a grain.
pub(super) fn balances(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let (variant, outer) = (run.variant(), record.clone().map(|data| data.channel));
    metrics.extend([channel::particles_lost(&variant, &outer), channel::momentum_residual(&variant, &outer)]);
}

/// What every run reports.
pub(super) fn common(
    metrics: &mut Vec<Metric>,
    run: &BedLoadRun,
    record: &Recorded<BedLoadObservation>,
    forgotten: bool,
) {
    let variant = run.variant();
    let data = &record.data;
    let mean = run.clear_water().mean_velocity();
    metrics.push(transport(run, record, forgotten));
    metrics.push(
        channel::observed(STREAM_VELOCITY, &variant, data.channel.average(&data.stream_velocity), 1.0 / mean)
            .exactly(1.0, "the logarithmic law of a rough bed"),
    );
    metrics.push(channel::velocity_drift(&variant, drift(run, data), "stream's velocity"));
    metrics.extend(channel::iterations(&variant, &data.channel, [None; 2]));
}

/// Share of the difference of two starts that may be left of it `[-]`.
const FORGOTTEN: f64 = 0.05;

/// A run with the one that differs from it in its start, and the share of their difference that is left in the stream's mean velocity
/// over the averaging window `[-]`; none without such a run.
fn memory<'r>(records: &'r [BedLoadRecord], run: &BedLoadRun) -> Option<(&'r BedLoadRun, f64)> {
    let (_, own) = records.iter().find(|(other, _)| other.variant() == run.variant())?;
    let (other_run, other) = records.iter().find(|(other, _)| run.has_another_start_than(other))?;
    let mean = |data: &BedLoadObservation| data.channel.average(&data.stream_velocity).value;
    let first = |data: &BedLoadObservation| data.stream_velocity.first().copied();
    let share = (mean(&own.data) - mean(&other.data)) / (first(&own.data)? - first(&other.data)?);
    Some((other_run, share.abs()))
}

/// Whether a run has forgotten its start; transport and profiles are judged of such runs only.
pub(super) fn has_forgotten(records: &[BedLoadRecord], run: &BedLoadRun) -> bool {
    memory(records, run).is_some_and(|(_, share)| share <= FORGOTTEN)
}

/// Memory of the start, a gate for each pair of runs, under the name of the faster start.
pub(super) fn forgets_start(metrics: &mut Vec<Metric>, records: &[BedLoadRecord]) {
    for (run, _) in records {
        let Some((_, share)) = memory(records, run).filter(|(other, _)| run.start() > other.start()) else { continue };
        metrics.push(
            FORGETS_START
                .of(&run.variant(), share)
                .against(Some(0.0), "a steady flow does not depend on its start", Confidence::Exact)
                .gated(
                    Limit::AtMost(FORGOTTEN),
                    "a twentieth of starts that differ by half of the stream leaves 0.25 u_*, the width of the gates of its profile",
                )
                .with_snapshot_tolerance(0.02, 0.005),
        );
    }
}

/// Whether a run in the layer's water is compared with the layer: it was watched for long, or it does not change.
fn is_settled(run: &BedLoadRun, data: &BedLoadObservation) -> bool {
    run.averaging_time >= JUDGED_FROM || (run.averaging_time >= SHORTEST && drift(run, data).abs() <= STEADY)
}

/// Relative change of the stream's velocity over U/(2 g i) `[-]`.
fn drift(run: &BedLoadRun, data: &BedLoadObservation) -> f64 {
    let channel = &data.channel;
    let velocity = channel.series.within(&data.stream_velocity, channel.window);
    let mean = velocity.iter().sum::<f64>() / velocity.len() as f64;
    let adjustment = mean / (2.0 * run.materials.gravity * run.slope);
    channel.trend(&data.stream_velocity) * adjustment / mean
}

/// The printed set-up: no gate, what it does is the result.
pub(super) fn printed(metrics: &mut Vec<Metric>, run: &BedLoadRun, record: &Recorded<BedLoadObservation>) {
    let variant = run.variant();
    let data = &record.data;
    metrics.push(END_TIME.of(&variant, record.simulated_time).with_snapshot_tolerance(0.05, 0.0));
    let highest = data.channel.series.highest.iter().copied().fold(0.0, f64::max);
    metrics.push(
        HIGHEST_PARTICLE.of(&variant, highest).exactly(1.0, "the depth of the water").with_snapshot_tolerance(0.1, 0.0),
    );
    let last = data.transport.last().copied().unwrap_or(f64::NAN);
    let formula = TransportFormula::WongParker;
    metrics.push(
        LAST_TRANSPORT
            .of(&variant, last)
            .against(Some(formula.transport(run.stream().shields_number())), formula.name(), formula.confidence())
            .with_snapshot_tolerance(0.2, 1e-3),
    );
}

/// Metrics of the grains; of flows that have forgotten their start the shape of their profile is judged by the paper's statement.
pub(super) fn grains(metrics: &mut Vec<Metric>, run: &BedLoadRun, data: &BedLoadObservation, judged: bool) {
    let variant = run.variant();
    let layer = data.layer.as_ref();
    let points = data.sediment.points();
    let source = "the 1-D layer";
    let values = [
        (
            DECAY_LENGTH,
            1e3 * profiles::decay_length(&points),
            layer.and_then(|l| l.decay_length(1e-4)).map(|l| 1e3 * l),
        ),
        (
            MOVES_ABOVE,
            1e3 * profiles::moves_above(&points, 0.01),
            layer.and_then(|l| l.moves_above(0.01)).map(|z| 1e3 * z),
        ),
    ];
    for (quantity, value, reference) in values {
        let metric = quantity.of(&variant, value).with_snapshot_tolerance(0.1, 0.5);
        metrics.push(match reference {
            Some(reference) => metric.exactly(reference, source),
            None => metric,
        });
    }
    let curvatures =
        [(GRAIN_CURVATURE_ABOVE, true, Limit::AtMost(0.0)), (GRAIN_CURVATURE_BELOW, false, Limit::AtLeast(0.0))];
    for (quantity, above, limit) in curvatures {
        let estimate = data.sediment.estimate(|points| profiles::grain_curvature(run, points, above));
        let metric = channel::observed(quantity, &variant, estimate, 1.0);
        let source = "statement of the paper: concave above the top of the bed (−), convex below (+)";
        let reason =
            "the sign is what the paper states; a profile with too few points for a curvature does not show it";
        metrics.push(metric.against(None, source, Confidence::Medium).gated_by(judged.then_some(limit), reason));
    }
    let drag = data.drag_profile();
    let peak = drag
        .iter()
        .copied()
        .fold((f64::NAN, f64::NEG_INFINITY), |best, point| if point.1 > best.1 { point } else { best });
    metrics.push(DRAG_PEAK_HEIGHT.of(&variant, 1e3 * peak.0).with_snapshot_tolerance(0.1, 1.0));
}

pub(super) fn continuum(
    metrics: &mut Vec<Metric>,
    run: &BedLoadRun,
    record: &Recorded<BedLoadObservation>,
    own: &ContinuumRun,
    forgotten: bool,
) {
    let stage = own.stage;
    let variant = run.variant();
    let data = &record.data;
    let Some(layer) = &data.layer else { return };
    metrics.push(channel::particles_lost(&variant, &record.clone().map(|data| data.channel)));
    common(metrics, run, record, forgotten);
    metrics.push(
        channel::MOMENTUM_RESIDUAL
            .of(&variant, data.channel.momentum.residual())
            .against(
                Some(0.0),
                "change of momentum = gravity − what held grains and floor take; particles that cross a gradient of φ \
                 change the share of their mass that counts",
                Confidence::Exact,
            )
            .gated(
                Limit::Within(-0.01, 0.01),
                "drag and pressure move momentum between water and grains only; a hundredth for particles that cross a gradient of φ",
            )
            .with_snapshot_tolerance(0.1, 1e-3),
    );
    let source = "the 1-D layer of the same closures; the water starts at `start` times its velocity";
    let judged = own.is_judged() && (forgotten || (own.start == 1.0 && is_settled(run, data)));
    let gated = |metric: Metric, holds: bool, limit, reason: &str| {
        if judged && holds { metric.gated(limit, reason) } else { metric }
    };
    let profile = &data.channel.profile;
    let rms = profile.estimate(|points| profiles::fluid_rms(run, points, layer));
    let metric = channel::observed(FLUID_VELOCITY_RMS, &variant, rms, 1.0).exactly(0.0, source);
    let (most, reason) = match stage {
        Stage::Dilating => {
            (0.1, "a profile shifted by a twelfth of a spacing of 1 mm, as columns have it at all spacings")
        }
        Stage::Porous | Stage::Frozen => {
            (0.25, "a profile shifted by a fifth of a spacing of 1 mm where it is steepest, 1.4 u_* a mm")
        }
    };
    metrics.push(gated(metric, true, Limit::AtMost(most), reason));
    let mean = profile.estimate(|points| profiles::fluid_mean(run, points, layer));
    let metric = channel::observed(FLUID_VELOCITY_MEAN, &variant, mean, 1.0).exactly(1.0, source);
    metrics.push(gated(metric, true, Limit::Within(0.97, 1.03), "the same shift over a depth mean of 10 u_*"));
    if stage == Stage::Porous {
        return;
    }
    let rms = data.sediment.estimate(|points| profiles::grain_rms(run, points, layer));
    let metric = channel::observed(GRAIN_VELOCITY_RMS, &variant, rms, 1.0).exactly(0.0, source);
    metrics.push(gated(
        metric,
        stage == Stage::Frozen,
        Limit::AtMost(0.2),
        "the grains' profile, 0.7 u_* a mm, shifted by a third of a spacing of 1 mm",
    ));
    let force = profiles::drag_ratio(&data.drag_profile(), layer);
    let metric = DRAG_RATIO.of(&variant, force).exactly(1.0, source).with_snapshot_tolerance(0.0, 0.02);
    metrics.push(gated(
        metric,
        stage == Stage::Dilating,
        Limit::Within(0.95, 1.05),
        "grains take over the stress of the water whatever their profile is; a twentieth for bins that the bed's top cuts",
    ));
    if stage == Stage::Dilating && forgotten {
        let formula = TransportFormula::WongParker;
        let expected = formula.transport(run.stream().shields_number());
        let predicted = channel::observed(PREDICTED_TRANSPORT, &variant, data.channel.average(&data.transport), 1.0);
        metrics.push(predicted.against(Some(expected), formula.name(), formula.confidence()).gated(
            Limit::Within(MEASURED_BAND.0 * expected, MEASURED_BAND.1 * expected),
            "nine tenths of the runs that Meyer-Peter & Müller measured from τ* = 0.1 on lie there; no parameter is fitted to it",
        ));
    }
    let ratio = data.channel.average(&data.transport);
    let (within, reason) = match stage {
        Stage::Dilating if own.spacing < FINE => (0.08, "half of what a spacing of 1 mm is given"),
        Stage::Dilating => (0.15, "the layer that moves is a few spacings thick, at 2 % one or two"),
        Stage::Porous | Stage::Frozen => (0.1, "the grains' profile shifted by a third of a spacing of 1 mm"),
    };
    let metric = channel::observed(TRANSPORT_RATIO, &variant, ratio, 1.0 / layer.transport()).exactly(1.0, source);
    metrics.push(gated(metric, true, Limit::Within(1.0 - within, 1.0 + within), reason));
    grains(metrics, run, data, forgotten && stage == Stage::Dilating);
}
