//! The case's figures; 7 to 13 of the paper, redrawn, and the check against the 1-D layer.

use super::BedLoadRecord;
use super::fit::held_out;
use super::flow::{BedLoadFlow, BedLoadFormulation};
use super::metrics::{SteadyFlow, is_fastest};
use super::observation::BedLoadObservation;
use super::run::pair_law_name;
use crate::figure::{Axis, Figure, Panel};
use crate::reference::bed_load::TransportFormula;
use crate::shared::{ascending, percent, transport_panel};
use crate::statistics::{BlockProfile, FittedValue};

pub(super) fn all(records: &[BedLoadRecord]) -> Vec<Figure> {
    let mut figures = Vec::new();
    let mut slopes = ascending(records.iter().map(|(run, _)| run.slope));
    slopes.retain(|slope| beside_paper(records, *slope).next().is_some());
    if !slopes.is_empty() {
        figures.push(water(records, &slopes));
        figures.push(sediment(records, &slopes));
    }
    // a pair from one kept state is shown by the flow between both that would not change
    let shown = |record: &'_ BedLoadRecord| match record {
        (run, _) if run.is_kept() && !run.rests() => {
            SteadyFlow::of(records, record).map(|flow| (format!("{DILATING}, {}", percent(run.slope)), flow.data))
        }
        (run, record) => Some((label(run), record.data.clone())),
    };
    for stage in [BedLoadFormulation::Porous, BedLoadFormulation::Frozen, BedLoadFormulation::Dilating] {
        let layers = records.iter().filter(|(run, record)| run.formulation == stage && record.data.layer.is_some());
        let of_stage: Vec<_> =
            layers.filter_map(|record| shown(record).map(|(name, data)| (&record.0, name, data))).collect();
        if !of_stage.is_empty() {
            figures.push(against_layer(stage, &of_stage));
        }
    }
    figures.push(transport(records));
    figures.push(over_time(records));
    figures
}

/// Name of particles that are a grain each, in every legend.
const PARTICLES: &str = "one particle per grain";
/// Name of grains that dilate, in every legend.
const DILATING: &str = "grains that dilate";
/// Name of grains of a given solid fraction, in every legend.
const FROZEN: &str = "grains of a given solid fraction";

/// Names a run beside others of the case.
fn label(run: &BedLoadFlow) -> String {
    let (model, as_what) = match run.formulation {
        BedLoadFormulation::Stabilised | BedLoadFormulation::Fit => (PARTICLES, ""),
        BedLoadFormulation::Paper => (PARTICLES, ", as printed"),
        BedLoadFormulation::AtRest => (PARTICLES, ", held"),
        BedLoadFormulation::Porous => ("fixed grains", ""),
        BedLoadFormulation::Frozen => (FROZEN, ""),
        BedLoadFormulation::Dilating if run.rests() => ("held grains", ""),
        BedLoadFormulation::Dilating => (DILATING, ""),
    };
    let mut label = format!("{model}, {}{as_what}", percent(run.slope));
    if let (false, Some(law)) = (run.is_judged(), run.pair_law()) {
        label += &format!(", {}", pair_law_name(law));
    }
    if !run.starts_as_usual() {
        label += &format!(", start {}", run.start());
    }
    if run.formulation.is_continuum() && run.spacing() != 1e-3 {
        label += &format!(", {} mm", 1e3 * run.spacing());
    }
    label
}

/// The run of a formulation on a slope.
fn of_kind(records: &[BedLoadRecord], kind: BedLoadFormulation, slope: f64) -> Option<&BedLoadRecord> {
    records.iter().find(|(run, _)| run.formulation == kind && run.slope == slope && is_fastest(records, run))
}

/// Runs of the paper's flow on a slope, with names and colours: one particle a grain, and grains that dilate from the 1-D layer's water.
fn beside_paper(records: &[BedLoadRecord], slope: f64) -> impl Iterator<Item = (&'static str, usize, &BedLoadRecord)> {
    let is_dilating =
        move |(run, _): &&BedLoadRecord| run.dilates() && !run.rests() && run.slope == slope && run.starts_as_usual();
    let grains = of_kind(records, BedLoadFormulation::Stabilised, slope).map(|record| (PARTICLES, 0, record));
    let dilating = records.iter().find(is_dilating).map(|record| (DILATING, 1, record));
    grains.into_iter().chain(dilating)
}

/// Water over the height, with and without moving grains, a panel for each slope.
fn water(records: &[BedLoadRecord], slopes: &[f64]) -> Figure {
    let panel = |&slope: &f64| {
        let mut panel =
            Panel::new(&percent(slope), Axis::logarithmic("z/d [-]").between(0.08, 12.0), Axis::linear("u_f/u_* [-]"));
        let at_rest =
            of_kind(records, BedLoadFormulation::AtRest, slope).map(|record| ("the same bed at rest", 2, record));
        for (name, slot, (run, record)) in beside_paper(records, slope).chain(at_rest) {
            let (diameter, scale) = (run.grain_diameter, run.clear_water().friction_velocity());
            let points = record.data.channel.profile.points();
            let velocities = record.data.channel.profile.velocities();
            let above: Vec<usize> = (0..points.len()).filter(|&k| points[k].height > 0.0).collect();
            let values = above.iter().map(|&k| (points[k].height / diameter, points[k].velocity / scale));
            panel.line_points(name, slot, values).error =
                above.iter().map(|&k| velocities[k].standard_error / scale).collect();
        }
        panel
    };
    let panels: Vec<Panel> = slopes.iter().map(panel).collect();
    let errors = panels.iter().flat_map(|panel| &panel.series).flat_map(|series| &series.error);
    let caption = format!(
        "Mean water velocity above moving grains and above a bed at rest, as in figures 7 to 9 of the bed-load paper \
         (missing in the scan). Parameters are fitted to Wong & Parker's formula. Statistical errors: at most {:.2} u_*.",
        errors.copied().filter(|error| error.is_finite()).fold(0.0, f64::max),
    );
    Figure::new("water", &caption, panels).in_columns(3)
}

/// Velocity of the grains and drag on them over the height, a panel of each for each slope.
fn sediment(records: &[BedLoadRecord], slopes: &[f64]) -> Figure {
    let height = || Axis::linear("z/d [-]").between(-3.0, 1.5);
    let mut velocities = Vec::new();
    let mut drags = Vec::new();
    for &slope in slopes {
        let mut velocity = Panel::new(&percent(slope), Axis::linear("u_s [m/s]"), height());
        let mut drag = Panel::new("", Axis::linear("drag on the grains [kN/m³]"), height());
        for (name, slot, (run, record)) in beside_paper(records, slope) {
            let (data, diameter) = (&record.data, run.grain_diameter);
            let points = data.sediment.points();
            velocity.line_points(name, slot, points.iter().map(|point| (point.velocity, point.height / diameter)));
            drag.line_points("", slot, data.drag_profile().into_iter().map(|(z, force)| (1e-3 * force, z / diameter)));
            let Some(layer) = &data.layer else { continue };
            let heights = layer.height.iter().map(|z| z / diameter);
            let with_grains = heights.zip(&layer.grain_velocity).zip(layer.drag()).zip(&layer.solid_fraction);
            let with_grains: Vec<_> = with_grains.filter(|(_, fraction)| **fraction > 0.0).collect();
            velocity.reference("1-D layer", with_grains.iter().map(|(((z, u), _), _)| (**u, *z)));
            drag.reference("", with_grains.iter().map(|(((z, _), force), _)| (1e-3 * force, *z)));
        }
        velocities.push(velocity);
        drags.push(drag);
    }
    let caption = "Mean grain velocity and drag per volume over the height, as in figures 10 to 13 of the bed-load \
                   paper (missing in the scan). Parameters are fitted to Wong & Parker's formula. Dashed: 1-D layer.";
    let columns = slopes.len();
    velocities.extend(drags);
    Figure::new("sediment", caption, velocities).in_columns(columns)
}

/// A stage of `continuum` against the 1-D layer.
fn against_layer(stage: BedLoadFormulation, flows: &[(&BedLoadFlow, String, BedLoadObservation)]) -> Figure {
    let mut water = Panel::new("", Axis::linear("u_f/u_* [-]"), Axis::linear("z [mm]"));
    let near = || Axis::linear("z [mm]").between(-8.0, 12.0);
    let mut close = Panel::new("", Axis::linear("u_f/u_* [-]").between(0.0, 12.0), near());
    let mut grains = Panel::new("", Axis::linear("u_s/u_* [-]"), near());
    let mut fraction = Panel::new("", Axis::linear("φ [-]"), near());
    for (slot, (run, name, data)) in flows.iter().enumerate() {
        let Some(layer) = &data.layer else { continue };
        let scale = run.clear_water().friction_velocity();
        let curve = |values: &[f64], scale: f64, keep: &dyn Fn(usize) -> bool| -> Vec<(f64, f64)> {
            let inside = (0..layer.height.len()).filter(|k| keep(*k));
            inside.map(|k| (values[k] / scale, 1e3 * layer.height[k])).collect()
        };
        let with_grains = |k: usize| layer.solid_fraction[k] > 0.0;
        let of_layer = if slot == 0 { "1-D layer" } else { "" };
        let exact = curve(&layer.fluid_velocity, scale, &|_| true);
        water.reference(of_layer, exact.clone());
        close.reference("", exact);
        grains.reference("", curve(&layer.grain_velocity, scale, &with_grains));
        fraction.reference("", curve(&layer.solid_fraction, 1.0, &|_| true));
        let of = |profile: &BlockProfile| -> Vec<(f64, f64)> {
            profile.points().iter().map(|point| (point.velocity / scale, 1e3 * point.height)).collect()
        };
        let own = of(&data.channel.profile);
        water.points(name, slot, own.clone());
        close.points("", slot, own);
        grains.points("", slot, of(&data.sediment));
        if stage == BedLoadFormulation::Dilating {
            let own = data.solid_fraction().into_iter().map(|(z, value)| (value, 1e3 * z));
            fraction.points("", slot, own);
        }
    }
    let (panels, others) = match stage {
        BedLoadFormulation::Porous => (vec![water, close], ""),
        BedLoadFormulation::Dilating => {
            (vec![water, close, grains, fraction], ", (c) the grains and (d) their solid fraction")
        }
        _ => (vec![water, close, grains], " and (c) the grains"),
    };
    let name = stage.name();
    let caption = format!(
        "Volume-fraction formulation, stage `{name}`, against an independent 1-D solution with the same closures: \
         velocity of (a) the water over the whole depth, (b) the water near the bed{others}."
    );
    Figure::new(&format!("layer-{name}"), &caption, panels)
}

/// Grains that dilate from another start, with their colour.
const FROM_ANOTHER_START: (&str, usize) = ("grains that dilate, from another start", 4);
/// Runs that show what a law does, with their colour.
const OTHER_PAIR_LAWS: (&str, usize) = ("other laws between pairs", 3);

fn transport(records: &[BedLoadRecord]) -> Figure {
    let mut panel = transport_panel::formulas();
    let mut largest_error: f64 = 0.0;
    let kind = |run: &BedLoadFlow| match run.formulation {
        _ if !run.is_judged() => Some(OTHER_PAIR_LAWS),
        BedLoadFormulation::Stabilised if is_fastest(records, run) => Some((PARTICLES, 0)),
        BedLoadFormulation::Frozen => Some((FROZEN, 2)),
        BedLoadFormulation::Dilating if run.rests() => None,
        BedLoadFormulation::Dilating if run.starts_as_usual() || run.is_kept() => Some((DILATING, 5)),
        BedLoadFormulation::Dilating => Some(FROM_ANOTHER_START),
        _ => None,
    };
    for own @ (name, slot) in [(PARTICLES, 0), (FROZEN, 2), (DILATING, 5), FROM_ANOTHER_START, OTHER_PAIR_LAWS] {
        let rates: Vec<(f64, FittedValue)> = records
            .iter()
            .filter(|(run, _)| kind(run) == Some(own))
            .filter_map(|record| match record {
                (run, _) if run.is_kept() => Some((run, SteadyFlow::of(records, record)?.data.mean_transport())),
                (run, record) => Some((run, record.data.mean_transport())),
            })
            .map(|(run, rate)| (run.stream().shields_number(), rate))
            .filter(|(_, rate)| rate.value > 0.0)
            .collect();
        let errors = rates.iter().map(|(_, rate)| rate.standard_error / rate.value);
        largest_error = errors.filter(|error| error.is_finite()).fold(largest_error, f64::max);
        if !rates.is_empty() {
            let points = rates.iter().map(|(shields, rate)| (*shields, rate.value));
            panel.points(name, slot, points).error = rates.iter().map(|(_, rate)| rate.standard_error).collect();
        }
    }
    let held: Vec<(f64, f64)> = held_out(records)
        .iter()
        .map(|fit| (fit.shields_number, fit.ratio * TransportFormula::WongParker.transport(fit.shields_number)))
        .collect();
    if !held.is_empty() {
        panel.points("one particle per grain, fitted to the other slopes", 7, held);
    }
    let caption = format!(
        "Bed-load transport rate over the Shields number, with published formulas. Band: scatter of the data behind \
         Wong & Parker's formula. Error bars: statistical, at most {:.0} %.",
        100.0 * largest_error
    );
    Figure::new("transport", &caption, vec![panel])
}

fn over_time(records: &[BedLoadRecord]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("t [s]"), Axis::linear("U/U_clear [-]"));
    let mut rate = Panel::new("", Axis::linear("t [s]"), Axis::linear("q* [-]"));
    let shown = records.iter().filter(|(run, _)| run.formulation != BedLoadFormulation::Fit);
    for (slot, (run, record)) in shown.enumerate() {
        let data = &record.data;
        let mean = run.clear_water().mean_velocity();
        let series = &data.channel.series;
        velocity.line(&label(run), slot, series.curve(&data.stream_velocity, mean));
        rate.line("", slot, series.curve(&data.transport, 1.0));
    }
    Figure::new(
        "over-time",
        "Mean water velocity U over the logarithmic law's depth mean U_clear, and transport rate q*, over time. A start is the \
         initial velocity over that law's, or over that of the 1-D layer or the kept state where grains dilate.",
        vec![velocity, rate],
    )
}
