//! The case's figures; 7 to 13 of the paper, redrawn, and the check against the 1-D layer.

use super::BedLoadRecord;
use super::fit::held_out;
use super::parameters::Stage;
use super::run::ContinuumRun;
use super::run::{BedLoadFormulation, BedLoadRun};
use super::runs::pair_law_name;
use crate::figure::{Axis, Figure, Panel};
use crate::reference::bed_load::TransportFormula;
use crate::shared::transport_panel;
use crate::statistics::{BlockProfile, mean};

pub(super) fn all(records: &[BedLoadRecord]) -> Vec<Figure> {
    let mut figures = Vec::new();
    let grains: Vec<&BedLoadRecord> =
        records.iter().filter(|(run, _)| matches!(run.formulation, BedLoadFormulation::Stabilised(_))).collect();
    if !grains.is_empty() {
        figures.push(water(&grains));
        figures.push(sediment(&grains));
    }
    let layers: Vec<&BedLoadRecord> = records.iter().filter(|(_, record)| record.data.layer.is_some()).collect();
    for stage in [Stage::Porous, Stage::Frozen, Stage::Dilating] {
        let of_stage: Vec<&BedLoadRecord> =
            layers.iter().copied().filter(|(run, _)| stage_of(run) == Some(stage)).collect();
        if !of_stage.is_empty() {
            figures.push(against_layer(stage, &of_stage));
        }
    }
    figures.push(transport(records));
    figures.push(over_time(records));
    figures
}

fn stage_of(run: &BedLoadRun) -> Option<Stage> {
    match &run.formulation {
        BedLoadFormulation::Continuum(own) => Some(own.stage),
        _ => None,
    }
}

fn percent(run: &BedLoadRun) -> String {
    format!("{} %", (1e4 * run.slope).round() / 100.0)
}

/// Names a run beside others of the case.
fn label(run: &BedLoadRun) -> String {
    match &run.formulation {
        BedLoadFormulation::Paper(_) => format!("paper, {}", percent(run)),
        BedLoadFormulation::Stabilised(_) => format!("stabilised, {}", percent(run)),
        BedLoadFormulation::Fit { .. } => format!("fit, {}", percent(run)),
        BedLoadFormulation::Continuum(own) => {
            let ContinuumRun { stage, pair_law, start, spacing, .. } = own;
            let mut label = format!("{}, {}", stage.name(), percent(run));
            if let (false, Some(law)) = (own.is_judged(), pair_law) {
                label += &format!(", {}", pair_law_name(*law));
            }
            if *start != 1.0 {
                label += ", slow start";
            }
            if *spacing != 1e-3 {
                label += &format!(", {} mm", 1e3 * spacing);
            }
            label
        }
    }
}

/// Water over height in units of the grain diameter, with clear water.
fn water(records: &[&BedLoadRecord]) -> Figure {
    let mut profile = Panel::new("", Axis::logarithmic("(z + z_0)/d [-]"), Axis::linear("u_f/u_* [-]"));
    let mut deficit = Panel::new("", Axis::linear("z/d [-]"), Axis::linear("(u_f − u_clear)/u_* [-]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let law = run.clear_water();
        let (diameter, scale) = (run.materials.grain_diameter, law.friction_velocity());
        let points = record.data.channel.profile.points();
        let velocities = record.data.channel.profile.velocities();
        let above: Vec<usize> = (0..points.len()).filter(|&k| points[k].height > 0.0).collect();
        let error: Vec<f64> = above.iter().map(|&k| velocities[k].standard_error / scale).collect();
        let in_axes = |z: f64, velocity: f64| ((z + law.origin_offset) / diameter, velocity / scale);
        let values = above.iter().map(|&k| in_axes(points[k].height, points[k].velocity));
        let difference = |z: f64, velocity: f64| (z / diameter, (velocity - law.velocity(z)) / scale);
        let differences = above.iter().map(|&k| difference(points[k].height, points[k].velocity));
        if slot == 0 {
            let heights = (1..=80).map(|k| 0.1 * diameter * libm::pow(92.0, f64::from(k) / 80.0));
            profile.reference("clear water", heights.map(|z| in_axes(z, law.velocity(z))));
        }
        profile.line_points(&percent(run), slot, values).error.clone_from(&error);
        deficit.line_points("", slot, differences).error = error;
    }
    Figure::new(
        "water",
        "Mean velocity of the water over the moving bed in half-logarithmic axes, beside clear water over a fixed \
         bed of the same grains, a straight line with the offset z_0 of its law, and the difference of the two; bars \
         are statistical errors from blocks of time. Figures 7 to 9 of the paper show two layers of different slope \
         at 3 % and three at 5 %.",
        vec![profile, deficit],
    )
}

/// Grains and drag over height.
fn sediment(records: &[&BedLoadRecord]) -> Figure {
    let mut velocity = Panel::new("", Axis::logarithmic("u_s [m/s]"), Axis::linear("z/d [-]"));
    let mut drag = Panel::new("", Axis::linear("drag on the grains [N/m³]"), Axis::linear("z/d [-]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let diameter = run.materials.grain_diameter;
        let points = record.data.sediment.points();
        let moving = points.iter().filter(|point| point.velocity > 1e-5);
        let values = moving.map(|point| (point.velocity, point.height / diameter));
        velocity.line_points(&percent(run), slot, values);
        let forces = record.data.drag_profile().into_iter().map(|(z, force)| (force, z / diameter));
        drag.line_points("", slot, forces);
    }
    Figure::new(
        "sediment",
        "Mean velocity of the grains and drag on them per volume. Figures 10 to 13 of the paper show velocities that \
         are concave above the bed's top and decay below it, and a drag that peaks near the top. With one particle a \
         grain and friction on the overburden, only the top row moves at small slopes: the tail below is not \
         reproduced.",
        vec![velocity, drag],
    )
}

/// A stage of `continuum` against the 1-D layer.
fn against_layer(stage: Stage, records: &[&BedLoadRecord]) -> Figure {
    let mut water = Panel::new("", Axis::linear("u_f/u_* [-]"), Axis::linear("z [mm]"));
    let near = || Axis::linear("z [mm]").between(-8.0, 12.0);
    let mut close = Panel::new("", Axis::linear("u_f/u_* [-]").between(0.0, 12.0), near());
    let mut grains = Panel::new("", Axis::linear("u_s/u_* [-]"), near());
    let mut fraction = Panel::new("", Axis::linear("φ [-]"), near());
    for (slot, (run, record)) in records.iter().enumerate() {
        let Some(layer) = &record.data.layer else { continue };
        let scale = run.clear_water().friction_velocity();
        let curve = |values: &[f64], scale: f64, keep: &dyn Fn(usize) -> bool| -> Vec<(f64, f64)> {
            let inside = (0..layer.height.len()).filter(|k| keep(*k));
            inside.map(|k| (values[k] / scale, 1e3 * layer.height[k])).collect()
        };
        let with_grains = |k: usize| layer.solid_fraction[k] > 0.0;
        let name = if slot == 0 { "1-D layer" } else { "" };
        let exact = curve(&layer.fluid_velocity, scale, &|_| true);
        water.reference(name, exact.clone());
        close.reference("", exact);
        grains.reference("", curve(&layer.grain_velocity, scale, &with_grains));
        fraction.reference("", curve(&layer.solid_fraction, 1.0, &|_| true));
        let of = |profile: &BlockProfile| -> Vec<(f64, f64)> {
            profile.points().iter().map(|point| (point.velocity / scale, 1e3 * point.height)).collect()
        };
        let own = of(&record.data.channel.profile);
        water.points(&label(run), slot, own.clone());
        close.points("", slot, own);
        grains.points("", slot, of(&record.data.sediment));
        if stage == Stage::Dilating {
            let own = record.data.solid_fraction().into_iter().map(|(z, value)| (value, 1e3 * z));
            fraction.points("", slot, own);
        }
    }
    let panels = match stage {
        Stage::Porous => vec![water, close],
        Stage::Frozen => vec![water, close, grains],
        Stage::Dilating => vec![water, close, grains, fraction],
    };
    let name = stage.name();
    let caption = format!(
        "Stage `{name}` of the volume-fraction form against the 1-D layer of the same closures, whose discretisation is \
         independent: the whole depth of the water and the neighbourhood of the bed."
    );
    Figure::new(&format!("layer-{name}"), &caption, panels)
}

fn has_judged_law(run: &BedLoadRun) -> bool {
    matches!(&run.formulation, BedLoadFormulation::Continuum(own) if own.is_judged())
}

/// Whether a run belongs to a kind.
type RunFilter = fn(&BedLoadRun) -> bool;

fn transport(records: &[BedLoadRecord]) -> Figure {
    let mut panel = transport_panel::formulas();
    let kinds: [(&str, usize, RunFilter); 4] = [
        ("Bingham grains, fitted elsewhere", 0, |run| matches!(run.formulation, BedLoadFormulation::Stabilised(_))),
        ("grains of a given solid fraction", 2, |run| stage_of(run) == Some(Stage::Frozen) && has_judged_law(run)),
        ("grains that dilate", 5, |run| stage_of(run) == Some(Stage::Dilating) && has_judged_law(run)),
        ("other laws between pairs", 3, |run| stage_of(run).is_some() && !has_judged_law(run)),
    ];
    for (name, slot, belongs) in kinds {
        let points: Vec<(f64, f64)> = records
            .iter()
            .filter(|(run, _)| belongs(run))
            .map(|(run, record)| (run.stream().shields_number(), mean(&record.data.transport_in_window())))
            .filter(|(_, value)| *value > 0.0)
            .collect();
        if !points.is_empty() {
            panel.points(name, slot, points);
        }
    }
    let held: Vec<(f64, f64)> = held_out(records)
        .iter()
        .map(|fit| (fit.shields_number, fit.ratio * TransportFormula::WongParker.transport(fit.shields_number)))
        .collect();
    if !held.is_empty() {
        panel.points("stabilised, slope held out", 7, held);
    }
    Figure::new(
        "transport",
        "Bed-load transport over the Shields number against published formulas. The band about Wong & Parker's \
         formula is the scatter of the experiments behind it.",
        vec![panel],
    )
}

fn over_time(records: &[BedLoadRecord]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("t [s]"), Axis::linear("U/U_clear [-]"));
    let mut rate = Panel::new("", Axis::linear("t [s]"), Axis::linear("q* [-]"));
    let shown = records.iter().filter(|(run, _)| !matches!(run.formulation, BedLoadFormulation::Fit { .. }));
    for (slot, (run, record)) in shown.enumerate() {
        let data = &record.data;
        let mean = run.clear_water().mean_velocity();
        let series = &data.channel.series;
        velocity.line(&label(run), slot, series.curve(&data.stream_velocity, mean));
        rate.line("", slot, series.curve(&data.transport, 1.0));
    }
    Figure::new(
        "over-time",
        "Velocity of the stream above the bed over that of clear water, and the transport rate, from the start on.",
        vec![velocity, rate],
    )
}
