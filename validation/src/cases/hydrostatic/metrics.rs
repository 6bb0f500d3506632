//! How the runs are judged.

use super::Record;
use super::parameters::{HydrostaticRun, MaterialKind};
use crate::case::Run;
use crate::cases::layer::{self, LayerObservation};
use crate::metric::{Confidence, Limit, Metric};
use crate::observation::Recorded;

const EXACT: &str = "hydrostatic pressure of the equation of state, K (exp(ρ0 g (H − y)/K) − 1)";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records.iter().filter(|(run, _)| run.density_coupling > 0.0) {
        coupled(&mut metrics, run, record);
    }
    for (run, record) in records.iter().filter(|(run, _)| run.density_coupling == 0.0) {
        let coupled = records.iter().find(|(other, _)| other.density_coupling > 0.0 && other.material == run.material);
        let variant = run.variant();
        let noise = noise(&record.data);
        metrics.push(
            Metric::observed("pressure_noise", &variant, noise, "-")
                .against(Some(0.0), "smooth pressure", Confidence::Exact)
                .with_snapshot_tolerance(0.2, 1e-6),
        );
        if let Some((_, coupled)) = coupled {
            metrics.push(
                Metric::observed("noise_without_coupling", &variant, noise / self::noise(&coupled.data), "-")
                    .against(None, "the same run with the coupling (27)", Confidence::Exact)
                    .gated(Limit::AtLeast(20.0), "specification 1: 20 times the noise shows that the test can fail")
                    .with_snapshot_tolerance(0.3, 0.0),
            );
        }
    }
    metrics
}

fn coupled(metrics: &mut Vec<Metric>, run: &HydrostaticRun, record: &Recorded<LayerObservation>) {
    let variant = run.variant();
    let data = &record.data;
    metrics.push(layer::particles_lost(&variant, record));
    metrics.push(
        Metric::observed("pressure_noise", &variant, noise(data), "-")
            .against(Some(0.0), "smooth pressure", Confidence::Exact)
            .gated(Limit::AtMost(1e-3), "specification 1: rms of p less its local linear fit within 2h, over ρgH")
            .with_snapshot_tolerance(0.1, 1e-6),
    );
    let l2 = |name: &str, value: f64| {
        Metric::observed(name, &variant, 100.0 * value, "%").against(Some(0.0), EXACT, Confidence::Exact)
    };
    let reason = "specification 1: 1 % of the hydrostatic profile";
    match run.material {
        MaterialKind::Newtonian => metrics.push(
            l2("pressure_l2", profile_l2(run, &data.profile.height, &data.profile.pressure))
                .gated(Limit::AtMost(1.0), reason)
                .with_snapshot_tolerance(0.02, 1e-3),
        ),
        MaterialKind::MuI => {
            metrics.push(
                l2("normal_stress_l2", profile_l2(run, &data.profile.height, &data.profile.normal_stress))
                    .gated(Limit::AtMost(1.0), reason)
                    .with_snapshot_tolerance(0.02, 1e-3),
            );
            let (least, most) = data.pressure_ratio;
            let bounds = [
                ("least", least, 1.0 / (1.0 + run.static_friction)),
                ("most", most, 1.0 / (1.0 - run.static_friction)),
            ];
            for (name, value, bound) in bounds {
                metrics.push(
                    Metric::observed(&format!("pressure_ratio_{name}"), &variant, value, "-")
                        .against(Some(bound), "ρg(H − y)/(1 ± μ_s): passive and active state", Confidence::Exact)
                        .with_snapshot_tolerance(0.01, 0.0),
                );
            }
        }
    }
    let drift = 100.0 * (height_around(data, 2.0) / height_around(data, 1.0) - 1.0);
    metrics.push(
        Metric::observed("height_drift", &variant, drift, "%")
            .against(Some(0.0), "a layer at rest keeps its height", Confidence::Exact)
            .gated(Limit::Within(-0.1, 0.1), "specification 1: mean height from 1 s to 2 s")
            .with_snapshot_tolerance(0.1, 1e-4),
    );
    let breathing =
        data.series.time.iter().zip(&data.series.relative_height).filter(|(t, _)| **t > record.simulated_time - 0.5);
    let (low, high) =
        breathing.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (_, h)| (low.min(*h), high.max(*h)));
    metrics.push(
        Metric::observed("acoustic_breathing", &variant, 100.0 * (high - low), "%")
            .against(Some(0.0), "range of the mean height over the last 0.5 s", Confidence::Exact)
            .with_snapshot_tolerance(0.2, 1e-3),
    );
    let speed = data.series.rms_speed.last().copied().unwrap_or(f64::NAN);
    metrics.push(
        Metric::observed("rms_speed", &variant, speed, "m/s")
            .against(Some(0.0), "rest", Confidence::Exact)
            .with_snapshot_tolerance(0.5, 1e-5),
    );
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
