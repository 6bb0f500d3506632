//! The case's figures.

use super::WaterFilmRecord;
use super::flow::WaterFilmFlow;
use super::metrics::{FilmDepth, convergence_errors};
use crate::figure::{Axis, Figure, Panel};

pub(super) fn all(records: &[WaterFilmRecord]) -> Vec<Figure> {
    let mut figures = vec![profiles(records)];
    let errors = convergence_errors(records, FilmDepth::Nominal);
    if errors.len() >= 2 {
        let mut panel =
            Panel::new("", Axis::logarithmic("rows over the depth [-]"), Axis::logarithmic("relative L2 of u [%]"));
        let own = convergence_errors(records, FilmDepth::Own);
        panel.line_points("against the film of the nominal depth", 0, errors);
        panel.line_points("against the film of the depth that particles occupy", 1, own.iter().copied());
        panel.order(1, "first order", &own);
        figures.push(Figure::new("convergence", CONVERGENCE, vec![panel]));
    }
    figures
}

const CONVERGENCE: &str = "Relative L2 error of the velocity over the number of particles across the depth \
                           (lattice), against exact films of the nominal depth and of the depth that the particles \
                           occupy.";

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
        "Velocity over the depth, averaged over the last relaxation times, with the exact film, and their difference \
         in % of the surface velocity. Error bars: statistical errors from block averages.",
        vec![velocity, error],
    )
}
