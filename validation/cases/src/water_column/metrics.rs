//! How the runs are judged.

use super::Record;
use super::flow::{ColumnObservation, WaterColumnFlow};
use crate::case::Flow;
use crate::metric::{Limit, Metric, Origin, quantities};
use crate::reference::water::{HEIGHT_READING, MeasuredFront, MeasuredHeights, WATER_HEIGHTS, spread_of_water_fronts};
use crate::setup::energy_ledger::{self, CORRECTION_WORK, ENERGY_RESIDUAL, ENERGY_RISE, EnergyScale, WALL_WORK};
use crate::statistics::{Extrapolation, interpolated};

quantities! {
    [ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK, CORRECTION_WORK]
    FRONT_ERROR: validated("front_error", "%", "root mean square of the front's relative error at the measured times"),
    FRONT_DELAY: validated("front_delay", "√(a/2g)", "best-fit delay of the measured front"),
    DELAYED_FRONT_ERROR: validated("delayed_front_error", "%", "error of the front, with measured times shifted by `front_delay`"),
    HEIGHT_ERROR: validated("height_error", "%", "√⟨(h − h_measured)²⟩ of the height at the wall, over the initial height"),
    DELAYED_HEIGHT_ERROR:
        validated("delayed_height_error", "%", "√⟨(h − h_measured)²⟩ of the height at the wall, with measured times shifted by the delay of the front"),
}

/// A row of twenty over the width of a column twice as high, of its height `[%]`.
const ROW: f64 = 2.5;

const READINGS: &str = "readings of the figure agree with the table within 0.03 in x/a (0.005 for a vector figure), \
                        taken as half width of a uniform distribution; rms over the measured positions";

const SPREAD: &str = "rms relative difference of four fronts by other experimenters and readers from the table";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    records.iter().flat_map(of_run).collect()
}

fn of_run((run, record): &Record) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data);
    let mut metrics = energy_ledger::metrics(&variant, &data.energy, EnergyScale::Fall);
    let measured = run.measured();
    let observed = |quantity: crate::metric::Quantity, value: f64| {
        quantity.of(&variant, value).against(Some(0.0), &measured.source, measured.confidence)
    };
    let (delay, error) = best_delay(&data.time, &data.front, measured);
    let reading = Some(100.0 * measured.relative_reading());
    // the release of a column that is said to be free took a time of its own, which nobody has measured: only a gate that moves as it did judges
    let limit = run.is_gated().then_some(Limit::AtMost(8.0));
    // what experiments of free columns differ by; of the gated one no other is at hand
    let spread = (!run.is_gated()).then(|| 100.0 * spread_of_water_fronts());
    metrics.extend([
        observed(FRONT_ERROR, 100.0 * error_at(&data.time, &data.front, measured, 0.0))
            .gated_by(limit, "8 % of the measured front position, with lift gate and times as measured")
            .known_to(Origin::Digitisation, reading, READINGS)
            .known_to(Origin::Experiment, spread, SPREAD)
            .with_snapshot_tolerance(0.05, 0.2),
        observed(FRONT_DELAY, delay).with_snapshot_tolerance(0.05, 0.02),
        // with a delay that is fitted to it, it validates nothing
        observed(DELAYED_FRONT_ERROR, 100.0 * error)
            .known_to(Origin::Digitisation, reading, READINGS)
            .with_snapshot_tolerance(0.2, 0.3),
    ]);
    metrics.extend(heights(run, data, delay));
    metrics
}

/// The heights at the wall, at the times as they were measured and with the delay that the front tells. Nothing is fitted to them, and
/// they tell what that delay is not: if the whole column had started later, so would they.
fn heights(run: &WaterColumnFlow, data: &ColumnObservation, delay: f64) -> Vec<Metric> {
    let same = |own: &&MeasuredHeights| own.aspect_ratio == run.aspect_ratio;
    let Some(measured) = WATER_HEIGHTS.iter().find(same).filter(|_| !data.height.is_empty()) else { return Vec::new() };
    let samples: Vec<(f64, f64)> = data.time.iter().copied().zip(data.height.iter().copied()).collect();
    // the release of their column was no gate's
    let is_free = !run.is_gated();
    let row = Some(100.0 / (run.aspect_ratio * run.resolution as f64) / 12.0_f64.sqrt());
    let metric = |quantity: crate::metric::Quantity, delay: f64| {
        quantity
            .of(&run.variant(), 100.0 * height_error(&samples, measured, delay))
            .against(Some(0.0), &measured.source, measured.confidence)
            .known_to(Origin::Digitisation, Some(100.0 * HEIGHT_READING), "half of the last digit (uniform)")
            .known_to(Origin::Numerical, row, "the surface of particles is known within one row (uniform distribution)")
            .with_snapshot_tolerance(0.1, 0.1)
    };
    let reason = "2.5 %: one of 40 particle rows over the height; measured times, nothing fitted";
    let mut metrics = vec![metric(HEIGHT_ERROR, 0.0).gated_by(is_free.then_some(Limit::AtMost(ROW)), reason)];
    if is_free {
        metrics.push(metric(DELAYED_HEIGHT_ERROR, delay));
    }
    metrics
}

/// Root mean square of the height less the measured one at the measured times less a delay, as long as the run lasts `[-]`; the
/// column stood as it starts before.
fn height_error(samples: &[(f64, f64)], measured: &MeasuredHeights, delay: f64) -> f64 {
    let at = |time: f64| interpolated(samples, time, (Extrapolation::EndValue, Extrapolation::Nothing));
    let squares: Vec<f64> =
        measured.points.iter().filter_map(|&(time, height)| Some((at(time - delay)? - height).powi(2))).collect();
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// Root mean square of x/x_measured − 1 at the measured times less a delay `[-]`; the column stood as it starts before.
fn error_at(time: &[f64], front: &[f64], measured: &MeasuredFront, delay: f64) -> f64 {
    let points = &measured.points;
    let samples: Vec<(f64, f64)> = time.iter().copied().zip(front.iter().copied()).collect();
    let at =
        |time: f64| interpolated(&samples, time, (Extrapolation::EndValue, Extrapolation::Nothing)).unwrap_or(f64::NAN);
    let square = |&(t, x): &(f64, f64)| (at(t - delay) / x - 1.0).powi(2);
    (points.iter().map(square).sum::<f64>() / points.len() as f64).sqrt()
}

/// Delay with the least error, to a hundredth, and that error.
fn best_delay(time: &[f64], front: &[f64], measured: &MeasuredFront) -> (f64, f64) {
    let tried = (-50..=50).map(|k| f64::from(k) / 100.0).map(|delay| (delay, error_at(time, front, measured, delay)));
    tried.fold((0.0, f64::INFINITY), |best, other| if other.1 < best.1 { other } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::water::WATER_FRONT;

    #[test]
    fn heights_that_are_the_measured_ones_have_no_error_and_late_ones_do() {
        let measured = &WATER_HEIGHTS[1];
        assert!(height_error(&measured.points, measured, 0.0) < 1e-15);
        // the run ends before the last measured times, which then do not count
        assert!(height_error(&measured.points[..8], measured, 0.0) < 1e-15);
        let early: Vec<(f64, f64)> = measured.points.iter().map(|(t, h)| (t - 0.2, *h)).collect();
        assert!(height_error(&early, measured, 0.2) < 1e-12 && height_error(&early, measured, 0.0) > 0.02);
    }

    #[test]
    fn a_front_that_starts_early_has_the_delay_and_no_error_with_it() {
        let (time, front): (Vec<f64>, Vec<f64>) = WATER_FRONT.points.iter().map(|(t, x)| (t - 0.2, *x)).unzip();
        let (delay, error) = best_delay(&time, &front, &WATER_FRONT);
        assert!((delay - 0.2).abs() < 1e-12 && error < 1e-12, "{delay}, {error}");
        let (on_time, front): (Vec<f64>, Vec<f64>) = WATER_FRONT.points.iter().copied().unzip();
        assert!(error_at(&on_time, &front, &WATER_FRONT, 0.0) < 1e-15);
    }
}
