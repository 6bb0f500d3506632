//! The case's figures.

use super::HydrostaticRecord;
use super::flow::HydrostaticFlow;
use crate::figure::{Axis, Figure, Panel};
use crate::shared::distinct;
use bagnold_solver::material::rheology::Rheology;

pub(super) fn all(records: &[HydrostaticRecord]) -> Vec<Figure> {
    let laws = distinct(records.iter().map(|(run, _)| run.material));
    let of_law = |law| records.iter().filter(move |(run, _)| run.material == law).collect::<Vec<_>>();
    let panels = laws.into_iter().map(|law| pressure(&of_law(law))).collect();
    let mut height = Panel::new("", Axis::linear("t [s]"), Axis::linear("height/H [-]"));
    let mut speed = Panel::new("", Axis::linear("t [s]"), Axis::logarithmic("rms speed [m/s]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let series = &record.data.series;
        height.line(&label(run), slot, series.curve(&series.relative_height));
        speed.line(&label(run), slot, series.curve(&series.rms_speed));
    }
    let pressures = "Pressure of every particle at the end, with and without the density–pressure coupling (27), against \
        the exact profile. For grains the band between the passive and the active state is shaded: any pressure in it is \
        an equilibrium.";
    let rest = "Mean height and root mean square speed over time. Stiffness K = 50 ρ0 g H lowers the mean height by 0.3 to 0.5 %; \
                without the coupling (27) particles are agitated and stand higher.";
    vec![Figure::new("pressure", pressures, panels).in_columns(2), Figure::new("rest", rest, vec![height, speed])]
}

fn label(run: &HydrostaticFlow) -> String {
    let material = match run.material {
        Rheology::Newtonian(_) => "Newtonian",
        Rheology::MuI(_) => "μ(I)",
        other => other.name(),
    };
    let coupling = if run.is_coupled() { "with coupling (27)" } else { "without coupling (27)" };
    format!("{material}, {coupling}")
}

fn pressure(records: &[&HydrostaticRecord]) -> Panel {
    let (run, _) = records[0];
    let height = run.layer.layer_height;
    let scale = run.density() * run.layer.gravity * height;
    let mut panel = Panel::new("", Axis::linear("y/H [-]"), Axis::linear("p/(ρ0 g H) [-]"));
    let exact = || (0..=50).map(|k| f64::from(k) / 50.0).map(|y| (y, run.pressure(y * height) / scale));
    if run.material.is_plastic() {
        let mu = run.material.contact_friction();
        panel.band("passive to active state", exact().map(|(y, p)| (y, p / (1.0 + mu), p / (1.0 - mu))));
    }
    for (slot, (run, record)) in records.iter().rev().enumerate() {
        let Some(frame) = record.frames.last() else { continue };
        let points = frame.position.iter().zip(frame.scalar("pressure")).map(|(x, p)| (x[1] / height, p / scale));
        panel.points(&label(run), 1 - slot.min(1), points);
    }
    panel.reference("exact", exact());
    panel
}
