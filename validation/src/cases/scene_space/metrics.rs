//! How a scene in space is judged: by its balances, and its gauges by what was measured.

use super::{Gauge, Record, SpaceParameters, vector};
use crate::case::Run;
use crate::cases::enclosed::metrics::{
    DEPTH, FORCE_RESIDUAL, FRONT, GAUGE_ERROR, MASS_LEFT, MASS_RESIDUAL, MOMENTUM_RESIDUAL, THROUGH_WALLS, balances,
    energy, errors, largest, mean,
};
use crate::cases::enclosed::sides;
use crate::cases::energy_ledger::{CORRECTION_WORK, ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK};
use crate::metric::{Metric, quantities};

quantities! {
    [
        ENERGY_RESIDUAL, ENERGY_RISE, WALL_WORK, CORRECTION_WORK, MASS_RESIDUAL, MOMENTUM_RESIDUAL, FORCE_RESIDUAL,
        THROUGH_WALLS, MASS_LEFT, FRONT, DEPTH, GAUGE_ERROR,
    ]
    MEAN_FORCE: accounted("mean_force", "N", "force of the flow on a gauge's wall, its mean over the run"),
    MASS_CROSSED: accounted("mass_crossed", "kg", "mass that has crossed a gauge's parallelogram up to the end"),
}

pub(super) fn all(parameters: &SpaceParameters, records: &[Record]) -> Vec<Metric> {
    records.iter().flat_map(|record| of_run(parameters, record)).collect()
}

fn of_run(parameters: &SpaceParameters, (run, record): &Record) -> Vec<Metric> {
    let (variant, data) = (run.variant(), &record.data);
    let mut metrics = balances(&variant, data, sides::has_mirror(&parameters.sides.pairs()));
    metrics.extend(energy(&variant, data, vector(&parameters.gravity).norm(), parameters.height()));
    let mut column = 0;
    for gauge in &parameters.gauges {
        let own = variant.clone().and("gauge", gauge.name());
        let columns = gauge.columns().len();
        let all = data.gauges.get(column..column + columns).unwrap_or_default();
        let series = all.first().map_or(&[][..], Vec::as_slice);
        let last = series.last().copied().unwrap_or(f64::NAN);
        metrics.push(
            match gauge {
                Gauge::Front { .. } => FRONT.of(&own, last),
                Gauge::Depth { .. } => DEPTH.of(&own, last),
                Gauge::Force { .. } => {
                    let square: f64 = all.iter().map(|series| mean(series)).map(|force| force * force).sum();
                    MEAN_FORCE.of(&own, square.sqrt())
                }
                Gauge::Flux { .. } => MASS_CROSSED.of(&own, last),
            }
            .with_snapshot_tolerance(0.1, 0.1 * largest(series)),
        );
        let measured: Vec<_> = parameters.measured.iter().filter(|measured| measured.gauge == gauge.name()).collect();
        metrics.extend(errors(&own, &data.time, series, &measured));
        column += columns;
    }
    metrics
}
