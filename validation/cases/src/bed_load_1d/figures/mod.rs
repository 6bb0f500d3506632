//! The case's figures.

mod bed_at_rest;
mod lowest_layer;
mod measured;
mod onset;

use super::BedLoad1dRecord;
use super::flow::BedLoad1dFlow;
use super::metrics::MOVING;
use super::records::{SolvedLayer, of};
use crate::figure::{Axis, Figure, Panel};
use crate::reference::one_dimension::bed_load::LayerState;
use crate::shared::{percent, transport_panel};

pub(super) fn all(records: &[BedLoad1dRecord]) -> Vec<Figure> {
    let layers: Vec<SolvedLayer<'_>> = of(records, BedLoad1dFlow::is_from_rest).collect();
    if layers.is_empty() {
        return Vec::new();
    }
    let mut figures = vec![bed_at_rest::figure(records, &layers), profiles(&layers), transport(&layers)];
    figures.extend(onset::figure(records));
    figures.extend(measured::figure(records));
    figures.extend(lowest_layer::figure(&layers, MOVING));
    figures
}

fn profiles(layers: &[SolvedLayer<'_>]) -> Figure {
    let in_grains = |(run, _): &SolvedLayer<'_>, z: f64| z / run.grain_diameter;
    let near = |layer: &SolvedLayer<'_>| in_grains(layer, 1.6 * layer.1.top_of_grains());
    let top = layers.iter().map(near).fold(0.0, f64::max);
    let depth = layers.iter().map(|layer| in_grains(layer, layer.0.stream().bed_depth)).fold(0.0, f64::max).min(2.0);
    let height = || Axis { limits: Some((-depth, top)), ..Axis::linear("z/d [-]") };
    let mut panels = [
        Panel::new("water", Axis::linear("u_f/u_* [-]"), Axis::logarithmic("z/d [-]").between(0.02, 12.0)),
        Panel::new("grains", Axis::linear("u_s [m/s]"), height()),
        Panel::new("tail of the grains", Axis::logarithmic("u_s [m/s]").between(1e-4, 2.0), height()),
        Panel::new("solid fraction", Axis::linear("φ [-]"), height()),
        Panel::new("drag on the grains", Axis::linear("K (u_f − u_s) [kN/m³]"), height()),
        Panel::new("stresses", Axis { limits: Some((0.0, 1.6)), ..Axis::linear("τ/(ρ_f g h tanθ) [-]") }, height()),
    ];
    for (slot, &(run, state)) in layers.iter().enumerate() {
        let stream = run.stream();
        let label = percent(stream.slope);
        let cells = |values: &[f64], keep: &dyn Fn(usize) -> bool| -> Vec<(f64, f64)> {
            let inside = (0..state.height.len()).filter(|k| keep(*k));
            inside.map(|k| (values[k], state.height[k] / stream.grain_diameter)).collect()
        };
        let with_grains = |k: usize| state.solid_fraction[k] > 0.0;
        let relative: Vec<f64> = state.fluid_velocity.iter().map(|u| u / stream.shear_velocity()).collect();
        let drag: Vec<f64> = state.drag().iter().map(|force| 1e-3 * force).collect();
        let curves = [
            cells(&relative, &|k| state.height[k] > 0.0),
            cells(&state.grain_velocity, &with_grains),
            cells(&state.grain_velocity, &with_grains),
            cells(&state.solid_fraction, &|_| true),
            cells(&drag, &|_| true),
        ];
        for (place, (panel, curve)) in panels.iter_mut().zip(curves).enumerate() {
            panel.line(if place == 0 { &label } else { "" }, slot, curve);
        }
        let faces = |values: &[f64]| -> Vec<(f64, f64)> {
            let relative = |(tau, z): (&f64, &f64)| (tau / stream.bed_stress(), z / stream.grain_diameter);
            values.iter().zip(&state.face).map(relative).collect()
        };
        let name = |text: &str| if slot == 0 { text.to_owned() } else { String::new() };
        panels[5].line(&name("τ_f"), slot, faces(&state.fluid_stress));
        panels[5].line_points(&name("τ_s"), slot, faces(&state.grain_stress));
        let weight = carried(state);
        panels[5].reference(&name("g sinθ ∫ ρ dz"), faces(&weight));
    }
    Figure::new(
        "profiles",
        "Steady 1-D layers over the height in grain diameters, with published closures: grain velocity (figures 10 \
         and 11 of the bed-load paper), drag (figures 12 and 13), stresses of both phases, weight above. The scan \
         lacks these figures.",
        panels.into(),
    )
    .in_columns(2)
}

/// g sinθ ∫_z ρ dz at the faces `[Pa]`.
fn carried(state: &LayerState) -> Vec<f64> {
    let stream = &state.stream;
    let mut carried = vec![0.0; state.face.len()];
    for k in (0..state.height.len()).rev() {
        let fraction = state.solid_fraction[k];
        let density = fraction * stream.grain_density + (1.0 - fraction) * stream.fluid_density;
        carried[k] = carried[k + 1] + density * stream.driving() * state.cell_height;
    }
    carried
}

fn transport(layers: &[SolvedLayer<'_>]) -> Figure {
    let mut panel = transport_panel::formulas();
    let points = layers.iter().map(|(run, state)| (run.stream().shields_number(), state.transport()));
    panel.points("1-D continuum layer", 0, points);
    Figure::new(
        "transport",
        "Bed-load transport rate over the Shields number: 1-D layers and published formulas. All closures but the \
         roughness fade length are published. Band: scatter of the experiments behind Wong & Parker's formula.",
        vec![panel],
    )
}
