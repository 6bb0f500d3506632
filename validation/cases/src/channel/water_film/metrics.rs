//! How the runs are judged.

use super::WaterFilmRecord;
use super::flow::WaterFilmFlow;
use crate::case::Flow;
use crate::channel::{self, ChannelObservation, ProfilePoint, Water};
use crate::metric::{Confidence, Limit, Metric, Quantity, Value, Variant, quantities};
use crate::shared::Arrangement;
use crate::statistics::{FittedValue, log_log_slope};

quantities! {
    [channel::PARTICLES_LOST, channel::VELOCITY_ITERATIONS, channel::PRESSURE_ITERATIONS, channel::MOMENTUM_RESIDUAL, channel::HEIGHT_CHANGE, channel::BED_SHEAR]
    VELOCITY_L2: verified("velocity_l2", "%", "relative L2 error of the velocity profile, √(Σ(u − u_ref)²/Σu_ref²)"),
    LONGEST_WAVE: accounted("longest_wave", "-", "amplitude of the longest wave along the film in the velocity, over its mean"),
    VELOCITY_L2_OWN_DEPTH:
        verified("velocity_l2_own_depth", "%", "relative L2 error of the velocity profile against a film of the measured depth"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence of `velocity_l2`"),
    OBSERVED_ORDER_OWN_DEPTH:
        verified("observed_order_own_depth", "-", "order of convergence of `velocity_l2_own_depth`"),
}

/// Which film a profile is compared with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FilmDepth {
    /// That of the nominal depth.
    Nominal,
    /// That of the particles' own depth, twice their mean height.
    Own,
}

pub(super) fn all(records: &[WaterFilmRecord]) -> Vec<Metric> {
    let orders = [
        (OBSERVED_ORDER, FilmDepth::Nominal, "0.7: walls and free surface give first order"),
        (
            OBSERVED_ORDER_OWN_DEPTH,
            FilmDepth::Own,
            "0.7: walls and free surface give first order, even without the depth's error",
        ),
    ];
    let order = |(quantity, depth, reason): (Quantity, FilmDepth, &str)| {
        let errors = convergence_errors(records, depth);
        let rows = Value::list(errors.iter().map(|(rows, _)| *rows));
        let variant = Variant::of("particles", "lattice").and("resolution", rows);
        let order = quantity.of(&variant, -log_log_slope(&errors).unwrap_or(f64::NAN));
        let metric = order.against(None, source(depth), Confidence::Exact).with_snapshot_tolerance(0.1, 0.05);
        (errors.len() >= 3).then(|| metric.gated(Limit::AtLeast(0.7), reason))
    };
    records.iter().flat_map(of_run).chain(orders.into_iter().filter_map(order)).collect()
}

fn source(depth: FilmDepth) -> &'static str {
    match depth {
        FilmDepth::Nominal => "exact film (g i/ν)(h z − z²/2)",
        FilmDepth::Own => "exact film of the depth that the particles take, twice their mean height",
    }
}

fn of_run((run, record): &WaterFilmRecord) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data);
    let error = |quantity, depth| {
        channel::observed(quantity, &variant, velocity_l2(run, data, depth), 100.0).exactly(0.0, source(depth))
    };
    let limit = (run.water.resolution >= 20).then_some(Limit::AtMost(0.8));
    let Water { density, gravity, depth, .. } = run.water;
    let mut metrics = vec![
        channel::particles_lost(&variant, record),
        channel::momentum_residual(&variant, record),
        error(VELOCITY_L2, FilmDepth::Nominal).gated_by(limit, "0.8 % with 20 rows: three times the measured 0.26 %"),
        error(VELOCITY_L2_OWN_DEPTH, FilmDepth::Own),
        channel::height_change(&variant, data, "mean height h/2; the velocity goes with the square of the depth"),
        channel::bed_shear(&variant, data, density * gravity * depth * run.slope),
        LONGEST_WAVE
            .of(&variant, data.longest_wave)
            .exactly(0.0, "the film is uniform along the flow")
            .gated_by(
                (run.arrangement == Arrangement::Lattice).then_some(Limit::AtMost(1e-4)),
                "1e-4: ten times the velocity solver's expected error of 1e-5; a perturbed lattice (4e-3) would fail",
            )
            .with_snapshot_tolerance(0.5, 1e-5),
    ];
    let short = run.water.resolution == 20 && run.relaxation_times <= 2.0;
    metrics.extend(channel::iterations(&variant, data, if short { [Some(1.0), Some(1.24)] } else { [None; 2] }));
    metrics
}

/// Depth h `[m]` that a run is compared at.
fn depth_of(run: &WaterFilmFlow, data: &ChannelObservation, depth: FilmDepth) -> f64 {
    let heights = data.series.within(&data.series.relative_height, data.window);
    match depth {
        FilmDepth::Nominal => run.water.depth,
        FilmDepth::Own => run.water.depth * heights.iter().sum::<f64>() / heights.len() as f64,
    }
}

/// Relative L2 of the velocity over the samples of all bins `[-]`.
fn velocity_l2(run: &WaterFilmFlow, data: &ChannelObservation, depth: FilmDepth) -> FittedValue {
    let film = run.exact(depth_of(run, data, depth));
    data.profile.estimate(|points: &[ProfilePoint]| {
        let (error, scale) = points.iter().fold((0.0, 0.0), |(error, scale), point| {
            let exact = film.velocity(point.height);
            (error + point.samples * (point.velocity - exact).powi(2), scale + point.samples * exact * exact)
        });
        (error / scale).sqrt()
    })
}

/// (rows, relative L2 `[%]`) of the lattice runs, coarse to fine.
pub(super) fn convergence_errors(records: &[WaterFilmRecord], depth: FilmDepth) -> Vec<(f64, f64)> {
    let mut errors: Vec<(f64, f64)> = records
        .iter()
        .filter(|(run, _)| run.arrangement == Arrangement::Lattice)
        .map(|(run, record)| (run.water.resolution as f64, 100.0 * velocity_l2(run, &record.data, depth).value))
        .collect();
    errors.sort_by(|a, b| a.0.total_cmp(&b.0));
    errors
}
