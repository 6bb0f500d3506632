//! The case's figures.

use super::Record;
use super::run::{LayerPurpose, PROFILE_TIME, SubmergedLayerObservation, SubmergedLayerRun};
use super::verification::consolidation_error;
use crate::figure::{Axis, Figure, Panel};
use crate::reference::one_dimension::submerged::drained_pressure;
use crate::reference::submerged::{SUBMERGED_AVALANCHES, SubmergedAvalanche, TimeCurve};

type Layer<'a> = (&'a SubmergedLayerRun, &'a SubmergedLayerObservation);

/// Solid fraction that divides the panels of loose from those of dense layers `[-]`.
const DENSE: f64 = 0.58;

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let of = |purpose| -> Vec<Layer<'_>> {
        let own = records.iter().filter(|(run, _)| run.purpose == purpose);
        own.map(|(run, record)| (run, &record.data)).collect()
    };
    let (layers, consolidated) = (of(LayerPurpose::Experiment), of(LayerPurpose::Consolidation));
    let mut figures = Vec::new();
    if !layers.is_empty() {
        figures.extend([velocity(&layers), pressure(&layers), profiles(&layers)]);
    }
    if !consolidated.is_empty() {
        figures.push(consolidation(&consolidated));
    }
    figures
}

fn label(run: &SubmergedLayerRun) -> String {
    format!("φ = {}", run.solid_fraction)
}

/// Curves of loose and of dense layers with the measured points.
fn over_time(
    layers: &[Layer<'_>],
    axis: &str,
    computed: fn(&SubmergedLayerObservation) -> TimeCurve,
    measured: fn(&SubmergedAvalanche) -> &TimeCurve,
) -> Vec<Panel> {
    let mut panels = Vec::new();
    for (title, is_dense) in [("loose layers", false), ("dense layers", true)] {
        let mut panel = Panel::new(title, Axis::linear("t [s]"), Axis::linear(axis));
        for (slot, (run, data)) in layers.iter().enumerate() {
            if (run.solid_fraction >= DENSE) != is_dense {
                continue;
            }
            panel.line(&label(run), slot, computed(data).points);
            if let Some(avalanche) = SUBMERGED_AVALANCHES.of(run.solid_fraction) {
                panel.points("", slot, measured(avalanche).points.iter().copied());
            }
        }
        if !panel.series.is_empty() {
            panels.push(panel);
        }
    }
    panels
}

fn velocity(layers: &[Layer<'_>]) -> Figure {
    let panels = over_time(layers, "surface velocity [mm/s]", SubmergedLayerObservation::velocity_curve, |own| {
        &own.surface_velocity
    });
    Figure::new(
        "velocity",
        "Surface velocity after tilting to 25°, by the initial solid fraction: layer (lines) and measurement of Pailha et al. \
         2008 (points). Dense layers dilate before they move. The layer is tilted at once and has no inertia, so that loose \
         layers flow from the start.",
        panels,
    )
}

fn pressure(layers: &[Layer<'_>]) -> Figure {
    let panels = over_time(layers, "excess pore pressure [Pa]", SubmergedLayerObservation::pressure_curve, |own| {
        &own.pore_pressure
    });
    Figure::new(
        "pore-pressure",
        "Excess pore pressure at the floor after tilting: layer (lines) and measurement (points). Dilating layers draw water \
         in and have suction. The measured pressures of 0.588 and 0.592 probably carry an offset of −1.5 to −2 Pa and \
         are not judged.",
        panels,
    )
}

fn profiles(layers: &[Layer<'_>]) -> Figure {
    let height = || Axis::linear("z [mm]");
    let mut panels = [
        Panel::new("solid fraction", Axis::linear("φ [-]"), height()),
        Panel::new("excess pore pressure", Axis::linear("p_f [Pa]"), height()),
        Panel::new("velocity", Axis::linear("u [mm/s]"), height()),
    ];
    for (slot, (run, data)) in layers.iter().enumerate() {
        let Some(profile) = &data.profile else { continue };
        let velocity: Vec<f64> = profile.velocity.iter().map(|velocity| 1e3 * velocity).collect();
        let values = [&profile.solid_fraction, &profile.pore_pressure, &velocity];
        for (place, (panel, values)) in panels.iter_mut().zip(values).enumerate() {
            let points = values.iter().zip(&profile.height).map(|(value, height)| (*value, 1e3 * height));
            let label = if place == 0 { label(run) } else { String::new() };
            panel.line(&label, slot, points);
        }
    }
    let caption = format!(
        "Profiles {PROFILE_TIME} s after tilting. Suction is largest at the undrained floor and zero at the surface. Shear \
         loosens the lower part of a dense layer first."
    );
    Figure::new("profiles", &caption, panels.into()).in_columns(3)
}

fn consolidation(layers: &[Layer<'_>]) -> Figure {
    let mut profile = Panel::new("profile", Axis::linear("p_f/p_0 [-]"), Axis::linear("z/h [-]"));
    let mut errors = Panel::new("error", Axis::logarithmic("cells [-]"), Axis::logarithmic("L2 error [%]"));
    let study: Vec<(f64, f64)> =
        layers.iter().map(|(run, data)| (run.layer.cells as f64, consolidation_error(run, data))).collect();
    if let Some((run, data)) = layers.first()
        && let Some(state) = &data.profile
    {
        let points = state.pore_pressure.iter().zip(&state.height);
        let points = points.map(|(pressure, height)| (pressure / data.initial_pressure, height / run.layer.depth));
        profile.points(&format!("{} cells", run.layer.cells), 0, points);
    }
    if let Some((run, data)) = layers.last()
        && let Some(state) = &data.profile
    {
        let time_factor = run.time_factor(state.time);
        let heights = (0..=100).map(|k| f64::from(k) / 100.0);
        profile.reference("Terzaghi", heights.map(|height| (drained_pressure(height, time_factor), height)));
    }
    errors.order(2, "second order", &study);
    errors.line_points("layer", 0, study);
    Figure::new(
        "consolidation",
        "Consolidation of a compressible layer at rest from a uniform excess pore pressure: profile of the coarsest cells beside \
         Terzaghi's series, and error over the number of cells.",
        vec![profile, errors],
    )
}
