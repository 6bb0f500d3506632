//! How the runs are judged.

use super::Record;
use super::comparison::NumericsSet;
use super::fluid::Film;
use super::parameters::FilmRun;
use crate::case::Run;
use crate::cases::Arrangement;
use crate::cases::layer::{self, BINS, LayerObservation};
use crate::metric::{Confidence, Limit, Metric, Quantity, Value, Variant};
use crate::observation::{Outcome, Recorded};
use crate::statistics::{linear_fit, log_log_slope};

const VELOCITY_L2: Quantity = Quantity::verified("velocity_l2", "%", "relative L2 of the velocity profile");
const FLUX_ERROR: Quantity = Quantity::verified("flux_error", "%", "error of the depth-integrated velocity");
const VELOCITY_L2_COMPRESSIBLE: Quantity =
    Quantity::verified("velocity_l2_compressible", "%", "the same L2 against the weakly compressible Newtonian film");
const OBSERVED_ORDER: Quantity =
    Quantity::verified("observed_order", "-", "order of convergence of the Newtonian film on the lattice");
const PLUG_EDGE_ERROR: Quantity =
    Quantity::verified("plug_edge_error", "spacings", "height of the plug's edge less the exact one");

pub(super) const QUANTITIES: &[Quantity] =
    &[layer::PARTICLES_LOST, VELOCITY_L2, FLUX_ERROR, VELOCITY_L2_COMPRESSIBLE, OBSERVED_ORDER, PLUG_EDGE_ERROR];

const EXACT: &str = "exact solution of the film";
const INTEGRATED: &str = "steady film of the law, integrated over the depth";

pub(super) fn all(records: &[Record]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records {
        let variant = run.variant();
        if run.numerics_set != NumericsSet::Default {
            compared(&mut metrics, run, record, &variant);
            continue;
        }
        metrics.push(layer::particles_lost(&variant, record));
        profile(&mut metrics, run, record, &variant);
        if let Some(value) = compressible_l2(run, record) {
            metrics.push(
                VELOCITY_L2_COMPRESSIBLE
                    .of(&variant, value)
                    .against(Some(0.0), "exact weakly compressible film, η du/dy = p tanθ", Confidence::Exact)
                    .with_snapshot_tolerance(1e-3, 1e-4),
            );
        }
        plug_edge(&mut metrics, run, record, &variant);
    }
    let errors = convergence_errors(records);
    if errors.len() >= 2 {
        let rows = Value::list(errors.iter().map(|(rows, _)| *rows));
        let variant = Variant::of("fluid", "newtonian").and("particles", "lattice").and("resolution", rows);
        metrics.push(
            OBSERVED_ORDER
                .of(&variant, -log_log_slope(&errors).unwrap_or(f64::NAN))
                .against(None, "convergence to the weakly compressible film, exact for the model", Confidence::Exact)
                .gated(Limit::AtLeast(1.5), "specification 1: order 1.5 on the lattice")
                .with_snapshot_tolerance(0.01, 0.0),
        );
    }
    metrics
}

/// What another set of numerics gives: to be seen beside the default, not to be judged.
fn compared(metrics: &mut Vec<Metric>, run: &FilmRun, record: &Recorded<LayerObservation>, variant: &Variant) {
    // a run that diverged has no profile to speak of
    if matches!(record.outcome, Outcome::Diverged { .. }) {
        return;
    }
    for (quantity, value) in [(VELOCITY_L2, velocity_l2(run, record)), (FLUX_ERROR, flux_error(run, record))] {
        metrics.push(
            quantity
                .of(variant, value)
                .against(Some(0.0), EXACT, Confidence::Exact)
                .with_snapshot_tolerance(0.02, 0.05),
        );
    }
}

/// Error of the depth-integrated velocity `[%]`.
pub(super) fn flux_error(run: &FilmRun, record: &Recorded<LayerObservation>) -> f64 {
    let profile = &record.data.profile;
    // Every particle carries the same volume, so the mean over all samples is the mean over the depth. A mean over
    // bins is not: coarse films fill some of them with the grains of a row's edge only.
    let (sum, count) = filled(record).fold((0.0, 0.0), |(sum, count), bin| {
        (sum + profile.samples[bin] * profile.velocity[bin], count + profile.samples[bin])
    });
    100.0 * (sum / count * run.layer.layer_height / run.film().flux() - 1.0)
}

fn profile(metrics: &mut Vec<Metric>, run: &FilmRun, record: &Recorded<LayerObservation>, variant: &Variant) {
    let flux_error = flux_error(run, record);
    // first order in the spacing at the bed, so that 20 rows have twice the error of 40
    let limit = match (run.film(), run.layer.resolution) {
        (Film::Newtonian(_), 40..) => Some((1.0, "specification 1: 1 % at 40 rows")),
        (Film::Newtonian(_), 20..) => Some((2.0, "1 % at 40 rows, first order at worst")),
        // what a law of one's own may be off by is for its author to say
        (Film::Integrated(_), _) => None,
        (_, 40..) => Some((2.0, "specification 1: 2 % at 40 rows")),
        (_, 20..) => Some((3.0, "2 % at 40 rows, of which 1 % is the regularisation's creep")),
        _ => None,
    };
    let exact = if matches!(run.film(), Film::Integrated(_)) { INTEGRATED } else { EXACT };
    for (quantity, value) in [(VELOCITY_L2, velocity_l2(run, record)), (FLUX_ERROR, flux_error)] {
        let metric = quantity
            .of(variant, value)
            .against(Some(0.0), exact, Confidence::Exact)
            .with_snapshot_tolerance(1e-3, 1e-4);
        metrics.push(match limit {
            Some((limit, reason)) => metric.gated(Limit::Within(-limit, limit), reason),
            None => metric,
        });
    }
}

fn plug_edge(metrics: &mut Vec<Metric>, run: &FilmRun, record: &Recorded<LayerObservation>, variant: &Variant) {
    let film = run.film();
    let Some(exact) = film.plug_edge() else { return };
    let points: Vec<(f64, f64)> = shear_rates(record)
        .into_iter()
        .filter(|(y, _)| (0.1..=0.8).contains(&(y / exact)))
        .map(|(y, rate)| (y, libm::pow(rate.abs(), film.flow_index())))
        .collect();
    let edge = linear_fit(&points).map_or(f64::NAN, |fit| -fit.intercept / fit.slope);
    let spacing = run.layer.layer_height / run.layer.resolution as f64;
    metrics.push(
        PLUG_EDGE_ERROR
            .of(variant, (edge - exact) / spacing)
            .against(Some(0.0), "edge of the plug at h − τ_y/(ρ g sinθ)", Confidence::Exact)
            .gated(
                Limit::Within(-1.0, 1.0),
                "specification 1: within one particle, by a line through |du/dy|ⁿ over 0.1 Y … 0.8 Y",
            )
            .with_snapshot_tolerance(0.01, 0.01),
    );
}

/// Bins that hold samples.
fn filled(record: &Recorded<LayerObservation>) -> impl Iterator<Item = usize> {
    let samples = &record.data.profile.samples;
    (0..BINS).filter(move |&bin| samples[bin] > 0.0)
}

/// Relative L2 of the bins' velocities `[%]`.
pub(super) fn velocity_l2(run: &FilmRun, record: &Recorded<LayerObservation>) -> f64 {
    let (film, data) = (run.film(), &record.data.profile);
    let (error, scale) = filled(record).fold((0.0, 0.0), |(error, scale), bin| {
        let exact = film.velocity(data.height[bin]);
        (error + (data.velocity[bin] - exact).powi(2), scale + exact * exact)
    });
    100.0 * (error / scale).sqrt()
}

/// (y, du/dy) by central differences of the bins.
pub(super) fn shear_rates(record: &Recorded<LayerObservation>) -> Vec<(f64, f64)> {
    let data = &record.data.profile;
    let bins: Vec<usize> = filled(record).collect();
    bins.windows(3)
        .map(|b| {
            (data.height[b[1]], (data.velocity[b[2]] - data.velocity[b[0]]) / (data.height[b[2]] - data.height[b[0]]))
        })
        .collect()
}

/// Relative L2 `[%]` of the bins' velocities against the weakly compressible film; none but for the Newtonian.
fn compressible_l2(run: &FilmRun, record: &Recorded<LayerObservation>) -> Option<f64> {
    let data = &record.data.profile;
    let (mut error, mut scale) = (0.0, 0.0);
    for bin in filled(record) {
        let exact = run.weakly_compressible_velocity(data.height[bin])?;
        error += (data.velocity[bin] - exact).powi(2);
        scale += exact * exact;
    }
    Some(100.0 * (error / scale).sqrt())
}

/// (rows, velocity L2 `[%]` against the weakly compressible film) of the Newtonian lattice runs, coarse to fine.
pub(super) fn convergence_errors(records: &[Record]) -> Vec<(f64, f64)> {
    let mut errors: Vec<(f64, f64)> = records
        .iter()
        .filter(|(run, _)| run.is_newtonian() && run.particles == Arrangement::Lattice)
        .filter_map(|(run, record)| Some((run.layer.resolution as f64, compressible_l2(run, record)?)))
        .collect();
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    errors
}
