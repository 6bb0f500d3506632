//! How the runs are judged.

use super::ClearWaterRecord;
use super::flow::Period;
use crate::case::Flow;
use crate::channel::{self, ProfilePoint};
use crate::metric::{Confidence, Limit, Metric, Origin, quantities};
use crate::reference::water::RoughChannel;
use crate::shared::printed_laws;
use crate::statistics::linear_fit;

quantities! {
    [
        channel::PARTICLES_LOST, channel::VELOCITY_ITERATIONS, channel::PRESSURE_ITERATIONS, channel::MOMENTUM_RESIDUAL,
        channel::BED_SHEAR, channel::HEIGHT_CHANGE, channel::PRESSURE_L2, printed_laws::LAW_ERROR,
    ]
    STATIONARY_AFTER: verified("stationary_after", "s", "time at which the depth average becomes stationary by the criterion"),
    VELOCITY_RMS: verified("velocity_rms", "u_*", "√⟨(u − u_log)²⟩ over 0.1 h … 0.9 h"),
    SEMI_LOG_SLOPE:
        verified("semi_log_slope", "-", "slope of the velocity over the logarithm of the height, over u_*/κ"),
    MEAN_VELOCITY: verified("mean_velocity", "-", "depth-averaged velocity over that of the logarithmic law"),
}

/// What the spacing moves a quantity by, times the rows over the depth: of first order, from 3 % runs of 23, 33 and 46 rows
/// and in the quantity's unit. The depth mean was 0.9905, 0.9932 and 0.9967 of the law's, the root mean square 0.129, 0.090
/// and 0.048 u_*, the slope 1.008, 1.009 and 1.008, the friction of the bed 1.010, 1.007 and 1.003.
const MOVED: SpacingErrors = SpacingErrors { mean: 0.29, rms: 3.7, slope: 0.05, shear: 0.34 };

struct SpacingErrors {
    mean: f64,
    rms: f64,
    slope: f64,
    shear: f64,
}

/// Heights over the depth between which the profile is compared `[-]`.
const COMPARED: (f64, f64) = (0.1, 0.9);

pub(super) fn of_run((run, record): &ClearWaterRecord) -> Vec<Metric> {
    let (variant, data, law) = (run.variant(), &record.data, run.reference());
    let mut metrics = vec![channel::particles_lost(&variant, record), channel::momentum_residual(&variant, record)];
    let stationary = matches!(run.period, Period::Stationary { .. });
    metrics.extend(channel::iterations(&variant, data, if stationary { [None; 2] } else { [Some(1.0), Some(2.93)] }));
    if let Period::Stationary { at_most, .. } = run.period {
        let source = "depth mean changes by less than the tolerance over U/(2 g i), times in a row";
        let limit = Limit::AtMost(at_most * law.adjustment_time());
        let since = STATIONARY_AFTER.of(&variant, data.stationary_since.unwrap_or(f64::NAN));
        metrics.push(
            since
                .against(None, source, Confidence::Exact)
                .gated(limit, "averages are valid only for a stationary flow, which this tests")
                .with_snapshot_tolerance(0.0, law.adjustment_time()),
        );
    }
    // a flow that started with the law is to keep it; one that started slower is judged once it is stationary
    let judged = |limit: Limit| (stationary || run.start_share == 1.0).then_some(limit);
    let observed = |quantity, estimate, factor| channel::observed(quantity, &variant, estimate, factor);
    let known = |metric: Metric, moved: f64| {
        let standard = 0.5 * moved / run.water.resolution as f64;
        let source = "first order in the spacing, from runs of 23, 33 and 46 rows";
        metric.known_to(Origin::Numerical, Some(standard), source)
    };
    let mean = data.average(&data.series.mean_velocity);
    metrics.extend([
        known(observed(VELOCITY_RMS, data.profile.estimate(|points| rms(&law, points)), 1.0), MOVED.rms)
            .exactly(0.0, "logarithmic law, over 0.1 h … 0.9 h")
            .gated_by(judged(Limit::AtMost(0.25)), "0.25 u_* (friction velocity): 2 % of the depth-averaged velocity"),
        known(observed(SEMI_LOG_SLOPE, data.profile.estimate(|points| slope(&law, points)), 1.0), MOVED.slope)
            .exactly(1.0, "u_*/κ, fitted to u over ln z′ in 0.1 h … 0.9 h")
            .gated_by(judged(Limit::Within(0.97, 1.03)), "3 % of the logarithmic law's slope: 1 % was measured"),
        known(channel::bed_shear(&variant, data, law.bed_shear_stress()), MOVED.shear)
            .gated_by(judged(Limit::Within(0.97, 1.03)), "3 % of the weight along the slope: 1 % was measured"),
        known(observed(MEAN_VELOCITY, mean, 1.0 / law.mean_velocity()), MOVED.mean)
            .exactly(1.0, "depth mean of the logarithmic law")
            .gated_by(judged(Limit::Within(0.97, 1.03)), "3 % of the logarithmic law's mean: 1 % was measured"),
        channel::height_change(&variant, data, "mean height h/2: water keeps its volume"),
        channel::pressure_l2(&variant, data),
    ]);
    metrics
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
