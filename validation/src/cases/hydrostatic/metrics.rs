//! How the runs are judged.

use super::Record;
use super::parameters::HydrostaticRun;
use crate::case::Run;
use crate::cases::layer::{self, LayerObservation};
use crate::metric::{Confidence, Limit, Metric, Quantity};
use crate::observation::Recorded;

const PRESSURE_NOISE: Quantity =
    Quantity::verified("pressure_noise", "-", "rms of the pressure less its local linear fit within 2h, over ρgH");
const NOISE_WITHOUT_COUPLING: Quantity =
    Quantity::verified("noise_without_coupling", "-", "pressure noise without (27) over that with it");
const PRESSURE_L2: Quantity =
    Quantity::verified("pressure_l2", "%", "relative L2 of the pressure against the hydrostatic one");
const NORMAL_STRESS_L2: Quantity =
    Quantity::verified("normal_stress_l2", "%", "relative L2 of p − s_yy against the hydrostatic pressure");
const PRESSURE_RATIO_LEAST: Quantity =
    Quantity::verified("pressure_ratio_least", "-", "least pressure over the hydrostatic one");
const PRESSURE_RATIO_MOST: Quantity =
    Quantity::verified("pressure_ratio_most", "-", "largest pressure over the hydrostatic one");
const HEIGHT_DRIFT: Quantity = Quantity::verified("height_drift", "%", "change of the mean height from 1 s to 2 s");
const ACOUSTIC_BREATHING: Quantity =
    Quantity::verified("acoustic_breathing", "%", "range of the mean height over the last 0.5 s");
const RMS_SPEED: Quantity = Quantity::verified("rms_speed", "m/s", "root mean square of the speed at the end");

pub(super) const QUANTITIES: &[Quantity] = &[
    layer::PARTICLES_LOST,
    PRESSURE_NOISE,
    NOISE_WITHOUT_COUPLING,
    PRESSURE_L2,
    NORMAL_STRESS_L2,
    PRESSURE_RATIO_LEAST,
    PRESSURE_RATIO_MOST,
    HEIGHT_DRIFT,
    ACOUSTIC_BREATHING,
    RMS_SPEED,
];

const EXACT: &str = "hydrostatic pressure of the equation of state, K (exp(ρ0 g (H − y)/K) − 1)";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let (coupled, uncoupled): (Vec<&Record>, Vec<&Record>) = records.iter().partition(|(run, _)| run.is_coupled());
    let mut metrics: Vec<Metric> = coupled.iter().flat_map(|(run, record)| at_rest(run, record)).collect();
    for (run, record) in uncoupled {
        let variant = run.variant();
        let noise = noise(&record.data);
        metrics.push(
            PRESSURE_NOISE
                .of(&variant, noise)
                .against(Some(0.0), "smooth pressure", Confidence::Exact)
                .with_snapshot_tolerance(0.2, 1e-6),
        );
        if let Some((_, partner)) = coupled.iter().find(|(other, _)| other.law == run.law) {
            metrics.push(
                NOISE_WITHOUT_COUPLING
                    .of(&variant, noise / self::noise(&partner.data))
                    .against(None, "the same run with the coupling (27)", Confidence::Exact)
                    .gated(Limit::AtLeast(20.0), "specification 1: 20 times the noise shows that the test can fail")
                    .with_snapshot_tolerance(0.3, 0.0),
            );
        }
    }
    metrics
}

fn at_rest(run: &HydrostaticRun, record: &Recorded<LayerObservation>) -> Vec<Metric> {
    let variant = run.variant();
    let data = &record.data;
    let mut metrics = vec![
        layer::particles_lost(&variant, record),
        PRESSURE_NOISE
            .of(&variant, noise(data))
            .against(Some(0.0), "smooth pressure", Confidence::Exact)
            .gated(Limit::AtMost(1e-3), "specification 1: rms of p less its local linear fit within 2h, over ρgH")
            .with_snapshot_tolerance(0.1, 1e-6),
    ];
    let (quantity, profile) = match run.states_of_rest() {
        None => (PRESSURE_L2, &data.profile.pressure),
        Some(_) => (NORMAL_STRESS_L2, &data.profile.normal_stress),
    };
    metrics.push(
        quantity
            .of(&variant, 100.0 * profile_l2(run, &data.profile.height, profile))
            .against(Some(0.0), EXACT, Confidence::Exact)
            .gated(Limit::AtMost(1.0), "specification 1: 1 % of the hydrostatic profile")
            .with_snapshot_tolerance(0.02, 1e-3),
    );
    if let Some((passive, active)) = run.states_of_rest() {
        let (least, most) = data.pressure_ratio;
        let ratios = [(PRESSURE_RATIO_LEAST, least, passive), (PRESSURE_RATIO_MOST, most, active)];
        metrics.extend(ratios.map(|(quantity, value, bound)| {
            quantity
                .of(&variant, value)
                .against(Some(bound), "ρg(H − y)/(1 ± μ_s): passive and active state", Confidence::Exact)
                .with_snapshot_tolerance(0.01, 0.0)
        }));
    }
    let drift = 100.0 * (height_around(data, 2.0) / height_around(data, 1.0) - 1.0);
    metrics.push(
        HEIGHT_DRIFT
            .of(&variant, drift)
            .against(Some(0.0), "a layer at rest keeps its height", Confidence::Exact)
            .gated(Limit::Within(-0.1, 0.1), "specification 1: mean height from 1 s to 2 s")
            .with_snapshot_tolerance(0.1, 1e-4),
    );
    let breathing =
        data.series.time.iter().zip(&data.series.relative_height).filter(|(t, _)| **t > record.simulated_time - 0.5);
    let (low, high) =
        breathing.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, h)| (low.min(*h), high.max(*h)));
    metrics.push(
        ACOUSTIC_BREATHING
            .of(&variant, 100.0 * (high - low))
            .against(Some(0.0), "range of the mean height over the last 0.5 s", Confidence::Exact)
            .with_snapshot_tolerance(0.2, 1e-3),
    );
    let speed = data.series.rms_speed.last().copied().unwrap_or(f64::NAN);
    metrics.push(
        RMS_SPEED.of(&variant, speed).against(Some(0.0), "rest", Confidence::Exact).with_snapshot_tolerance(0.5, 1e-5),
    );
    metrics
}

/// Mean over the last window.
fn noise(data: &LayerObservation) -> f64 {
    let noise = &data.series.pressure_noise;
    noise.iter().sum::<f64>() / noise.len() as f64
}

/// Relative L2 of a time-averaged depth profile against the exact pressure `[-]`.
///
/// The displaced particles settle by a part of a per cent at once, which leaves the layer breathing at its acoustic
/// frequency c/4H for a long time, as it would in an inviscid liquid: the mean over many periods is what is at rest.
fn profile_l2(run: &HydrostaticRun, heights: &[f64], values: &[f64]) -> f64 {
    let (error, scale) =
        heights.iter().zip(values).filter(|(y, _)| y.is_finite()).fold((0.0, 0.0), |(e, s), (y, p)| {
            let exact = run.pressure(*y);
            (e + (p - exact).powi(2), s + exact * exact)
        });
    (error / scale).sqrt()
}

/// Relative height averaged over 0.4 s about a time `[s]`, several acoustic periods.
fn height_around(data: &LayerObservation, time: f64) -> f64 {
    let heights = data.series.time.iter().zip(&data.series.relative_height);
    let near: Vec<f64> = heights.filter(|(t, _)| (**t - time).abs() <= 0.2).map(|(_, height)| *height).collect();
    near.iter().sum::<f64>() / near.len() as f64
}
