//! Quantities and metrics that the cases of a channel share.

use super::ChannelObservation;
use crate::metric::{Limit, Metric, Origin, Quantity, Variant, quantities};
use crate::observation::Recorded;
use crate::statistics::{Average, FittedValue, block_average, linear_fit};

quantities! {
    shared pub(crate)
    PARTICLES_LOST:
        accounted("particles_lost", "-", "particles that ended below the floor or far above the surface"),
    MOMENTUM_RESIDUAL: accounted(
        "momentum_residual", "-",
        "|ΔP − impulses of gravity and bed friction| over the impulse of the weight along the slope",
    ),
    HEIGHT_CHANGE: verified("height_change", "%", "mean height over half the depth, minus 1"),
    PRESSURE_L2: verified("pressure_l2", "%", "relative L2 error of pressure against the hydrostatic profile"),
    BED_SHEAR: verified("bed_shear", "-", "bed friction over the weight component along the bed"),
    VELOCITY_ITERATIONS: accounted("velocity_iterations", "-", "iterations of the implicit velocities, mean over all steps"),
    PRESSURE_ITERATIONS: accounted("pressure_iterations", "-", "iterations of the pressure, mean over all steps"),
}

/// Standard errors that a value may move before a change is reported `[-]`.
const SNAPSHOT_ERRORS: f64 = 2.0;

/// Iterations that a solve may take, over those that it is known to take `[-]`.
const MORE_ITERATIONS: f64 = 1.1;

const ITERATIONS_REASON: &str = "10 % above the measured iterations; 1.8 times as many if velocity starts from zero, 2.4 times without pressure preconditioner";

impl ChannelObservation {
    /// Mean of a series over the window, with its statistical error; not a number where the run did not get there.
    pub fn average(&self, array: &[f64]) -> FittedValue {
        block_average(&self.series.within(array, self.window))
            .map_or(FittedValue { value: f64::NAN, standard_error: 0.0 }, Average::estimate)
    }

    /// Slope of a line through a series over the window, in its unit per second.
    pub fn trend(&self, array: &[f64]) -> f64 {
        let time = self.series.within(&self.series.time, self.window);
        let points: Vec<(f64, f64)> = time.into_iter().zip(self.series.within(array, self.window)).collect();
        linear_fit(&points).map_or(f64::NAN, |fit| fit.slope)
    }
}

/// A quantity from an average in other units, which may drift by its statistical error.
pub fn observed(quantity: Quantity, variant: &Variant, estimate: FittedValue, factor: f64) -> Metric {
    let noise = (SNAPSHOT_ERRORS * factor * estimate.standard_error).abs();
    let scatter = (factor * estimate.standard_error).abs();
    let source = "standard error of the mean over blocks of the averaging window";
    let metric = quantity.of(variant, factor * estimate.value).with_snapshot_tolerance(1e-3, noise);
    metric.known_to(Origin::Repeat, Some(scatter), source)
}

/// The number of particles that ended below the floor or far above the surface, gated at 0.
pub fn particles_lost(variant: &Variant, record: &Recorded<ChannelObservation>) -> Metric {
    PARTICLES_LOST
        .of(variant, record.data.particles_lost as f64)
        .exactly(0.0, "no particle passes a wall")
        .gated(Limit::AtMost(0.0), "0: a particle below the floor is lost mass")
}

/// How far momentum along the floor closes over the averaging window, over the impulse of the slope `[-]`, gated.
pub fn momentum_residual(variant: &Variant, record: &Recorded<ChannelObservation>) -> Metric {
    MOMENTUM_RESIDUAL
        .of(variant, record.data.momentum.residual())
        .exactly(0.0, "change of momentum = gravity − friction of the bed, summed over every step")
        .gated(
            Limit::Within(-2e-12, 2e-12),
            "2e-12: double-precision rounding, 1e-16 per term, expected over ten thousand steps; pairs exchange opposite impulses",
        )
        .with_snapshot_tolerance(0.0, 1e-11)
}

/// Iterations of the velocities and of the pressure a step `[-]`, gated where it is known how many they take.
pub fn iterations(variant: &Variant, data: &ChannelObservation, known: [Option<f64>; 2]) -> Vec<Metric> {
    let solves = [VELOCITY_ITERATIONS, PRESSURE_ITERATIONS].into_iter().zip(data.iterations).zip(known);
    let metric = |((quantity, found), known): ((Quantity, Option<f64>), Option<f64>)| {
        let limit = known.map(|count| Limit::AtMost(MORE_ITERATIONS * count));
        Some(quantity.of(variant, found?).gated_by(limit, ITERATIONS_REASON).with_snapshot_tolerance(0.05, 0.0))
    };
    solves.filter_map(metric).collect()
}

/// Mean height over half the depth, less 1 `[%]`, with why it matters.
pub fn height_change(variant: &Variant, data: &ChannelObservation, source: &str) -> Metric {
    let height = data.average(&data.series.relative_height);
    let change = FittedValue { value: height.value - 1.0, ..height };
    observed(HEIGHT_CHANGE, variant, change, 100.0).exactly(0.0, source)
}

/// Relative L2 of the pressure `[%]`.
pub fn pressure_l2(variant: &Variant, data: &ChannelObservation) -> Metric {
    let source = "hydrostatic pressure ρ g (h − z) at every particle";
    observed(PRESSURE_L2, variant, data.average(&data.series.pressure_error), 100.0).exactly(0.0, source)
}

/// Friction of the bed over the weight's part along it, which is given `[Pa]`.
pub fn bed_shear(variant: &Variant, data: &ChannelObservation, weight: f64) -> Metric {
    let shear = data.average(&data.series.bed_shear);
    observed(BED_SHEAR, variant, shear, 1.0 / weight).exactly(1.0, "ρ g h i")
}
