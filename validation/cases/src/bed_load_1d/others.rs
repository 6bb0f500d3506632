//! The layer beside bed load that others have simulated grain by grain or measured.

use super::BedLoad1dRecord;
use super::quantities::{
    FLUID_VELOCITY_DIFFERENCE, FRACTION_DIFFERENCE, GRAIN_VELOCITY_DIFFERENCE, START_DIFFERENCE, TRANSPORT_RATIO,
    TURBULENT_STRESS_DIFFERENCE,
};
use super::records::second_variant;
use super::run::{BedLoad1dRun, LayerPurpose};
use super::suspension;
use super::suspension_inputs::{SuspendedFlow, SuspensionInput};
use crate::case::Run;
use crate::figure::{Axis, Figure, Panel};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity};
use crate::reference::bed_load::{MEASURED_BAND, MeasuredBedLoad};
use crate::reference::one_dimension::bed_load::{Closures, LayerState, STEADY};
use crate::statistics::{Extrapolation, interpolated, neighbour_scatter};

/// Largest root mean square of φ less theirs `[-]`.
const FRACTION_LIMIT: f64 = 0.1;
/// Largest root mean square of velocities less theirs, over their largest `[%]`.
const VELOCITY_LIMIT: f64 = 20.0;

/// Largest root mean square of the stress less theirs, over that on the bed `[%]`.
const STRESS_LIMIT: f64 = 20.0;

/// Largest ratio of the transports of a suspended sheet flow, above or below `[-]`.
const TRANSPORT_FACTOR: f64 = 1.5;

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

/// Profiles beside theirs. Where grains carry a part of the weight, water carries the rest, so that a layer of grains as thick as theirs
/// has the stress of their covariance.
fn profile_metrics((run, record): &BedLoad1dRecord, of: MeasuredBedLoad) -> Vec<Metric> {
    let (theirs, state) = (of.profiles(), &record.data.state);
    let largest = |points: &[(f64, f64)]| 100.0 / points.iter().fold(0.0_f64, |most, point| most.max(point.1.abs()));
    let (density, bed) = (run.stream.fluid_density, run.stream.bed_stress());
    let stresses: Vec<(f64, f64)> = theirs.turbulent_stress.iter().map(|&(z, value)| (z, value * density)).collect();
    let of_profile = |quantity: Quantity, values: &[f64], points: &[(f64, f64)], scale: f64, limit: f64, reason| {
        let value = scale * difference(&state.height, values, points);
        let scatter = neighbour_scatter(points).map(|scatter| (scale * scatter, SCATTER));
        (!points.is_empty()).then_some((quantity, value, scatter, limit, reason))
    };
    let fraction = "a tenth, a sixth of the packed fraction: the source states no uncertainty";
    let velocity = "a fifth of the largest velocity: the source states no uncertainty";
    let (grains, water) = (&theirs.grain_velocity, &theirs.fluid_velocity);
    let of_stress = (!stresses.is_empty()).then(|| {
        let value = 100.0 * difference(&state.face, &state.fluid_stress, &stresses) / bed;
        let scatter = 100.0 * theirs.stress_scatter * density / bed;
        let scatter = (scatter, "scatter of the points about the line through their neighbours");
        let reason = "a fifth of the stress on the bed, as of the velocities";
        (TURBULENT_STRESS_DIFFERENCE, value, Some(scatter), STRESS_LIMIT, reason)
    });
    let metric = |(quantity, value, scatter, limit, reason): (Quantity, f64, Option<(f64, &str)>, f64, &str)| {
        quantity
            .of(&run.variant(), value)
            .against(Some(0.0), &theirs.source, Confidence::Medium)
            .known_to(Origin::Experiment, scatter.map(|own| own.0), scatter.map_or("", |own| own.1))
            .gated(Limit::AtMost(limit), reason)
            .with_snapshot_tolerance(1e-3, 0.0)
    };
    [
        of_profile(FRACTION_DIFFERENCE, &state.solid_fraction, &theirs.solid_fraction, 1.0, FRACTION_LIMIT, fraction),
        of_profile(GRAIN_VELOCITY_DIFFERENCE, &state.grain_velocity, grains, largest(grains), VELOCITY_LIMIT, velocity),
        of_profile(FLUID_VELOCITY_DIFFERENCE, &state.fluid_velocity, water, largest(water), VELOCITY_LIMIT, velocity),
        of_stress,
    ]
    .into_iter()
    .flatten()
    .map(metric)
    .collect()
}

/// Transport and profiles beside theirs.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (layer, of) in all(records) {
        let (run, record) = layer;
        let (theirs, variant) = (of.profiles(), run.variant());
        let ratio = |state: &LayerState| state.transport() / theirs.transport;
        let metric = TRANSPORT_RATIO
            .of(&variant, ratio(&record.data.state))
            .against(Some(1.0), &theirs.source, Confidence::Medium)
            .with_snapshot_tolerance(1e-3, 0.0)
            .known_to(
                Origin::Digitisation,
                Some(THINNED * record.data.state.transport() / theirs.transport),
                "the points that are kept integrate to within 6 % of what all of them do, taken for an even spread",
            );
        metrics.push(if matches!(run.purpose, LayerPurpose::Suspended(..)) {
            let reason =
                "a factor of 1.5, set before the runs: formulas of the total load are usually judged by a factor of 2";
            suspension::with_spread(metric, records, SuspendedFlow::SheetFlow, |_, state| ratio(state))
                .gated(Limit::Within(1.0 / TRANSPORT_FACTOR, TRANSPORT_FACTOR), reason)
        } else {
            let reason = "nine tenths of the runs that Meyer-Peter & Müller measured from τ* = 0.1 on lie there";
            metric.gated(Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1), reason)
        });
        let second = record.data.second.as_ref();
        metrics.extend(second.map(|second| TRANSPORT_RATIO.of(&second_variant(run), ratio(second))));
        metrics.push(
            START_DIFFERENCE
                .of(&variant, record.data.start_difference)
                .exactly(0.0, "the layer from rest: q*, u_f and φ u_s")
                .with_snapshot_tolerance(1.0, 1e-5),
        );
        metrics.extend(profile_metrics(layer, of));
    }
    let theirs = MeasuredBedLoad::SheetFlow.profiles().transport;
    let varied = suspension::layers(records, SuspendedFlow::SheetFlow);
    metrics.extend(varied.filter(|(input, ..)| *input != SuspensionInput::Own).map(|(_, run, state)| {
        TRANSPORT_RATIO.of(&run.variant(), state.transport() / theirs).with_snapshot_tolerance(1e-3, 0.0)
    }));
    metrics
}

/// Profiles over theirs, a row of panels each, and the water of a duct.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let mut panels = Vec::new();
    let mut found = Vec::new();
    for of in [MeasuredBedLoad::GrainSimulation, MeasuredBedLoad::SheetFlow] {
        let layers: Vec<&BedLoad1dRecord> =
            all(records).filter(|(_, other)| *other == of).map(|(layer, _)| layer).collect();
        if layers.is_empty() {
            continue;
        }
        let theirs = of.profiles();
        let heights = theirs.solid_fraction.iter().chain(&theirs.grain_velocity).map(|point| 1e3 * point.0);
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), z| (low.min(z), high.max(z)));
        let top = 0.6 * high + 6.0;
        let inside = |points: &[(f64, f64)], unit: f64| -> Vec<(f64, f64)> {
            points.iter().map(|&(z, value)| (value / unit, 1e3 * z)).filter(|point| point.1 < top).collect()
        };
        let height = || Axis { limits: Some((low - 1.0, top)), ..Axis::linear("z [mm]") };
        let fractions = Axis { limits: Some((GRAINS_FROM, 1.0)), ..Axis::logarithmic("φ [-]") };
        let mut fraction = Panel::new(of.name(), fractions, height());
        let mut velocity = Panel::new("", Axis::linear("velocity [m/s]"), height());
        let mut stress = Panel::new("", Axis::linear("water's stress over that on the bed [-]"), height());
        fraction.points("theirs", 0, inside(&theirs.solid_fraction, 1.0));
        velocity.points("grains, theirs", 0, inside(&theirs.grain_velocity, 1.0));
        if !theirs.fluid_velocity.is_empty() {
            velocity.points("water, theirs", 1, inside(&theirs.fluid_velocity, 1.0));
        }
        let square = of.stream().bed_stress() / of.stream().fluid_density;
        stress.points("theirs, −⟨u'w'⟩/u_*²", 0, inside(&theirs.turbulent_stress, square));
        for (slot, layer) in layers.into_iter().enumerate() {
            let (run, record) = layer;
            let state = &record.data.state;
            let is_suspended = matches!(run.purpose, LayerPurpose::Suspended(..));
            let with = if is_suspended { ", with suspension" } else { "" };
            let curve = |values: &[f64], least: f64| -> Vec<(f64, f64)> {
                let cells = values.iter().zip(&state.height).zip(&state.solid_fraction);
                cells.filter(|(_, fraction)| **fraction >= least).map(|((value, z), _)| (*z, *value)).collect()
            };
            let off = profile_metrics(layer, of).into_iter();
            let off = off.filter(|metric| metric.name == GRAIN_VELOCITY_DIFFERENCE.name).map(|metric| metric.value);
            found.push(format!(
                "{}{with}: q* {:.2} of theirs, rms difference of the grain velocity {:.0} % of the largest",
                of.name(),
                state.transport() / theirs.transport,
                off.sum::<f64>()
            ));
            fraction.line(&format!("layer{with}"), 2 * slot, inside(&curve(&state.solid_fraction, GRAINS_FROM), 1.0));
            let grains = curve(&state.grain_velocity, GRAINS_FROM);
            velocity.line(&format!("grains{with}"), 2 * slot, inside(&grains, 1.0));
            velocity.line(&format!("water{with}"), 2 * slot + 1, inside(&curve(&state.fluid_velocity, 0.0), 1.0));
            let faces: Vec<(f64, f64)> = state.face.iter().copied().zip(state.fluid_stress.iter().copied()).collect();
            stress.line(&format!("layer{with}"), 2 * slot, inside(&faces, state.stream.bed_stress()));
        }
        panels.extend([fraction, velocity]);
        if !theirs.turbulent_stress.is_empty() {
            panels.push(stress);
        }
    }
    let mut caption = format!(
        "The layer beside a grain simulation (Maurin et al.; 6 mm, slope 0.05, τ* 0.6) and a measured sheet flow (Revil-Baudard et al. \
         2015; plastic of 3 mm, τ* 0.44), whose grains are measured far above those of the layer without suspension. Found are: {}. \
         The gates are {:.2} to {:.2} for the ratio of q*, with suspension a factor of {TRANSPORT_FACTOR}, and {VELOCITY_LIMIT} % for the \
         velocity. The sources state no uncertainty. The layer's grains are drawn from a fraction of {GRAINS_FROM} on. The measured \
         stress is the covariance −⟨u'w'⟩; the layer's is what the grains leave to the water.",
        found.join("; "),
        MEASURED_BAND.0,
        MEASURED_BAND.1
    );
    if let Some(duct) = suspension::duct_panel(records) {
        panels.push(duct);
        caption += " Last is the water's velocity in a sheet flow three times as strong. Its heights start where grains have a tenth of \
                    u_*, as the source states no level. The upper half is met; near the bed the layer is slower than the measured water.";
    }
    (!panels.is_empty()).then(|| Figure::new("others", &caption, panels))
}
