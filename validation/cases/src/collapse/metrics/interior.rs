//! Inside a collapse: energies, velocity over depth, and what stays in its place.

use super::quantities::*;
use crate::case::Flow;
use crate::collapse::column::{failure_angle, pile_of, with_friction};
use crate::collapse::interior::{decay_length, energies, linear_misfit_ratio, stations, wedge_of};
use crate::collapse::{CollapseRecord, ColumnFlow, ExperimentGrains};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity};
use crate::statistics::Mean;

/// What the collapse paper says of its velocity profiles.
const LINEAR_LAYER: &str =
    "statement of the collapse paper: the velocity is linear over the depth of the flowing layer";
/// Share of the variance that a line explains of what counts as linear `[-]`, and why.
const LINEAR: f64 = 0.9;
const LINEAR_REASON: &str = "0.9: a line that explains 90 % of the variance counts as the paper's linear profile";
const AT_THE_SURFACE: &str = "statement of the collapse paper: the velocity is largest at the free surface";
/// Aspect ratio up to which a column is shallow, and part of it has to stay where it was `[-]`.
const SHALLOW: f64 = 1.0;

/// Share of the variance of the velocity over the flowing layer at the column's edge that a line explains, of a run `[-]`.
fn edge_r_squared<const D: usize>((run, record): &CollapseRecord<D>) -> Option<f64> {
    Some(stations(run, record).get(1)?.shear?.r_squared)
}

/// The same of the further seeds of a column: rows of a few particles at one instant scatter, by 0.1 from seed to seed of a column of
/// 20 particles over the half width.
fn r_squared_of_seeds<const D: usize>(run: &ColumnFlow<D>, records: &[CollapseRecord<D>]) -> Vec<f64> {
    let is_seed = |(other, _): &&CollapseRecord<D>| {
        let same = (other.made_of(), other.aspect_ratio, other.resolution);
        other.tells_velocity_alone() && same == (run.made_of(), run.aspect_ratio, run.resolution)
    };
    records.iter().filter(is_seed).filter_map(edge_r_squared).collect()
}

/// All metrics of one run, among all records.
pub(super) fn of_run<const D: usize>((run, record): &CollapseRecord<D>, records: &[CollapseRecord<D>]) -> Vec<Metric> {
    let variant = run.variant();
    let observed = |quantity: Quantity, value: f64| quantity.of(&variant, value).with_snapshot_tolerance(1e-3, 1e-3);
    let mut metrics = vec![
        ENERGY_GAIN
            .of(&variant, 100.0 * energies(&record.data).largest_gain())
            .exactly(0.0, "kinetic and potential energy never exceed those of the start")
            .gated(
                Limit::AtMost(100.0 * run.elastic_share()),
                "limit is the releasable elastic energy of the initial pressure, over the initial potential energy",
            )
            .with_snapshot_tolerance(1e-3, 1e-3),
    ];
    let (stations, spacing) = (stations(run, record), run.spacing());
    let linear =
        |quantity: Quantity, value: f64| observed(quantity, value).against(None, LINEAR_LAYER, Confidence::Medium);
    if let Some(shear) = stations.get(1).and_then(|edge| edge.shear) {
        let values: Vec<f64> = [shear.r_squared].into_iter().chain(r_squared_of_seeds(run, records)).collect();
        let over_seeds = Mean::of(run.resolution, &values).filter(|mean| mean.runs > 1);
        let is_of_paper = run.is_published() && run.grains != ExperimentGrains::Bars;
        let judged = is_of_paper.then_some(Limit::AtLeast(LINEAR));
        let own = judged.filter(|_| over_seeds.is_none());
        metrics.push(linear(FLOWING_LAYER_R_SQUARED, shear.r_squared).gated_by(own, LINEAR_REASON));
        metrics.extend(over_seeds.map(|mean| {
            linear(ENSEMBLE_FLOWING_LAYER_R_SQUARED, mean.value)
                .known_to(Origin::Repeat, Some(mean.standard_error), "standard error of the mean over the seeds")
                .gated_by(judged, LINEAR_REASON)
        }));
    }
    if let Some(edge) = stations.get(1) {
        let stated = |quantity: Quantity, value: Option<f64>, statement: &str| {
            Some(observed(quantity, value?).against(Some(1.0), statement, Confidence::Medium))
        };
        metrics.extend(stated(FASTEST_HEIGHT, edge.fastest_height(spacing), AT_THE_SURFACE));
        metrics.extend(stated(LINEAR_MISFIT_RATIO, linear_misfit_ratio(edge, spacing), LINEAR_LAYER));
    }
    let decay = decay_length(&stations);
    metrics.extend(decay.map(|decay| observed(TAIL_DECAY_LENGTH_OVER_SPACING, decay / spacing)));
    let Some(wedge) = wedge_of(run, &record.frames) else { return metrics };
    metrics.push(observed(UNDISTURBED_SHARE, 100.0 * wedge.undisturbed));
    // of a shallow column no surface is an answer too
    let angle = wedge.angle().or((run.aspect_ratio <= SHALLOW).then_some(f64::NAN));
    metrics.extend(angle.map(|angle| {
        let metric = observed(FAILURE_SURFACE_ANGLE, angle);
        let measured = pile_of(run).and_then(|pile| Some((pile, failure_angle(pile)?)));
        let Some((pile, (angle, error))) = measured else {
            let active = 45.0 + 0.5 * libm::atan(run.material.contact_friction()).to_degrees();
            let source = "Coulomb's active failure plane, 45° + ½ arctan μ_s";
            return metric.against(Some(active), source, Confidence::Unverified);
        };
        let source = "standard error of the line through the measured points";
        let metric = metric.against(Some(angle), &pile.source, pile.confidence);
        let metric = metric.known_to(Origin::Digitisation, Some(error), source);
        with_friction(metric, records, run, |(other, seen)| {
            wedge_of(other, &seen.frames)?.angle().zip(wedge.angle()).map(|(other, own)| other - own)
        })
    }));
    metrics
}
