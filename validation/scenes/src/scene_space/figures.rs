//! Pictures of the material from the side and from above, between the edges of its walls.

use super::{SpaceFlow, SpaceWall};
use crate::enclosed::figures::{add_inlets, picture_axes, start_panel};
use crate::enclosed::setting::SceneWall;
use crate::figure::{Field, Figure, Mark, Panel, Series};
use crate::observation::Frame;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet::Facet;
use std::collections::BTreeMap;

/// Most edges that are drawn of the walls: a fine mesh would cover what it holds.
const MOST_EDGES: usize = 400;
/// Cosine of the angle between two triangles from which on their common edge is drawn `[-]`: 20°.
const SHARP: f64 = 0.94;

/// From where the scene is seen: the axes to the right and up in the picture, and the one towards the eye with its sign.
struct ViewDirection {
    name: &'static str,
    right: usize,
    up: usize,
    towards: (usize, f64),
}

/// The view across the longer horizontal axis, along which a slope runs, and that from above.
fn views(parameters: &SpaceFlow) -> [ViewDirection; 2] {
    let (lower, upper) = parameters.extent();
    let (right, towards) =
        if upper[1] - lower[1] > 1.1 * (upper[0] - lower[0]) { (1, (0, 1.0)) } else { (0, (1, -1.0)) };
    [
        ViewDirection { name: "from the side", right, up: 2, towards },
        ViewDirection { name: "from above", right: 0, up: 1, towards: (2, 1.0) },
    ]
}

/// Two panels per picture, the particles in the colours of their speed and the edges of the walls where they stand.
pub(super) fn pictures(parameters: &SpaceFlow, frames: &[Frame]) -> Figure {
    let fastest = frames.iter().flat_map(Frame::speeds).fold(0.0, f64::max);
    let axes = picture_axes(parameters, frames.iter().flat_map(|frame| &frame.position));
    let with_edges = |wall: &SpaceWall| {
        let facet_wall = wall.facet_wall();
        let edges = sharp_edges(&facet_wall.facets);
        (facet_wall, edges)
    };
    let walls: Vec<_> = parameters.walls.iter().map(with_edges).collect();
    let views = views(parameters);
    let panels = frames.iter().flat_map(|frame| views.iter().map(move |view| (frame, view)));
    let panels = panels.map(|(frame, view)| {
        let title = format!("t = {:.3} s, {}", frame.time, view.name);
        let mut panel = Panel::new(&title, axes[view.right].clone(), axes[view.up].clone());
        panel.field = Some(material(parameters.spacing, frame, view, fastest));
        let moved = walls.iter().flat_map(|(facet_wall, edges)| {
            let pose = facet_wall.motion.pose(frame.time);
            edges.iter().map(move |edge| edge.map(|end| pose.place(&end)))
        });
        for edge in moved.take(MOST_EDGES) {
            let mut points = edge.map(|end| (end[view.right], end[view.up]));
            // dashes of an edge in front of another lie on those behind
            points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
            panel.reference("", points);
        }
        panel
    });
    let caption = "Material coloured by speed, seen from the side and from above; nearer particles cover farther \
                   ones. Dashed: edges of the walls.";
    Figure::new("pictures", caption, panels.collect()).in_columns(2)
}

/// The particles as one view shows them, those nearest to the eye last.
fn material(spacing: f64, frame: &Frame, view: &ViewDirection, fastest: f64) -> Field {
    let mut order: Vec<usize> = (0..frame.position.len()).collect();
    let nearness = |particle: usize| view.towards.1 * frame.position[particle][view.towards.0];
    order.sort_by(|&one, &other| nearness(one).total_cmp(&nearness(other)));
    let points: Vec<(f64, f64)> =
        order.iter().map(|&k| (frame.position[k][view.right], frame.position[k][view.up])).collect();
    let speeds = frame.speeds();
    let values: Vec<f64> = order.iter().filter_map(|&k| speeds.get(k).copied()).collect();
    Field::new("|v| [m/s]", spacing, (0.0, fastest), points, values)
}

/// The sites in the colours of their values between the edges of walls and openings, from the side and from above.
pub(super) fn setup(parameters: &SpaceFlow, sites: &[(Vector<3>, f64)]) -> Vec<Panel> {
    let view = |view: &ViewDirection| {
        let mut order: Vec<&(Vector<3>, f64)> = sites.iter().collect();
        // what is behind walls is seen through the rest
        order.sort_by(|a, b| {
            let nearness = |site: &(Vector<3>, f64)| view.towards.1 * site.0[view.towards.0];
            a.1.total_cmp(&b.1).then(nearness(a).total_cmp(&nearness(b)))
        });
        let mut panel = start_panel(parameters, view.name, [view.right, view.up], order);
        for (slot, wall) in parameters.walls.iter().enumerate() {
            for (k, edge) in sharp_edges(&wall.facet_wall().facets).iter().take(MOST_EDGES).enumerate() {
                let points = edge.iter().map(|end| (end[view.right], end[view.up])).collect();
                let label = if k == 0 { wall.name() } else { "" };
                panel.series.push(Series::new(label, Mark::Line, slot, points));
            }
        }
        add_inlets(&mut panel, parameters, [view.right, view.up]);
        panel
    };
    views(parameters).iter().map(view).collect()
}

/// Edges at which triangles end or fold.
fn sharp_edges(facets: &[Facet<3>]) -> Vec<[Vector<3>; 2]> {
    let bits = |corner: &Vector<3>| [0, 1, 2].map(|axis| (corner[axis] as f32 + 0.0).to_bits());
    // the ends of edges, with the normals of their triangles
    let mut edges: BTreeMap<[[u32; 3]; 2], Vec<_>> = BTreeMap::new();
    for Facet { corners: [a, b, c], normal } in facets.iter().copied() {
        for ends in [[a, b], [b, c], [c, a]] {
            let mut key = ends.each_ref().map(bits);
            key.sort_unstable();
            edges.entry(key).or_default().push((ends, normal));
        }
    }
    let sharp = |edges: &Vec<([Vector<3>; 2], Vector<3>)>| match edges.as_slice() {
        [(_, one), (_, other)] => one.dot(other) < SHARP,
        _ => true,
    };
    edges.into_values().filter(sharp).filter_map(|edges| edges.first().map(|(ends, _)| *ends)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::quick;
    use crate::scene_space::SpaceBody;

    #[test]
    fn the_diagonals_of_faces_are_not_drawn() {
        let corner = |x: f64, y: f64, z: f64| Vector::<3>::new(x, y, z);
        let (a, b, c, d) = (corner(0.0, 0.0, 0.0), corner(1.0, 0.0, 0.0), corner(1.0, 1.0, 0.0), corner(0.0, 1.0, 0.0));
        let (e, f) = (corner(0.0, 0.0, 1.0), corner(1.0, 0.0, 1.0));
        let folded: Vec<_> =
            [[a, b, c], [a, c, d], [b, a, e], [b, e, f]].into_iter().filter_map(Facet::triangle).collect();
        assert_eq!(sharp_edges(&folded[..2]).len(), 4);
        assert_eq!(sharp_edges(&folded).len(), 7, "and the fold once");
    }

    #[test]
    fn a_slope_is_seen_from_its_side() {
        let mut scene: SpaceFlow = quick();
        let across = |scene: &SpaceFlow| (views(scene)[0].right, views(scene)[0].towards);
        assert_eq!(across(&scene), (0, (1, -1.0)));
        scene.walls.clear();
        scene.bodies =
            vec![SpaceBody::Box { lower: (0.0, 0.0, 0.0), upper: (0.1, 0.4, 0.1), velocity: (0.0, 0.0, 0.0) }];
        // y to the right and z upwards are seen from the side of large x
        assert_eq!(across(&scene), (1, (0, 1.0)));
    }
}
