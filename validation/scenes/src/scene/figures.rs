//! Pictures of the material between its walls.

use super::PlaneFlow;
use crate::enclosed::Measurand;
use crate::enclosed::figures::{add_inlets, picture_axes, start_panel};
use crate::enclosed::setting::{SceneGauge, SceneWall};
use crate::figure::{Field, Figure, Mark, Panel, Series};
use crate::observation::Frame;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet::Facet;

/// One panel per picture, the particles in the colours of their speed and the walls where they stand.
pub(super) fn pictures(parameters: &PlaneFlow, frames: &[Frame]) -> Figure {
    let fastest = frames.iter().flat_map(Frame::speeds).fold(0.0, f64::max);
    let [x, y] = picture_axes(parameters, frames.iter().flat_map(|frame| &frame.position));
    let panels = frames.iter().map(|frame| {
        let mut panel = Panel::new(&format!("t = {:.3} s", frame.time), x.clone(), y.clone());
        let points: Vec<(f64, f64)> = frame.position.iter().map(|place| (place[0], place[1])).collect();
        panel.field = Some(Field::new("|v| [m/s]", parameters.spacing, (0.0, fastest), points, frame.speeds()));
        for wall in &parameters.walls {
            let facet_wall = wall.facet_wall();
            let pose = facet_wall.motion.pose(frame.time);
            panel.series.push(Series::new("", Mark::Reference, 0, outline(&facet_wall.facets, |end| pose.place(end))));
        }
        panel
    });
    Figure::new("pictures", "Material coloured by speed. Dashed: walls.", panels.collect())
}

/// The corners of segments in a row, at their places.
fn outline(facets: &[Facet<2>], place: impl Fn(&Vector<2>) -> Vector<2>) -> Vec<(f64, f64)> {
    let ends = facets.iter().take(1).map(|facet| facet.corners[0]).chain(facets.iter().map(|facet| facet.corners[1]));
    ends.map(|end| place(&end)).map(|end| (end[0], end[1])).collect()
}

/// The sites in the colours of their values between walls, inlets and the lines of gauges, each by its name.
pub(super) fn setup(parameters: &PlaneFlow, sites: &[(Vector<2>, f64)]) -> Vec<Panel> {
    let mut panel = start_panel(parameters, &parameters.name, [0, 1], sites);
    let point = |place: &Vector<2>| (place[0], place[1]);
    for (slot, wall) in parameters.walls.iter().enumerate() {
        let facets = wall.facet_wall().facets;
        panel.series.push(Series::new(wall.name(), Mark::Line, slot, outline(&facets, |end| *end)));
        // a short stroke from its longest segment to where the flow is
        let longest = facets.iter().max_by(|a, b| {
            let length = |facet: &Facet<2>| (facet.corners[1] - facet.corners[0]).norm();
            length(a).total_cmp(&length(b))
        });
        if let Some(facet) = longest {
            let middle = (facet.corners[0] + facet.corners[1]) * 0.5;
            let stroke = vec![point(&middle), point(&(middle + facet.normal * (3.0 * parameters.spacing)))];
            panel.series.push(Series::new("", Mark::Line, slot, stroke));
        }
    }
    add_inlets(&mut panel, parameters, [0, 1]);
    for gauge in &parameters.gauges {
        let points = match gauge.measure(&parameters.direction_of(gauge)) {
            Measurand::Front(line) => vec![point(&line.from), point(&line.to)],
            Measurand::Flux(opening) => {
                let end = opening.edges.iter().fold(opening.corner, |end, (edge, _)| end + edge);
                vec![point(&opening.corner), point(&end)]
            }
            Measurand::Depth(depth) => {
                let way = depth.direction * (2.0 * parameters.spacing);
                vec![point(&(depth.at - way)), point(&(depth.at + way))]
            }
            Measurand::Probe(probe) => vec![point(&probe.at)],
            Measurand::Force(_) | Measurand::Position(_) | Measurand::Turn(_) => continue,
        };
        panel.series.push(Series::new(gauge.name(), Mark::Reference, 0, points));
    }
    vec![panel]
}
