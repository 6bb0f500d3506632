//! The case's figures.

use super::Record;
use super::errors::{convergence_studies, history_from_rest, particle_history, transient_of};
use super::flow::{BagnoldFlow, Fate, LayerStart};
use crate::figure::{Axis, Figure, Panel};
use crate::reference::one_dimension::TransientHistory;
use crate::shared::Arrangement;

const PROFILES: &str = "Mean velocity over the depth against Bagnold's profile (36), in m/s (left) and as a difference in % of the \
                        exact surface velocity (right).";
const OTHER_GRAINS: &str = "Grains of other materials: mean velocity over the depth against Bagnold's profile of each material, \
                            and the difference in % of the exact surface velocity.";

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let of = |belongs: &dyn Fn(&BagnoldFlow) -> bool| -> Vec<&Record> {
        records.iter().filter(|(run, _)| belongs(run)).collect()
    };
    let first = records.iter().map(|(run, _)| run).find(|run| run.is_steady());
    let is_like = |run: &BagnoldFlow, first: &BagnoldFlow| {
        run.start == first.start && run.arrangement == first.arrangement && run.layer == first.layer
    };
    let steady = of(&|run| run.is_steady() && first.is_some_and(|first| is_like(run, first)));
    let outside = of(&|run| run.start != LayerStart::Uncompressed && run.fate() != Fate::Steady);
    let other_grains = of(&|run| !run.material_name.is_empty() && run.fate() == Fate::Steady);
    let mut figures = Vec::new();
    if !steady.is_empty() {
        let profiles = profiles("velocity-profile", &(PROFILES.to_owned() + &set_up(&steady[0].0)), &steady);
        figures.extend([profiles, transients(&steady)]);
    }
    if !other_grains.is_empty() {
        figures.push(profiles("other-grains", OTHER_GRAINS, &other_grains));
    }
    if !outside.is_empty() {
        figures.push(arrest_and_runaway(&outside));
    }
    figures.extend(convergence(records));
    figures
}

/// Thickness, grains and resolution of a layer, in a sentence.
fn set_up(run: &BagnoldFlow) -> String {
    let exact = run.profile();
    format!(
        " Layer of {:.0} mm, grains of {:.2} mm, solid fraction {:.2}, {} particles over the depth.",
        1e3 * exact.layer_height,
        1e3 * exact.grains.grain_diameter,
        exact.solid_fraction,
        run.layer.resolution
    )
}

fn label(run: &BagnoldFlow) -> String {
    match run.material_name.as_str() {
        "" => format!("{}°", run.slope_angle),
        material => format!("{material}, {}°", run.slope_angle),
    }
}

fn profiles(name: &str, caption: &str, records: &[&Record]) -> Figure {
    let mut absolute = Panel::new("", Axis::linear("u [m/s]"), Axis::linear("y/h [-]"));
    let mut error = Panel::new("", Axis::linear("(u − exact)/u(h) [%]"), Axis::linear("y/h [-]"));
    error.reference("exact", [(0.0, 0.0), (0.0, 1.0)]);
    for (slot, (run, record)) in records.iter().enumerate() {
        let exact = run.profile();
        let Some(surface) = exact.surface_velocity() else { continue };
        let h = exact.layer_height;
        let velocity = |y: f64| exact.velocity(y).unwrap_or(0.0);
        let exact_label = if slot == 0 { "Bagnold (36), exact" } else { "" };
        absolute.reference(exact_label, (0..=100).map(|k| f64::from(k) / 100.0).map(|y| (velocity(y * h), y)));
        let data = &record.data.profile;
        absolute.points(&label(run), slot, data.drawn(&data.velocity, h));
        let difference = |bin: usize| 100.0 * (data.velocity[bin] - velocity(data.height[bin])) / surface;
        let differences = data.filled().map(|bin| (difference(bin), data.height[bin] / h));
        error.line_points(&label(run), slot, differences);
    }
    Figure::new(name, caption, vec![absolute, error])
}

fn transients(records: &[&Record]) -> Figure {
    let mut panel = Panel::new("", Axis::linear("t [s]"), Axis::linear("depth mean of u [m/s]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        if run.start == LayerStart::Rest
            && let Some((history, _)) = history_from_rest(run)
        {
            let name = if slot == 0 { "1-D transient solver" } else { "" };
            panel.reference(name, drawn(&history, record.simulated_time));
        }
        panel.line(&label(run), slot, drawn(&particle_history(&record.data), f64::INFINITY));
    }
    Figure::new(
        "approach",
        "Depth-averaged velocity of layers started from rest, against an independent 1-D transient solver with the \
         same law. The error is evaluated at a quarter, half and three quarters of the rise time.",
        vec![panel],
    )
}

fn arrest_and_runaway(records: &[&Record]) -> Figure {
    let panels = records.iter().enumerate().map(|(slot, (run, record))| {
        let fate = if run.fate() == Fate::Arrest { "arrest" } else { "runaway" };
        let title = format!("{}: {fate}", label(run));
        let mut panel = Panel::new(&title, Axis::linear("t [s]"), Axis::linear("depth mean of u [m/s]"));
        if let Some(history) = transient_of(run, record.simulated_time) {
            panel.reference("1-D transient solver", drawn(&history, f64::INFINITY));
        }
        panel.line("particles", slot, drawn(&particle_history(&record.data), f64::INFINITY));
        panel
    });
    let has = |fate| records.iter().any(|(run, _)| run.fate() == fate);
    let mut caption = String::new();
    if has(Fate::Arrest) {
        caption += "Below the static friction angle a layer with a steady profile comes to rest. ";
    }
    if has(Fate::Runaway) {
        caption += "Above the limiting friction angle a layer accelerates; its run ends at half the sound speed. ";
    } else {
        caption += "Only the paper tier runs layers that accelerate without limit. ";
    }
    caption += "Dashed: 1-D transient solver.";
    Figure::new("arrest-and-runaway", &caption, panels.collect())
}

fn convergence(records: &[Record]) -> Option<Figure> {
    let studies = convergence_studies(records);
    let angle = studies.first()?.0.slope_angle;
    let mut panel =
        Panel::new("", Axis::logarithmic("rows over the layer [-]"), Axis::logarithmic("relative L2 of u [%]"));
    for (study, errors) in studies.into_iter().filter(|(study, _)| study.slope_angle == angle) {
        let (slot, name) = match study.arrangement {
            Arrangement::Lattice => (0, "lattice, from the profile"),
            Arrangement::Jittered => (1, "jittered, from rest"),
        };
        if slot == 0 {
            panel.order(1, "first order", &errors);
        }
        panel.line_points(name, slot, errors);
    }
    let first = panel.series.first()?;
    let (from, to) = (first.points.first()?.0, first.points.last()?.0);
    panel.band("limit with 40 particles", [(from, 1e-3, 0.7), (to, 1e-3, 0.7)]);
    let caption =
        format!("Relative L2 error of the velocity profile at {angle}° over the number of particles across the layer.");
    Some(Figure::new("convergence", &caption, vec![panel]))
}

/// Depth means up to a time `[s]`, at most a few hundred points of them.
fn drawn(history: &TransientHistory, end: f64) -> Vec<(f64, f64)> {
    let points = history.times.iter().copied().zip(history.depth_means.iter().copied());
    let points: Vec<(f64, f64)> = points.filter(|(time, _)| *time <= end).collect();
    let stride = points.len().div_ceil(400).max(1);
    points.into_iter().step_by(stride).collect()
}
