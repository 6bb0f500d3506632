//! The case's figures.

use super::Record;
use super::parameters::HydrostaticRun;
use crate::figure::{Axis, Band, Figure, Mark, Panel, Series};
use bagnold_solver::material::rheology::Rheology;

pub(super) fn all(records: &[Record]) -> Vec<Figure> {
    let mut laws: Vec<Rheology> = Vec::new();
    for (run, _) in records {
        if !laws.contains(&run.law) {
            laws.push(run.law);
        }
    }
    let of_law = |law| records.iter().filter(move |(run, _)| run.law == law).collect::<Vec<_>>();
    let panels = laws.into_iter().map(|law| pressure(&of_law(law))).collect();
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
    let material = match run.law {
        Rheology::Newtonian(_) => "Newtonian",
        Rheology::MuI(_) => "μ(I)",
        other => other.name(),
    };
    let coupling = if run.is_coupled() { "with (27)" } else { "without (27)" };
    format!("{material}, {coupling}")
}

fn pressure(records: &[&Record]) -> Panel {
    let (run, _) = records[0];
    let scale = run.density * run.layer.gravity * run.layer.layer_height;
    let mut panel = Panel::new("", Axis::linear("y/H [-]"), Axis::linear("p/(ρ0 g H) [-]"));
    let curve: Vec<f64> = (0..=50).map(|k| f64::from(k) / 50.0).collect();
    let exact = |y: f64| run.pressure(y * run.layer.layer_height) / scale;
    if run.law.is_plastic() {
        let mu = run.law.contact_friction();
        panel.bands.push(Band {
            label: "passive to active state".to_owned(),
            points: curve.iter().map(|&y| (y, exact(y) / (1.0 + mu), exact(y) / (1.0 - mu))).collect(),
        });
    }
    for (slot, (run, record)) in records.iter().rev().enumerate() {
        let Some(frame) = record.frames.last() else { continue };
        let Some((_, _, pressures)) = frame.scalars.iter().find(|(name, _, _)| name == "pressure") else { continue };
        let points =
            frame.position.iter().zip(pressures).map(|(x, p)| (x[1] / run.layer.layer_height, p / scale)).collect();
        panel.series.push(Series::new(&label(run), Mark::Points, 1 - slot.min(1), points));
    }
    panel.series.push(Series::new("exact", Mark::Reference, 0, curve.iter().map(|&y| (y, exact(y))).collect()));
    panel
}
