//! How the runs are judged.

use super::Record;
use crate::case::Run;
use crate::cases::energy_ledger::{self, CORRECTION_WORK, ENERGY_RESIDUAL, ENERGY_RISE, EnergyScale, WALL_WORK};
use crate::metric::{Limit, Metric, Origin, quantities};
use crate::reference::MeasuredFront;
use crate::statistics::{Beyond, interpolated};

quantities! {
    [ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK, CORRECTION_WORK]
    FRONT_ERROR: validated("front_error", "%", "root mean square of the front's relative error at the measured times"),
    FRONT_DELAY: validated("front_delay", "√(a/2g)", "delay of the measured front that fits best"),
    DELAYED_FRONT_ERROR: validated("delayed_front_error", "%", "error of the front at the measured times less that delay"),
}

const READINGS: &str = "readings of the figure agree with the table to 0.03 in x/a (a vector figure to 0.005), taken for the half width of an even \
                        spread, root mean square over the measured places";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    records.iter().flat_map(of_run).collect()
}

fn of_run((run, record): &Record) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data);
    let mut metrics = energy_ledger::metrics(&variant, &data.energy, EnergyScale::Work);
    let measured = run.measured();
    let observed = |quantity: crate::metric::Quantity, value: f64| {
        quantity.of(&variant, value).against(Some(0.0), &measured.source, measured.confidence)
    };
    let (delay, error) = best_delay(&data.time, &data.front, measured);
    let reading = Some(100.0 * measured.relative_reading());
    // the release of a column that is said to be free took a time of its own, which nobody has measured: only a gate that moves as it did judges
    let limit = (run.gate_speed > 0.0).then_some(Limit::AtMost(8.0));
    metrics.extend([
        observed(FRONT_ERROR, 100.0 * error_at(&data.time, &data.front, measured, 0.0))
            .gated_by(limit, "8 % of the measured place, with the gate and the time as they were measured")
            .known_to(Origin::Digitisation, reading, READINGS)
            .with_snapshot_tolerance(0.05, 0.2),
        observed(FRONT_DELAY, delay).with_snapshot_tolerance(0.05, 0.02),
        // with a delay that is fitted to it, it validates nothing
        observed(DELAYED_FRONT_ERROR, 100.0 * error)
            .known_to(Origin::Digitisation, reading, READINGS)
            .with_snapshot_tolerance(0.2, 0.3),
    ]);
    metrics
}

/// Root mean square of x/x_measured − 1 at the measured times less a delay `[-]`; the column stood as it starts before.
fn error_at(time: &[f64], front: &[f64], measured: &MeasuredFront, delay: f64) -> f64 {
    let points = &measured.points;
    let samples: Vec<(f64, f64)> = time.iter().copied().zip(front.iter().copied()).collect();
    let at = |time: f64| interpolated(&samples, time, (Beyond::EndValue, Beyond::Nothing)).unwrap_or(f64::NAN);
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
    use crate::reference::WATER_FRONT;

    #[test]
    fn a_front_that_starts_early_has_the_delay_and_no_error_with_it() {
        let (time, front): (Vec<f64>, Vec<f64>) = WATER_FRONT.points.iter().map(|(t, x)| (t - 0.2, *x)).unzip();
        let (delay, error) = best_delay(&time, &front, &WATER_FRONT);
        assert!((delay - 0.2).abs() < 1e-12 && error < 1e-12, "{delay}, {error}");
        let (on_time, front): (Vec<f64>, Vec<f64>) = WATER_FRONT.points.iter().copied().unzip();
        assert!(error_at(&on_time, &front, &WATER_FRONT, 0.0) < 1e-15);
    }
}
