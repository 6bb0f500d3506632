//! The case's figures.

use super::StillWaterRecord;
use super::flow::StillWaterFlow;
use crate::figure::{Axis, Field, Figure, Panel};
use crate::observation::{Frame, Outcome};

fn label(run: &StillWaterFlow) -> String {
    let stabilisation = if run.is_unstabilised() { ", not stabilised" } else { "" };
    format!("jitter {}{stabilisation}", run.jitter)
}

/// Height above the floor over the depth, and pressure over that of the floor, of every particle.
fn pressures(run: &StillWaterFlow, frame: &Frame) -> Vec<(f64, f64)> {
    let depth = run.water.depth;
    let scale = run.water.density * run.water.gravity * depth;
    frame.position.iter().zip(frame.scalar("pressure")).map(|(x, p)| (x[1] / depth, p / scale)).collect()
}

pub(super) fn pressure(records: &[StillWaterRecord]) -> Figure {
    let mut profile = Panel::new("", Axis::linear("z/h [-]"), Axis::linear("p/(ρ g h) [-]"));
    let mut error = Panel::new("", Axis::linear("z/h [-]"), Axis::linear("p/(ρ g h) − (1 − z/h) [%]"));
    for (slot, (run, record)) in records.iter().filter(|(run, _)| !run.is_unstabilised()).enumerate() {
        let points = record.frames.last().map(|frame| pressures(run, frame)).unwrap_or_default();
        let errors = points.iter().map(|&(z, p)| (z, 100.0 * (p - (1.0 - z))));
        error.points("", slot, errors);
        profile.points(&label(run), slot, points);
    }
    profile.reference("hydrostatic", [(0.0, 1.0), (1.0, 0.0)]);
    error.reference("", [(0.0, 0.0), (1.0, 0.0)]);
    Figure::new(
        "pressure",
        "Pressure of every particle at the end of the run with the hydrostatic pressure, and their difference in % \
         of the pressure on the floor.",
        vec![profile, error],
    )
}

pub(super) fn rest(records: &[StillWaterRecord]) -> Figure {
    let mut height = Panel::new("", Axis::linear("t [s]"), Axis::linear("mean height/(h/2) [-]"));
    let mut speed = Panel::new("", Axis::logarithmic("t [s]"), Axis::logarithmic("rms vertical velocity [m/s]"));
    let longest = records.iter().map(|(run, _)| run.duration).fold(0.0, f64::max);
    for (slot, (run, record)) in records.iter().enumerate() {
        let series = &record.data.series;
        let name = label(run);
        // its height has no bound and would hide that of the others
        if !run.is_unstabilised() {
            height.line(&name, slot, series.curve(&series.relative_height, 1.0));
        }
        speed.line(&name, slot, series.curve(&series.rms_vertical_velocity, 1.0));
    }
    for (bound, name) in [(0.999, "limits"), (1.001, "")] {
        height.reference(name, [(0.0, bound), (longest, bound)]);
    }
    speed.reference("limit at the end", [(1e-3, 5e-4), (longest, 5e-4)]);
    Figure::new(
        "rest",
        "Mean height and rms vertical velocity over time. A column of perturbed particles first rearranges and then \
         comes to rest. Without the stabilisation, a strongly perturbed column diverges within milliseconds.",
        vec![height, speed],
    )
}

/// The last state of a run with and without stabilisation.
pub(super) fn states(records: &[StillWaterRecord]) -> Option<Figure> {
    let (unstabilised, failed) = records.iter().find(|(run, _)| run.is_unstabilised())?;
    let (stabilised, held) =
        records.iter().find(|(run, _)| !run.is_unstabilised() && run.jitter == unstabilised.jitter)?;
    let millimetres = |length: f64| 1e3 * length;
    let panel = |run: &StillWaterFlow, frame: &Frame, ending: &str| {
        let title = format!("{}, {:.2} s{ending}", label(run), frame.time);
        let mut panel = Panel::new(&title, Axis::linear("x [mm]"), Axis::linear("z [mm]"));
        panel.y.limits = Some((0.0, millimetres(2.5 * run.water.depth)));
        let points = frame.position.iter().map(|x| (millimetres(x[0]), millimetres(x[1])));
        let values = pressures(run, frame).into_iter().map(|(_, p)| p);
        panel.field = Some(Field::new("p/(ρ g h) [-]", millimetres(run.water.spacing()), (0.0, 1.0), points, values));
        panel
    };
    let ending = if matches!(failed.outcome, Outcome::Diverged { .. }) { ", diverged" } else { "" };
    Some(Figure::new(
        "states",
        "Particles coloured by pressure at the end of the run and, without stabilisation of the pressure Poisson \
         equation, at the end of a shorter run.",
        vec![panel(stabilised, held.frames.last()?, ""), panel(unstabilised, failed.frames.last()?, ending)],
    ))
}
