//! The layer beside bed load that others have simulated grain by grain or measured.

use super::BedLoad1dRecord;
use super::run::{BedLoad1dRun, LayerPurpose};
use super::suspension;
use super::suspension_inputs::{SuspendedFlow, SuspensionInput};
use crate::case::Run;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity, quantities};
use crate::reference::bed_load::{MEASURED_BAND, MeasuredBedLoad};
use crate::reference::one_dimension::bed_load::{Closures, LayerState, STEADY};
use crate::statistics::{Extrapolation, interpolated, neighbour_scatter};

quantities! {
    shared pub(super)
    FRACTION_DIFFERENCE: validated("fraction_difference", "-", "√⟨(φ − φ_published)²⟩ over the published heights"),
    GRAIN_VELOCITY_DIFFERENCE: validated(
        "grain_velocity_difference", "%",
        "√⟨(u_s − u_published)²⟩ over the largest published velocity",
    ),
    FLUID_VELOCITY_DIFFERENCE:
        validated("fluid_velocity_difference", "%", "√⟨(u_f − u_published)²⟩ over the largest published velocity"),
    TURBULENT_STRESS_DIFFERENCE: validated(
        "turbulent_stress_difference", "%",
        "√⟨(τ_f − τ_published)²⟩ over the bed stress",
    ),
}

/// Largest root mean square of φ less theirs `[-]`.
const FRACTION_LIMIT: f64 = 0.1;
/// Largest root mean square of velocities less theirs, over their largest `[%]`.
const VELOCITY_LIMIT: f64 = 20.0;

/// Largest root mean square of the stress less theirs, over that on the bed `[%]`.
const STRESS_LIMIT: f64 = 20.0;

/// How far the integral of a thinned profile may be off, as the deviation of an even spread `[-]`.
const THINNED: f64 = 0.035;

/// Height of a cell `[m]`: it divides the depths of both.
const CELL_HEIGHT: f64 = 5e-4;

/// Solid fraction from which on a velocity of grains is drawn `[-]`.
const GRAINS_FROM: f64 = 1e-3;

const SCATTER: &str =
    "an upper bound: distance of their points to the line through their neighbours, which holds the profile's own bend";

/// Every layer with the case's closures.
pub(super) fn runs(measured: &[MeasuredBedLoad], closures: Closures) -> Vec<BedLoad1dRun> {
    let new = |of: &MeasuredBedLoad| BedLoad1dRun {
        purpose: LayerPurpose::Measured(*of),
        stream: of.stream(),
        closures,
        cell_height: CELL_HEIGHT,
        steady_change: STEADY,
    };
    measured.iter().map(new).collect()
}

fn all(records: &[BedLoad1dRecord]) -> impl Iterator<Item = (&BedLoad1dRecord, MeasuredBedLoad)> {
    records.iter().filter_map(|record| match record.0.purpose {
        LayerPurpose::Measured(of) => Some((record, of)),
        LayerPurpose::Suspended(SuspendedFlow::SheetFlow, SuspensionInput::Own) => {
            Some((record, MeasuredBedLoad::SheetFlow))
        }
        _ => None,
    })
}

/// Root mean square of the layer's values less theirs, at the heights of their points.
fn difference(height: &[f64], values: &[f64], theirs: &[(f64, f64)]) -> f64 {
    let ours: Vec<(f64, f64)> = height.iter().copied().zip(values.iter().copied()).collect();
    let at = |z: f64| interpolated(&ours, z, (Extrapolation::EndValue, Extrapolation::EndValue)).unwrap_or(f64::NAN);
    let sum: f64 = theirs.iter().map(|&(z, value)| (at(z) - value).powi(2)).sum();
    (sum / theirs.len() as f64).sqrt()
}

/// Profiles beside theirs.
fn profile_metrics((run, record): &BedLoad1dRecord, of: MeasuredBedLoad) -> Vec<Metric> {
    let (theirs, state) = (of.profiles(), &record.data.state);
    let of_profile =
        |quantity: Quantity, values: &[f64], points: &[(f64, f64)], scale: f64, limit: f64, reason: &str| {
            if points.is_empty() || values.len() != state.height.len() || values.len() < 2 {
                return None;
            }
            let metric = quantity.of(&run.variant(), scale * difference(&state.height, values, points));
            let metric =
                metric.against(Some(0.0), &theirs.source, Confidence::Medium).with_snapshot_tolerance(1e-3, 0.0);
            let scatter = neighbour_scatter(points).map(|scatter| scale * scatter);
            let metric = metric.known_to(Origin::Experiment, scatter, SCATTER);
            Some(metric.gated(Limit::AtMost(limit), reason))
        };
    let largest = |points: &[(f64, f64)]| 100.0 / points.iter().fold(0.0_f64, |most, point| most.max(point.1.abs()));
    let fraction = "a tenth, a sixth of the packed fraction: the source states no uncertainty";
    let velocity = "a fifth of the largest velocity: the source states no uncertainty";
    let (grains, water) = (&theirs.grain_velocity, &theirs.fluid_velocity);
    [
        of_profile(FRACTION_DIFFERENCE, &state.solid_fraction, &theirs.solid_fraction, 1.0, FRACTION_LIMIT, fraction),
        of_profile(GRAIN_VELOCITY_DIFFERENCE, &state.grain_velocity, grains, largest(grains), VELOCITY_LIMIT, velocity),
        of_profile(FLUID_VELOCITY_DIFFERENCE, &state.fluid_velocity, water, largest(water), VELOCITY_LIMIT, velocity),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The water's stress beside their covariance, over the height where they measured one: where grains carry a part of the weight, water
/// carries the rest, so that a layer of grains as thick as theirs has the same.
fn stress_metric((run, record): &BedLoad1dRecord, of: MeasuredBedLoad) -> Option<Metric> {
    let (theirs, state) = (of.profiles(), &record.data.state);
    let bed = run.stream.bed_stress();
    let points: Vec<(f64, f64)> =
        theirs.turbulent_stress.iter().map(|&(z, value)| (z, value * run.stream.fluid_density)).collect();
    if points.is_empty() || state.face.len() != state.fluid_stress.len() {
        return None;
    }
    let scatter = 100.0 * theirs.stress_scatter * run.stream.fluid_density / bed;
    Some(
        TURBULENT_STRESS_DIFFERENCE
            .of(&run.variant(), 100.0 * difference(&state.face, &state.fluid_stress, &points) / bed)
            .against(Some(0.0), &theirs.source, Confidence::Medium)
            .with_snapshot_tolerance(1e-3, 0.0)
            .known_to(
                Origin::Experiment,
                Some(scatter),
                "scatter of the points about the line through their neighbours",
            )
            .gated(Limit::AtMost(STRESS_LIMIT), "a fifth of the stress on the bed, as of the velocities"),
    )
}

/// Transport and profiles beside theirs.
pub(super) fn metrics(
    records: &[BedLoad1dRecord],
    ratio: Quantity,
    transport: Quantity,
    start: Quantity,
) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (layer, of) in all(records) {
        let (run, record) = layer;
        let theirs = of.profiles();
        let variant = run.variant();
        let own = record.data.state.transport();
        let metric = ratio
            .of(&variant, own / theirs.transport)
            .against(Some(1.0), &theirs.source, Confidence::Medium)
            .with_snapshot_tolerance(1e-3, 0.0)
            .known_to(
                Origin::Digitisation,
                Some(THINNED * own / theirs.transport),
                "the points that are kept integrate to within 6 % of what all of them do, taken for an even spread",
            );
        metrics.push(if matches!(run.purpose, LayerPurpose::Suspended(..)) {
            let value = |_: &BedLoad1dRun, state: &LayerState| state.transport() / theirs.transport;
            let (limit, reason) = suspension::transport_limit();
            let spread = suspension::spread(records, SuspendedFlow::SheetFlow, value);
            suspension::with_spread(metric, spread).gated(limit, reason)
        } else {
            let reason = "nine tenths of the runs that Meyer-Peter & Müller measured from τ* = 0.1 on lie there";
            metric.gated(Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1), reason)
        });
        metrics.extend([
            transport
                .of(&variant, own)
                .against(Some(theirs.transport), &theirs.source, Confidence::Medium)
                .with_snapshot_tolerance(1e-3, 0.0),
            start
                .of(&variant, record.data.start_difference)
                .against(Some(0.0), "the layer from rest: q*, u_f and φ u_s", Confidence::Exact)
                .with_snapshot_tolerance(1.0, 1e-5),
        ]);
        metrics.extend(profile_metrics(layer, of));
        metrics.extend(stress_metric(layer, of));
    }
    metrics
}

/// Profiles over theirs, a row of panels each.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let mut panels = Vec::new();
    let mut found = Vec::new();
    for of in [MeasuredBedLoad::GrainSimulation, MeasuredBedLoad::SheetFlow] {
        let layers: Vec<&BedLoad1dRecord> =
            records.iter().filter(|(run, _)| run.purpose == LayerPurpose::Measured(of)).collect();
        if layers.is_empty() {
            continue;
        }
        let theirs = of.profiles();
        let inside = |points: &[(f64, f64)]| points.iter().map(|&(z, value)| (value, 1e3 * z)).collect::<Vec<_>>();
        let heights = theirs.solid_fraction.iter().chain(&theirs.grain_velocity).map(|point| 1e3 * point.0);
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), z| (low.min(z), high.max(z)));
        let height = || Axis { limits: Some((low - 1.0, 0.6 * high + 6.0)), ..Axis::linear("z [mm]") };
        let mut fraction = Panel::new(of.name(), Axis::linear("φ [-]"), height());
        let mut velocity = Panel::new("", Axis::linear("velocity [m/s]"), height());
        fraction.series.push(Series::new("theirs", Mark::Points, 0, inside(&theirs.solid_fraction)));
        velocity.series.push(Series::new("grains, theirs", Mark::Points, 0, inside(&theirs.grain_velocity)));
        if !theirs.fluid_velocity.is_empty() {
            velocity.series.push(Series::new("water, theirs", Mark::Points, 1, inside(&theirs.fluid_velocity)));
        }
        let states: Vec<_> = layers.iter().map(|(_, record)| &record.data.state).collect();
        for (slot, (_, record)) in layers.iter().enumerate() {
            let state = &record.data.state;
            let curve = |values: &[f64], least_fraction: f64| -> Vec<(f64, f64)> {
                let drawn = |k: &usize| {
                    values.len() == state.height.len()
                        && state.height[*k] < 1e-3 * (0.6 * high + 6.0)
                        && state.solid_fraction[*k] >= least_fraction
                };
                (0..values.len()).filter(drawn).map(|k| (values[k], 1e3 * state.height[k])).collect()
            };
            let metrics = profile_metrics(layers[slot], of);
            let off = metrics.iter().find(|metric| metric.name == GRAIN_VELOCITY_DIFFERENCE.name);
            let off = off.map_or(f64::NAN, |metric| metric.value);
            let ratio = state.transport() / theirs.transport;
            found.push(format!(
                "{}: q* {ratio:.2} of theirs, rms difference of the grain velocity {off:.0} % of the largest",
                of.name()
            ));
            fraction.series.push(Series::new("layer", Mark::Line, 2 * slot, curve(&state.solid_fraction, 0.0)));
            let grains = curve(&state.grain_velocity, GRAINS_FROM);
            velocity.series.push(Series::new("grains", Mark::Line, 2 * slot, grains));
            velocity.series.push(Series::new("water", Mark::Line, 2 * slot + 1, curve(&state.fluid_velocity, 0.0)));
        }
        let mut stress = Panel::new("", Axis::linear("water's stress over that on the bed [-]"), height());
        if !theirs.turbulent_stress.is_empty() {
            let square = of.stream().bed_stress() / of.stream().fluid_density;
            let relative: Vec<(f64, f64)> = theirs
                .turbulent_stress
                .iter()
                .map(|&(z, value)| (z, value / square))
                .filter(|point| 1e3 * point.0 < 0.6 * high + 6.0)
                .collect();
            stress.series.push(Series::new("theirs, −⟨u'w'⟩/u_*²", Mark::Points, 0, inside(&relative)));
            for (slot, state) in states.iter().enumerate() {
                let faces = state.face.iter().zip(&state.fluid_stress).filter(|(z, _)| **z < 1e-3 * (0.6 * high + 6.0));
                let curve: Vec<_> = faces.map(|(z, tau)| (tau / state.stream.bed_stress(), 1e3 * z)).collect();
                let suffix = if layers[slot].0.closures.turbulent_schmidt > 0.0 { ", with dispersion" } else { "" };
                stress.line(&format!("layer{suffix}"), 2 * slot, curve);
            }
        }
        panels.extend([fraction, velocity]);
        if !stress.series.is_empty() {
            panels.push(stress);
        }
    }
    let caption = format!(
        "The layer beside a grain simulation (Maurin et al.; 6 mm, slope 0.05, τ* 0.6) and a measured sheet flow (Revil-Baudard et al. \
         2015; plastic of 3 mm, τ* 0.44). Found are: {}. The gates are {:.2} to {:.2} for the ratio of q* and {VELOCITY_LIMIT} % for the \
         velocity. The sources state no uncertainty. Grains of the sheet flow are measured far above those of the layer, which has no \
         suspension here. Velocities of the layer's grains are drawn from a fraction of {GRAINS_FROM} on. \
         The measured stress is the covariance −⟨u'w'⟩; the layer's is what the grains leave to the water.",
        found.join("; "),
        MEASURED_BAND.0,
        MEASURED_BAND.1
    );
    (!panels.is_empty()).then(|| Figure::new("others", &caption, panels))
}
