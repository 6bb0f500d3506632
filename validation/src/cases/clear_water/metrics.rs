//! How the runs are judged.

use super::Record;
use super::parameters::{ClearWaterRun, Period};
use crate::case::Run;
use crate::cases::channel::{self, ChannelObservation, ProfilePoint};
use crate::metric::{Confidence, Limit, Metric};
use crate::observation::Recorded;
use crate::reference::RoughChannel;
use crate::statistics::{Estimate, block_average, linear_fit};

/// Standard errors that a value may move before a change is reported `[-]`.
const SNAPSHOT_ERRORS: f64 = 2.0;

/// Heights over the depth between which the profile is compared `[-]`.
const COMPARED: (f64, f64) = (0.1, 0.9);

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records {
        of_run(&mut metrics, run, record);
    }
    metrics
}

fn of_run(metrics: &mut Vec<Metric>, run: &ClearWaterRun, record: &Recorded<ChannelObservation>) {
    let variant = run.variant();
    let data = &record.data;
    let law = run.reference();
    metrics.push(channel::particles_lost(&variant, record));
    metrics.push(channel::momentum_residual(&variant, record));
    let stationary = matches!(run.period, Period::Stationary { .. });
    if let Period::Stationary { at_most, .. } = run.period {
        let since = data.stationary_since.unwrap_or(f64::NAN);
        metrics.push(
            Metric::observed("stationary_after", &variant, since, "s")
                .against(
                    None,
                    "depth mean changes by less than the tolerance over U/(2 g i), times in a row",
                    Confidence::Exact,
                )
                .gated(
                    Limit::AtMost(at_most * law.adjustment_time()),
                    "averages are those of a stationary flow, or the criterion is not met",
                )
                .with_snapshot_tolerance(0.0, law.adjustment_time()),
        );
    }
    let observed = |name: &str, estimate: Estimate, factor: f64, unit: &str| {
        Metric::observed(name, &variant, factor * estimate.value, unit)
            .with_snapshot_tolerance(1e-3, SNAPSHOT_ERRORS * factor * estimate.standard_error)
    };
    // only a stationary flow is judged by the logarithmic law
    let gated =
        |metric: Metric, limit: Limit, reason: &str| if stationary { metric.gated(limit, reason) } else { metric };

    let rms = observed("velocity_rms", data.profile.estimate(|points| rms(&law, points)), 1.0, "u_*").against(
        Some(0.0),
        "logarithmic law, over 0.1 h … 0.9 h",
        Confidence::Exact,
    );
    metrics.push(gated(rms, Limit::AtMost(0.25), "a quarter of u_*, 2 % of the depth mean"));
    let slope = observed("semi_log_slope", data.profile.estimate(|points| slope(&law, points)), 1.0, "-").against(
        Some(1.0),
        "u_*/κ, fitted to u over ln z′ in 0.1 h … 0.9 h",
        Confidence::Exact,
    );
    metrics.push(gated(slope, Limit::Within(0.97, 1.03), "3 % of the slope of the logarithmic law"));
    let average = |array: &[f64]| {
        block_average(&data.series.within(array, data.window))
            .unwrap_or(Estimate { value: f64::NAN, standard_error: 0.0 })
    };
    let shear = observed("bed_shear", average(&data.series.bed_shear), 1.0 / law.bed_shear_stress(), "-").against(
        Some(1.0),
        "ρ g h i",
        Confidence::Exact,
    );
    metrics.push(gated(shear, Limit::Within(0.97, 1.03), "3 %: the bed carries the weight along the slope"));
    metrics.push(
        observed("mean_velocity", average(&data.series.mean_velocity), 1.0 / law.mean_velocity(), "-").against(
            Some(1.0),
            "depth mean of the logarithmic law",
            Confidence::Exact,
        ),
    );
    metrics.push(
        Metric::observed("velocity_drift", &variant, 100.0 * drift(&law, data), "%")
            .against(
                Some(0.0),
                "change of the depth mean over U/(2 g i), by a line through the window",
                Confidence::Exact,
            )
            .with_snapshot_tolerance(0.2, 0.1),
    );
    let height = average(&data.series.relative_height);
    metrics.push(observed("height_change", Estimate { value: height.value - 1.0, ..height }, 100.0, "%").against(
        Some(0.0),
        "mean height h/2: water keeps its volume",
        Confidence::Exact,
    ));
    metrics.push(observed("pressure_l2", average(&data.series.pressure_error), 100.0, "%").against(
        Some(0.0),
        "hydrostatic pressure ρ g (h − z) at every particle",
        Confidence::Exact,
    ));
}

/// The points that are compared.
fn compared<'a>(law: &'a RoughChannel, points: &'a [ProfilePoint]) -> impl Iterator<Item = &'a ProfilePoint> {
    points.iter().filter(|point| (COMPARED.0..=COMPARED.1).contains(&(point.height / law.depth)))
}

/// Root mean square of u − u_log over the bins, over u_* `[-]`.
fn rms(law: &RoughChannel, points: &[ProfilePoint]) -> f64 {
    let (sum, count) = compared(law, points).fold((0.0, 0.0), |(sum, count), point| {
        (sum + (point.velocity - law.velocity(point.height)).powi(2), count + 1.0)
    });
    (sum / count).sqrt() / law.friction_velocity()
}

/// Slope of u over ln z′, over u_*/κ `[-]`.
fn slope(law: &RoughChannel, points: &[ProfilePoint]) -> f64 {
    let semi_logarithmic: Vec<(f64, f64)> =
        compared(law, points).map(|point| (law.logarithm(point.height), point.velocity)).collect();
    linear_fit(&semi_logarithmic).map_or(f64::NAN, |fit| fit.slope / law.semi_logarithmic_slope())
}

/// Relative change of the depth mean over the law's adjustment time `[-]`.
fn drift(law: &RoughChannel, data: &ChannelObservation) -> f64 {
    let series = &data.series;
    let points: Vec<(f64, f64)> = series
        .within(&series.time, data.window)
        .into_iter()
        .zip(series.within(&series.mean_velocity, data.window))
        .collect();
    linear_fit(&points).map_or(f64::NAN, |fit| fit.slope * law.adjustment_time() / law.mean_velocity())
}
