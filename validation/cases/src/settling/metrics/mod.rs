//! How the runs are judged.

pub(super) mod beads;
mod laws;

use super::SettlingRecord;
use super::flow::SettlingFlow;
use super::probe::{SettlingObservation, SettlingSeries};
use crate::case::Flow;
use crate::metric::{Limit, Metric, Quantity, Variant, quantities};
use crate::reference::settling::{richardson_zaki_confidence, richardson_zaki_exponent};

quantities! {
    []
    TERMINAL_VELOCITY_ERROR:
        verified("terminal_velocity_error", "%", "slip velocity that enters the drag, over the exact slip of a single grain, minus 1"),
    SLIP_ERROR: verified("slip_error", "%", "slip of a suspension over the exact slip, minus 1"),
    SINKING_ERROR: verified("sinking_error", "%", "settling velocity of a suspension over the exact one, minus 1"),
    SINKING_OVER_RICHARDSON_ZAKI:
        validated("sinking_over_richardson_zaki", "-", "settling velocity of a suspension over that of Richardson & Zaki"),
    SINKING_OVER_MEASURED:
        validated("sinking_over_measured", "-", "settling velocity of a dense suspension of beads by a drag law, over the measured velocity"),
    DEPOSIT_RISE_OVER_MEASURED:
        validated("deposit_rise_over_measured", "-", "rise velocity of the deposit of these beads by a drag law, over the measured velocity"),
    UNEVENNESS: verified("unevenness", "%", "scatter of the grains' velocities over the slip"),
    DRAG_CURVE_ERROR: validated(
        "drag_curve_error", "%", "largest deviation of a law's drag of one sphere from the standard drag curve",
    ),
    LAW_SLIP_ERROR:
        verified("law_slip_error", "%", "largest deviation of a law's slip from that of the printed law"),
    MOMENTUM_ERROR:
        accounted("momentum_error", "-", "momentum imbalance of a step, over the weight of the grains"),
}

const ALONE: &str = "root of (ρ_s − ρ_f) g = c C_d ρ_f u²/d, c = ½ for the planar form (30)";
const SPHERE: &str = "root of (ρ_s − ρ_f) g = c C_d ρ_f u²/d, c = ¾ for a sphere";
const HINDERED: &str = "root of φ (1 − φ)(ρ_s − ρ_f) g = K |u_r|";
const VESSEL: &str = "u_s = −(1 − φ) |u_r| without a flux of the mixture";

pub(super) fn all(records: &[SettlingRecord]) -> Vec<Metric> {
    let judged = |(flow, record): &SettlingRecord| {
        let metrics = if flow.is_suspension() { together } else { alone };
        metrics(flow, &flow.variant(), &record.data)
    };
    records.iter().flat_map(judged).chain(laws::all()).chain(beads::all()).collect()
}

/// Mean of an array over its reference less one `[%]`, observed; its own error is what it may drift by.
fn error(
    quantity: Quantity,
    variant: &Variant,
    series: &SettlingSeries,
    array: &[f64],
    (root, source): (f64, &str),
) -> Metric {
    let (mean, noise) = series.mean(array);
    // displaced particles move chaotically: a mean over the window moves by its own error after any change
    let tolerance = 300.0 * noise / root + 1e-3;
    quantity.of(variant, 100.0 * (mean / root - 1.0)).exactly(0.0, source).with_snapshot_tolerance(0.0, tolerance)
}

fn alone(flow: &SettlingFlow, variant: &Variant, data: &SettlingObservation) -> Vec<Metric> {
    let (series, root) = (&data.series, flow.root());
    let error = |quantity, array: &[f64]| error(quantity, variant, series, array, (root, ALONE));
    let reason = "1 % of the force balance's velocity over the run's last 60 %: the project's aim";
    vec![
        error(TERMINAL_VELOCITY_ERROR, &series.slip).gated(Limit::Within(-1.0, 1.0), reason),
        momentum(variant, data.momentum_error),
    ]
}

fn together(flow: &SettlingFlow, variant: &Variant, data: &SettlingObservation) -> Vec<Metric> {
    let series = &data.series;
    let (slip, alone, fluid) = (flow.root(), flow.sphere_velocity(), 1.0 - flow.solid_fraction);
    let error = |quantity, array: &[f64], root| error(quantity, variant, series, array, root);
    let within = Limit::Within(-0.03, 0.03);
    let reason = "0.03 %: expected second-order effect of grains perturbed by a tenth of their distance";
    let mut metrics = vec![
        error(SLIP_ERROR, &series.slip, (slip, HINDERED)).gated(within, reason),
        error(SINKING_ERROR, &series.sinking, (fluid * slip, VESSEL)).gated(within, reason),
    ];
    if flow.is_dilute() {
        let reason = "1 %: the project's aim; solid fraction 0.002 slows settling by 0.1 to 0.6 % (expected)";
        let terminal = error(TERMINAL_VELOCITY_ERROR, &series.slip, (alone, SPHERE));
        metrics.insert(0, terminal.gated(Limit::Within(-1.0, 1.0), reason));
    } else {
        let exponent = richardson_zaki_exponent(flow.grains.reynolds(alone));
        let published = alone * libm::pow(fluid, exponent);
        metrics.push(
            SINKING_OVER_RICHARDSON_ZAKI
                .of(variant, series.mean(&series.sinking).0 / published)
                .against(Some(1.0), "Richardson & Zaki 1954, u/u_t = (1 − φ)ⁿ", richardson_zaki_confidence())
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    metrics.extend([
        UNEVENNESS
            .of(variant, 100.0 * series.mean(&series.unevenness).0 / slip)
            .exactly(0.0, "all grains of a uniform suspension settle at one velocity")
            .with_snapshot_tolerance(0.5, 0.01),
        momentum(variant, data.momentum_error),
    ]);
    metrics
}

fn momentum(variant: &Variant, error: f64) -> Metric {
    MOMENTUM_ERROR
        .of(variant, error)
        .exactly(0.0, "change of momentum = impulse of gravity and floor, in every step")
        .gated(
            Limit::AtMost(1e-11),
            "1e-11 of the grains' weight: expected rounding over a thousand particles; pairs exchange opposite impulses",
        )
        .with_snapshot_tolerance(0.0, 1e-10)
}
