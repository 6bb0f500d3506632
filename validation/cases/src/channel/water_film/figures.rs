//! The case's figures.

use super::WaterFilmRecord;
use super::flow::WaterFilmFlow;
use super::metrics::{FilmDepth, convergence_errors, depth_of};
use crate::figure::{Axis, Figure, Panel};

pub(super) fn all(records: &[WaterFilmRecord]) -> Vec<Figure> {
    let mut figures = vec![profiles(records), over_time(records)];
    let errors = convergence_errors(records, FilmDepth::Nominal);
    if errors.len() >= 2 {
        let mut panel =
            Panel::new("", Axis::logarithmic("rows over the depth [-]"), Axis::logarithmic("relative L2 of u [%]"));
        let own = convergence_errors(records, FilmDepth::Own);
        panel.line_points("against the film of the nominal depth", 0, errors);
        panel.line_points("against the film of the particles' own depth", 1, own.iter().copied());
        panel.order(1, "first order", &own);
        figures.push(Figure::new("convergence", CONVERGENCE, vec![panel]));
    }
    figures
}

const CONVERGENCE: &str = "Relative L2 error of the velocity profile on the lattice with the number of rows. Against the film \
     of the nominal depth the error is that of the depth: a sheared arrangement of particles has another Σ V W at the same \
     density than the relaxed one that the reference concentration belongs to, and the velocity goes with the square of \
     the depth. Against the film of the particles' own depth what remains is the wall and the rows at the surface.";

fn label(run: &WaterFilmFlow) -> String {
    format!("{} rows, {}", run.water.resolution, run.arrangement.name())
}

fn profiles(records: &[WaterFilmRecord]) -> Figure {
    let mut velocity = Panel::new("", Axis::linear("z/h [-]"), Axis::linear("u/u(h) [-]"));
    let mut error = Panel::new("", Axis::linear("z/h [-]"), Axis::linear("(u − u exact)/u(h) [%]"));
    for (slot, (run, record)) in records.iter().enumerate() {
        let film = run.exact(run.water.depth);
        let (depth, scale) = (run.water.depth, run.surface_velocity);
        if slot == 0 {
            let exact = (0..=100).map(|k| f64::from(k) / 100.0).map(|z| (z, film.velocity(z * depth) / scale));
            velocity.reference("exact", exact);
            error.reference("", [(0.0, 0.0), (1.0, 0.0)]);
        }
        let profile = &record.data.profile;
        let (points, errors) = (profile.points(), profile.velocities());
        let values = points.iter().map(|point| (point.height / depth, point.velocity / scale));
        velocity.points(&label(run), slot, values);
        let deviation = |z: f64, velocity: f64| (z / depth, 100.0 * (velocity - film.velocity(z)) / scale);
        let deviations = points.iter().map(|point| deviation(point.height, point.velocity));
        error.line_points("", slot, deviations).error =
            errors.iter().map(|velocity| 100.0 * velocity.standard_error / scale).collect();
    }
    Figure::new(
        "velocity-profile",
        "Velocity over the depth, averaged over the last relaxation times, against the exact film, and the \
         difference in per cent of the surface velocity with its statistical error from blocks.",
        vec![velocity, error],
    )
}

fn over_time(records: &[WaterFilmRecord]) -> Figure {
    let mut mean = Panel::new("", Axis::linear("t ν π²/(4h²) [-]"), Axis::linear("U/(⅔ u(h)) [-]"));
    let mut height = Panel::new("", Axis::linear("t ν π²/(4h²) [-]"), Axis::linear("mean height/(h/2) [-]"));
    let mut longest: f64 = 0.0;
    for (slot, (run, record)) in records.iter().enumerate() {
        let series = &record.data.series;
        let at = |time: f64| time / run.relaxation_time();
        let line = |values: &[f64], scale: f64| {
            series.curve(values, scale).into_iter().map(|(time, value)| (at(time), value)).collect::<Vec<_>>()
        };
        longest = longest.max(at(record.simulated_time));
        let exact = run.exact(run.water.depth).flux() / run.water.depth;
        mean.line(&label(run), slot, line(&series.mean_velocity, exact));
        height.line("", slot, line(&series.relative_height, 1.0));
        let own = depth_of(run, &record.data, FilmDepth::Own) / run.water.depth;
        let (from, to) = record.data.window;
        let window = vec![(at(from), own), (at(to), own)];
        height.reference("mean over the window", window);
    }
    mean.reference("exact", [(0.0, 1.0), (longest, 1.0)]);
    Figure::new(
        "steadiness",
        "Depth mean of the velocity and mean height over time, from the exact profile at the nominal depth.",
        vec![mean, height],
    )
}
