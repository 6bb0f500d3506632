//! How the runs are judged.

mod elasticity;
mod kernel;

use super::HydrostaticRecord;
use super::flow::HydrostaticFlow;
use crate::case::Flow;
use crate::layer;
use crate::metric::{Confidence, Limit, Metric, quantities};
use crate::setup::energy_ledger;
use crate::statistics::{mean, relative_l2};

quantities! {
    [layer::PARTICLES_LOST, energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    PRESSURE_NOISE:
        verified("pressure_noise", "-", "rms of pressure minus its local linear fit within 2h, over ρ g H"),
    NOISE_WITHOUT_COUPLING: verified("noise_without_coupling", "-", "pressure noise without the coupling (27) over the noise with it"),
    PRESSURE_L2: verified("pressure_l2", "%", "relative L2 error of pressure against the hydrostatic profile"),
    NORMAL_STRESS_L2: verified("normal_stress_l2", "%", "relative L2 error of p − s_yy against the hydrostatic pressure"),
    HEIGHT_DRIFT: verified("height_drift", "%", "change of the mean height from 1 s to 2 s"),
    KERNEL_INTEGRAL_ERROR: verified("kernel_integral_error", "%", "integral of the kernel over its support, minus 1"),
    KERNEL_MOMENT_ERROR:
        verified("kernel_moment_error", "%", "second moment of the kernel gradient −∫ F r²/D dA, minus 1"),
    ELASTIC_SHEAR_ERROR:
        verified("elastic_shear_error", "%", "shear stress of grains below yield over G γ, minus 1"),
    STRESS_ROTATION_ERROR:
        verified("stress_rotation_error", "%", "stress after an eighth of a turn minus the rotated initial stress, over its magnitude"),
    RMS_SPEED: verified("rms_speed", "m/s", "root mean square of the speed at the end"),
}

const EXACT: &str = "hydrostatic pressure of the equation of state, K (exp(ρ0 g (H − y)/K) − 1)";

pub(super) fn all(records: &[HydrostaticRecord]) -> Vec<Metric> {
    let (coupled, uncoupled): (Vec<&HydrostaticRecord>, Vec<&HydrostaticRecord>) =
        records.iter().partition(|(run, _)| run.is_coupled());
    let mut metrics: Vec<Metric> = coupled.iter().flat_map(|record| at_rest(record)).collect();
    for record in uncoupled {
        let partner = coupled.iter().find(|(other, _)| other.material == record.0.material);
        metrics.extend(without_coupling(record, partner.copied()));
    }
    metrics.extend(records.first().into_iter().flat_map(|(run, _)| kernel::all(&run.layer.numerics)));
    let grains = records.iter().map(|(run, _)| &run.material).find(|material| material.is_plastic());
    metrics.extend(grains.into_iter().flat_map(elasticity::all));
    metrics
}

/// The noise of an uncoupled layer, against the coupled one of the same law.
fn without_coupling((run, record): &HydrostaticRecord, partner: Option<&HydrostaticRecord>) -> Vec<Metric> {
    let (variant, noise) = (run.variant(), mean(&record.data.series.pressure_noise));
    let own = PRESSURE_NOISE.of(&variant, noise).exactly(0.0, "smooth pressure").with_snapshot_tolerance(0.2, 1e-6);
    let factor = partner.map(|(_, partner)| {
        NOISE_WITHOUT_COUPLING
            .of(&variant, noise / mean(&partner.data.series.pressure_noise))
            .against(None, "the same run with the coupling (27)", Confidence::Exact)
            .gated(Limit::AtLeast(100.0), "a factor of 100: the paper states that the coupling removes the noise")
            .with_snapshot_tolerance(0.3, 0.0)
    });
    [own].into_iter().chain(factor).collect()
}

fn at_rest((run, record): &HydrostaticRecord) -> Vec<Metric> {
    let (variant, series, profile) = (run.variant(), &record.data.series, &record.data.profile);
    // friction leaves the pressure of grains undetermined between the passive and the active state
    let (quantity, pressure) = if run.material.is_plastic() {
        (NORMAL_STRESS_L2, &profile.normal_stress)
    } else {
        (PRESSURE_L2, &profile.pressure)
    };
    let mut metrics = vec![
        layer::particles_lost(&variant, record),
        PRESSURE_NOISE
            .of(&variant, mean(&series.pressure_noise))
            .exactly(0.0, "smooth pressure")
            .gated(Limit::AtMost(1e-3), "0.1 % of the bed's pressure ρ g H: a tenth of the profile's allowed error")
            .with_snapshot_tolerance(0.1, 1e-6),
        quantity
            .of(&variant, 100.0 * profile_l2(run, &profile.height, pressure))
            .exactly(0.0, EXACT)
            .gated(Limit::AtMost(1.0), "1 % of the hydrostatic profile: the project's aim")
            .with_snapshot_tolerance(0.02, 1e-3),
    ];
    let scale = energy_ledger::EnergyScale::AtRest(run.energy_scale());
    metrics.extend(energy_ledger::metrics(&variant, &record.data.energy, scale));
    // over 0.4 s about a time, several acoustic periods
    let around = |time: f64| {
        let heights = series.curve(&series.relative_height).filter(|(t, _)| (t - time).abs() <= 0.2);
        mean(&heights.map(|(_, height)| height).collect::<Vec<_>>())
    };
    let speed = series.rms_speed.last().copied().unwrap_or(f64::NAN);
    metrics.extend([
        HEIGHT_DRIFT
            .of(&variant, 100.0 * (around(2.0) / around(1.0) - 1.0))
            .exactly(0.0, "a layer at rest keeps its height")
            .gated(Limit::Within(-0.1, 0.1), "0.1 %: layers at rest keep their mean height from 1 s to 2 s")
            .with_snapshot_tolerance(0.1, 1e-4),
        RMS_SPEED.of(&variant, speed).exactly(0.0, "rest").with_snapshot_tolerance(0.5, 1e-5),
    ]);
    metrics
}

/// Relative L2 of a time-averaged depth profile against the exact pressure `[-]`.
///
/// The displaced particles settle by a part of a per cent at once, which leaves the layer breathing at its acoustic
/// frequency c/4H for a long time, as it would in an inviscid liquid: the mean over many periods is what is at rest.
fn profile_l2(run: &HydrostaticFlow, heights: &[f64], values: &[f64]) -> f64 {
    let filled = heights.iter().zip(values).filter(|(y, _)| y.is_finite());
    relative_l2(filled.map(|(y, pressure)| (*pressure, run.pressure(*y))))
}
