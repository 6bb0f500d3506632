//! How the runs are judged.

use super::StillWaterRecord;
use crate::case::Flow;
use crate::channel;
use crate::metric::{Confidence, Limit, Metric, quantities};

quantities! {
    [channel::PARTICLES_LOST, channel::VELOCITY_ITERATIONS, channel::PRESSURE_ITERATIONS, channel::HEIGHT_CHANGE, channel::PRESSURE_L2]
    RMS_VERTICAL_VELOCITY: verified("rms_vertical_velocity", "m/s", "root mean square of the vertical velocity"),
    BLOW_UP_TIME:
        verified("blow_up_time", "s", "time at which a particle of the column without stabilisation passes 1.2 h, or at which it diverges"),
}

/// Time after which the water is expected to be at rest `[s]`.
const AT_REST_AFTER: f64 = 15.0;

/// Height over the depth above which a particle was thrown there `[-]`.
const SPRAY: f64 = 1.2;

pub(super) fn all(records: &[StillWaterRecord]) -> Vec<Metric> {
    let (failed, held): (Vec<&StillWaterRecord>, Vec<&StillWaterRecord>) =
        records.iter().partition(|(run, _)| run.is_unstabilised());
    held.into_iter().flat_map(stabilised).chain(failed.into_iter().map(blow_up)).collect()
}

fn stabilised((run, record): &StillWaterRecord) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data);
    // what is 0 has no relative drift
    let floored = |metric: Metric, floor: f64| {
        let noise = metric.snapshot_floor;
        metric.with_snapshot_tolerance(0.0, noise.max(floor))
    };
    let height = channel::height_change(&variant, data, "mean height h/2: water keeps its volume");
    let rms = data.average(&data.series.rms_vertical_velocity);
    let velocity = floored(channel::observed(RMS_VERTICAL_VELOCITY, &variant, rms, 1.0), 1e-5).exactly(0.0, "rest");
    let short = run.duration < AT_REST_AFTER;
    let (pressure, reason) = match (short, run.water.resolution) {
        (true, 23) => (0.35, "0.35 %: 0.19 and 0.27 % were measured with 23 particle rows, while perturbations decay"),
        (true, _) => (0.5, "0.5 %: 0.19 to 0.40 % was measured while initial perturbations decay"),
        _ => (0.7, "0.7 %: 0.41 to 0.54 % was measured in columns at rest"),
    };
    let mut metrics = vec![
        channel::particles_lost(&variant, record),
        floored(height, 1e-3).gated(Limit::Within(-0.1, 0.1), "0.1 % of the mean height: water keeps its volume"),
        if run.duration >= AT_REST_AFTER {
            velocity.gated(Limit::AtMost(5e-4), "0.1 % of √(g h), averaged over the last window")
        } else {
            // the displaced start still dies away
            Metric { snapshot_tolerance: 0.3, ..velocity }
        },
        floored(channel::pressure_l2(&variant, data), 0.01).gated(Limit::AtMost(pressure), reason),
    ];
    let known = if run.jitter > 0.2 { 1.95 } else { 1.05 };
    metrics.extend(channel::iterations(&variant, data, [None, short.then_some(known)]));
    metrics
}

/// When a column without stabilisation has blown up `[s]`: a particle above 1.2 h, or a divergence; else the whole time.
fn blow_up((run, record): &StillWaterRecord) -> Metric {
    let series = &record.data.series;
    let sprayed = series.time.iter().zip(&series.highest).find(|(_, height)| **height >= SPRAY);
    let time = sprayed.map_or(record.simulated_time, |(time, _)| *time);
    let limit = 0.5 * run.duration;
    BLOW_UP_TIME
        .of(&run.variant(), time)
        .against(None, "a particle above 1.2 h or a divergence; the stabilised run has neither", Confidence::Exact)
        .gated(Limit::AtMost(limit), "half of the run: this control, without stabilisation, must diverge by then")
        // what sprays is chaotic
        .with_snapshot_tolerance(0.0, 0.5 * limit)
}
