//! The case's figures.

use super::Record;
use super::parameters::{HydrostaticRun, MaterialKind};
use crate::figure::{Axis, Band, Figure, Mark, Panel, Series};

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let mut panels = Vec::new();
    for material in [MaterialKind::Newtonian, MaterialKind::MuI] {
        let of_material: Vec<&Record> = records.iter().filter(|(run, _)| run.material == material).collect();
        if !of_material.is_empty() {
            panels.push(pressure(&of_material));
        }
    }
    let mut height = Panel::new("", Axis::linear("t [s]"), Axis::linear("height/H [-]"));
    let mut speed = Panel::new("", Axis::linear("t [s]"), Axis::logarithmic("rms speed [m/s]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let series = &record.data.series;
        let line = |values: &[f64]| series.time.iter().copied().zip(values.iter().copied()).collect::<Vec<_>>();
        height.series.push(Series::new(&label(run), Mark::Line, slot, line(&series.relative_height)));
        speed.series.push(Series::new(&label(run), Mark::Line, slot, line(&series.rms_speed)));
    }
    vec![
        Figure {
            name: "pressure".to_owned(),
            caption:
                "Pressure of every particle at the end, with and without the density–pressure coupling (27), against \
                      the exact profile. For grains the band between the passive and the active state is shaded: any \
                      pressure in it is an equilibrium."
                    .to_owned(),
            columns: 2,
            panels,
        },
        Figure {
            name: "rest".to_owned(),
            caption: "Mean height and root mean square speed over time: a layer at rest must neither sink nor boil. \
                      Its stiffness K = 50 ρ0 g H puts the mean height 0.3 to 0.5 % below that of a rigid layer; without \
                      (27) particles are agitated and stand higher."
                .to_owned(),
            panels: vec![height, speed],
            columns: 2,
        },
    ]
}

fn label(run: &HydrostaticRun) -> String {
    let material = match run.material {
        MaterialKind::Newtonian => "Newtonian",
        MaterialKind::MuI => "μ(I)",
    };
    let coupling = if run.density_coupling > 0.0 { "with (27)" } else { "without (27)" };
    format!("{material}, {coupling}")
}

fn pressure(records: &[&Record]) -> Panel {
    let (run, _) = records[0];
    let scale = run.density * run.gravity * run.layer_height;
    let mut panel = Panel::new("", Axis::linear("y/H [-]"), Axis::linear("p/(ρ0 g H) [-]"));
    let curve: Vec<f64> = (0..=50).map(|k| f64::from(k) / 50.0).collect();
    let exact = |y: f64| run.pressure(y * run.layer_height) / scale;
    if run.material == MaterialKind::MuI {
        let mu = run.static_friction;
        panel.bands.push(Band {
            label: "passive to active state".to_owned(),
            points: curve.iter().map(|&y| (y, exact(y) / (1.0 + mu), exact(y) / (1.0 - mu))).collect(),
        });
    }
    for (slot, (run, record)) in records.iter().rev().enumerate() {
        let Some(frame) = record.frames.last() else { continue };
        let Some((_, _, pressures)) = frame.scalars.iter().find(|(name, _, _)| name == "pressure") else { continue };
        let points = frame.position.iter().zip(pressures).map(|(x, p)| (x[1] / run.layer_height, p / scale)).collect();
        panel.series.push(Series::new(&label(run), Mark::Points, 1 - slot.min(1), points));
    }
    panel.series.push(Series::new("exact", Mark::Reference, 0, curve.iter().map(|&y| (y, exact(y))).collect()));
    panel
}
