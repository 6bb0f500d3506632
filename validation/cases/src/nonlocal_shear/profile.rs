//! What all profiles are judged by: the length of a decay, and the velocity.

use super::flow::ExactShear;
use super::probe::ShearObservation;
use super::quantities::{COARSE, EXACT, LENGTH_ERROR, LENGTH_REASON, VELOCITY_L2};
use super::run::ShearRun;
use crate::case::Run;
use crate::metric::{Limit, Metric};
use crate::statistics::{Regression, linear_regression, relative_l2};

/// The line through the logarithm of velocities between two depths below that at which the local law is at rest, in diameters.
pub(super) fn tail(
    run: &ShearRun,
    exact: &ExactShear,
    (upper, lower): (f64, f64),
    velocities: impl Iterator<Item = (f64, f64)>,
) -> Option<Regression> {
    let diameter = run.grains.law.grain_diameter;
    let depths = velocities.map(|(y, velocity)| (run.flow.distance(y), velocity));
    let inside = depths.filter(|(depth, _)| {
        let below = (depth - exact.yield_distance()) / diameter;
        below >= upper && below <= lower
    });
    linear_regression(&inside.map(|(depth, velocity)| (depth, libm::log(velocity))).collect::<Vec<_>>())
}

pub(super) fn length_metric(metric: Metric, expected: f64, run: &ShearRun) -> Metric {
    let allowed = LENGTH_ERROR * COARSE / run.particles_per_diameter as f64;
    let limit = Limit::Within((1.0 - allowed) * expected, (1.0 + allowed) * expected);
    metric.exactly(expected, EXACT).gated(limit, LENGTH_REASON).with_snapshot_tolerance(5e-3, 0.0)
}

pub(super) fn velocity_l2(run: &ShearRun, seen: &ShearObservation, exact: &ExactShear) -> Metric {
    let misfit = velocity_misfit(seen, exact);
    VELOCITY_L2.of(&run.variant(), 100.0 * misfit).exactly(0.0, EXACT).with_snapshot_tolerance(5e-2, 1e-2)
}

/// Relative L2 of the velocity profile `[-]`.
pub(super) fn velocity_misfit(seen: &ShearObservation, exact: &ExactShear) -> f64 {
    relative_l2(seen.velocities().into_iter().map(|(y, velocity)| (velocity, exact.velocity(y))))
}
