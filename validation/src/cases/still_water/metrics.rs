//! How the runs are judged.

use super::Record;
use super::parameters::StillWaterRun;
use crate::case::Run;
use crate::cases::channel::{self, ChannelObservation};
use crate::metric::{Confidence, Limit, Metric, Quantity};
use crate::observation::Recorded;
use crate::statistics::{Estimate, block_average};

const HEIGHT_CHANGE: Quantity = Quantity::verified("height_change", "%", "mean height over half the depth, less 1");
const RMS_VERTICAL_VELOCITY: Quantity =
    Quantity::verified("rms_vertical_velocity", "m/s", "root mean square of the vertical velocity");
const PRESSURE_L2: Quantity =
    Quantity::verified("pressure_l2", "%", "relative L2 of the pressure against the hydrostatic one");
const BLOW_UP_TIME: Quantity = Quantity::verified(
    "blow_up_time",
    "s",
    "when a column without stabilisation threw a particle above 1.2 h or diverged",
);

pub(super) const QUANTITIES: &[Quantity] =
    &[channel::PARTICLES_LOST, HEIGHT_CHANGE, RMS_VERTICAL_VELOCITY, PRESSURE_L2, BLOW_UP_TIME];

/// Time after which the water is expected to be at rest `[s]`.
const AT_REST_AFTER: f64 = 15.0;

/// Standard errors that a value may move before a change is reported `[-]`.
const SNAPSHOT_ERRORS: f64 = 2.0;

/// Height over the depth above which a particle was thrown there `[-]`.
const SPRAY: f64 = 1.2;

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records.iter().filter(|(run, _)| !run.unstabilised) {
        stabilised(&mut metrics, run, record);
    }
    metrics.extend(records.iter().filter(|(run, _)| run.unstabilised).map(blow_up));
    metrics
}

fn stabilised(metrics: &mut Vec<Metric>, run: &StillWaterRun, record: &Recorded<ChannelObservation>) {
    let variant = run.variant();
    let data = &record.data;
    metrics.push(channel::particles_lost(&variant, record));
    let average = |array: &[f64]| {
        block_average(&data.series.within(array, data.window))
            .unwrap_or(Estimate { value: f64::NAN, standard_error: 0.0 })
    };
    let observed = |quantity: Quantity, estimate: Estimate, factor: f64, floor: f64| {
        quantity
            .of(&variant, factor * estimate.value)
            .with_snapshot_tolerance(0.0, (SNAPSHOT_ERRORS * factor * estimate.standard_error).max(floor))
    };
    let height = average(&data.series.relative_height);
    metrics.push(
        observed(HEIGHT_CHANGE, Estimate { value: height.value - 1.0, ..height }, 100.0, 1e-3)
            .against(Some(0.0), "mean height h/2: water keeps its volume", Confidence::Exact)
            .gated(Limit::Within(-0.1, 0.1), "0.1 % of the mean height, averaged over the last window"),
    );
    let velocity = observed(RMS_VERTICAL_VELOCITY, average(&data.series.rms_vertical_velocity), 1.0, 1e-5).against(
        Some(0.0),
        "rest",
        Confidence::Exact,
    );
    metrics.push(if run.duration >= AT_REST_AFTER {
        velocity.gated(Limit::AtMost(5e-4), "a thousandth of √(g h), averaged over the last window")
    } else {
        // the displaced start still dies away
        Metric { snapshot_tolerance: 0.3, ..velocity }
    });
    metrics.push(
        observed(PRESSURE_L2, average(&data.series.pressure_error), 100.0, 0.01)
            .against(Some(0.0), "hydrostatic pressure ρ g (h − z) at every particle", Confidence::Exact)
            .gated(Limit::AtMost(1.0), "1 % of the hydrostatic profile, averaged over the last window"),
    );
}

/// When a column without stabilisation has blown up `[s]`: a particle above 1.2 h, or a divergence; else the whole time.
fn blow_up((run, record): &Record) -> Metric {
    let series = &record.data.series;
    let sprayed = series.time.iter().zip(&series.highest).find(|(_, height)| **height >= SPRAY);
    let time = sprayed.map_or(record.simulated_time, |(time, _)| *time);
    let limit = 0.5 * run.duration;
    BLOW_UP_TIME
        .of(&run.variant(), time)
        .against(None, "a particle above 1.2 h or a divergence; the stabilised run has neither", Confidence::Exact)
        .gated(Limit::AtMost(limit), "without stabilisation the column must blow up: shows that the test can fail")
        // what sprays is chaotic
        .with_snapshot_tolerance(0.0, 0.5 * limit)
}
