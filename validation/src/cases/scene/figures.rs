//! Pictures of the material between its walls.

use super::PlaneParameters;
use crate::cases::enclosed::setting::SceneWall;
use crate::figure::{Axis, Field, Figure, Mark, Panel, Series};
use crate::observation::Frame;
use bagnold_solver::vector::Vector;

/// One panel a picture, the particles in the colours of their speed and the walls where they stand.
pub(super) fn pictures(parameters: &PlaneParameters, frames: &[Frame]) -> Figure {
    let fastest = frames.iter().flat_map(Frame::speeds).fold(0.0, f64::max);
    let (lower, upper) = parameters.extent();
    let margin = 2.0 * parameters.spacing;
    let axis = |label: &str, k: usize| Axis::linear(label).between(lower[k] - margin, upper[k] + margin);
    let panels = frames.iter().map(|frame| {
        let mut panel = Panel::new(&format!("t = {:.3} s", frame.time), axis("x [m]", 0), axis("y [m]", 1));
        let points: Vec<(f64, f64)> = frame.position.iter().map(|place| (place[0], place[1])).collect();
        panel.field = Some(Field::new("|v| [m/s]", parameters.spacing, (0.0, fastest), points, frame.speeds()));
        for wall in &parameters.walls {
            let shell = wall.shell();
            let moved = shell.motion.displacement(frame.time);
            let place = |point: &Vector<2>| (point[0] + moved[0], point[1] + moved[1]);
            let ends = shell.facets.first().map(|facet| place(&facet.corners[0]));
            let points = ends.into_iter().chain(shell.facets.iter().map(|facet| place(&facet.corners[1]))).collect();
            panel.series.push(Series::new("", Mark::Reference, 0, points));
        }
        panel
    });
    Figure::new("pictures", "The material in the colours of its speed, and its walls, dashed.", panels.collect())
}
