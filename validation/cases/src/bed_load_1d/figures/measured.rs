//! The layer beside bed load that others have simulated grain by grain or measured.

use super::super::BedLoad1dRecord;
use super::super::flow::LayerStart;
use super::super::metrics::RESTING;
use super::super::records::{measured_layers, of};
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::reference::bed_load::{MeasuredBedLoad, SHEET_FLOW_LOWEST_VELOCITY};

/// Solid fraction from which on a velocity of grains is drawn `[-]`.
const GRAINS_FROM: f64 = 1e-3;

/// Profiles over theirs, a row of panels each, and the water of a duct.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let mut panels = Vec::new();
    for of in MeasuredBedLoad::ALL {
        let layers: Vec<&BedLoad1dRecord> =
            measured_layers(records).filter(|(_, other)| *other == of).map(|(layer, _)| layer).collect();
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
        velocity.points("grains, published", 0, inside(&theirs.grain_velocity, 1.0));
        if !theirs.fluid_velocity.is_empty() {
            velocity.points("water, published", 1, inside(&theirs.fluid_velocity, 1.0));
        }
        let square = of.stream().bed_stress() / of.stream().fluid_density;
        stress.points("published, −⟨u'w'⟩/u_*²", 0, inside(&theirs.turbulent_stress, square));
        for (slot, layer) in layers.into_iter().enumerate() {
            let (run, record) = layer;
            let state = &record.data.state;
            let with = if run.is_suspended() { ", with suspension" } else { "" };
            let curve = |values: &[f64], least: f64| -> Vec<(f64, f64)> {
                let cells = values.iter().zip(&state.height).zip(&state.solid_fraction);
                cells.filter(|(_, fraction)| **fraction >= least).map(|((value, z), _)| (*z, *value)).collect()
            };
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
    let mut caption = "1-D layers with a simulation of grains (Maurin et al.; 6 mm, slope 0.05, τ* 0.6) and a \
        measured sheet flow (Revil-Baudard et al. 2015; 3 mm, τ* 0.44). The sources state no uncertainty."
        .to_owned();
    if let Some(duct) = duct_panel(records) {
        panels.push(duct);
        caption += " Last panel: water velocity in a sheet flow at τ* 1.4.";
    }
    (!panels.is_empty()).then(|| Figure::new("others", &caption, panels))
}

/// The water of the duct beside the measured points; none without the layers.
fn duct_panel(records: &[BedLoad1dRecord]) -> Option<Panel> {
    let height = Axis::linear("height above grains at rest, over d [-]").between(0.0, 23.0);
    let mut duct = Panel::new("Sumer et al. 1996, τ* 1.4", Axis::linear("u_f/u_* [-]"), height);
    let measured = &SHEET_FLOW_LOWEST_VELOCITY.points;
    duct.points("measured", 0, measured.iter().map(|&(z, u)| (u, z)));
    for (run, state) in of(records, |run| run.published() == Some("duct")) {
        let (label, slot) = match run.start {
            LayerStart::Both => ("with suspension", 1),
            _ if !run.is_suspended() => ("without", 2),
            _ => continue,
        };
        let unit = run.stream().shear_velocity();
        let Some(level) = state.moves_above(RESTING.0 * unit) else { continue };
        let place = |k: usize| (state.fluid_velocity[k] / unit, (state.height[k] - level) / run.grain_diameter);
        let curve = (0..state.height.len()).map(place).filter(|point| point.1 > 0.0 && point.1 < 23.0).collect();
        duct.series.push(Series::new(label, Mark::Line, slot, curve));
    }
    (duct.series.len() > 1).then_some(duct)
}
