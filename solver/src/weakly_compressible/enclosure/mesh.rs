//! Meshes of triangles as walls: a facet wall of them, and the flat parts that they make up.

use super::facet::Facet;
use super::facet_wall::{FacetWall, Motion};
use crate::vector::Vector;
use crate::weakly_compressible::Surface;

/// Sine of the angle between two normals up to which triangles that share an edge are one flat part `[-]`: what corners
/// of single precision leave of a plane.
const FLAT: f64 = 1e-4;

impl FacetWall<3> {
    /// The wall of some triangles `[m]`, whose corners are seen from the flow against the clock; at rest and rough.
    /// Triangles thinner than a millionth of their length are left out.
    #[must_use]
    pub fn mesh(name: &str, triangles: &[[Vector<3>; 3]]) -> Self {
        let facets = triangles.iter().filter_map(|corners| Facet::triangle(*corners)).collect();
        let (roughness, motion) = (Surface::Rough, Motion::default());
        Self { name: name.to_owned(), facets, roughness, motion }
    }
}

/// The corner `[m]` that most triangles share, and their number; none without triangles.
#[must_use]
pub fn largest_fan(triangles: &[[Vector<3>; 3]]) -> Option<(Vector<3>, usize)> {
    let bits = |corner: &Vector<3>| [corner[0], corner[1], corner[2]].map(|coordinate| (coordinate + 0.0).to_bits());
    let mut corners: Vec<[u64; 3]> = triangles.iter().flatten().map(bits).collect();
    corners.sort_unstable();
    let fan = corners.chunk_by(|one, other| one == other).max_by_key(|same| same.len())?;
    Some((Vector::from(fan[0].map(f64::from_bits)), fan.len()))
}

/// An edge by its ends, either way round, in single precision: computed corners that are one may differ in a last digit.
type Edge = [[u32; 3]; 2];

fn edges(facet: &Facet<3>) -> [Edge; 3] {
    // 0 and -0 are one place
    let bits =
        |corner: &Vector<3>| [corner[0], corner[1], corner[2]].map(|coordinate| (coordinate as f32 + 0.0).to_bits());
    let [a, b, c] = facet.corners.each_ref().map(bits);
    [[a, b], [b, c], [c, a]].map(|[start, end]| if start < end { [start, end] } else { [end, start] })
}

/// The facets of every edge, sorted by it and in their order.
fn by_edge(facets: &[Facet<3>]) -> Vec<(Edge, u32)> {
    let of = |(index, facet): (usize, &Facet<3>)| edges(facet).map(|edge| (edge, index as u32));
    let mut owners: Vec<_> = facets.iter().enumerate().flat_map(of).collect();
    owners.sort_unstable();
    owners
}

/// The facets of an edge.
fn owners_of<'a>(owners: &'a [(Edge, u32)], edge: &Edge) -> impl Iterator<Item = usize> + use<'a> {
    let edge = *edge;
    let first = owners.partition_point(|(other, _)| *other < edge);
    owners[first..].iter().take_while(move |(other, _)| *other == edge).map(|(_, facet)| *facet as usize)
}

/// The flat parts of some facets, each by its facets: those that share edges and lie in one plane.
pub(super) fn flat_parts(facets: &[Facet<3>]) -> Vec<Vec<usize>> {
    let owners = by_edge(facets);
    let mut taken = vec![false; facets.len()];
    let mut parts = Vec::new();
    for seed in 0..facets.len() {
        if std::mem::replace(&mut taken[seed], true) {
            continue;
        }
        let normal = facets[seed].normal;
        let mut part = vec![seed];
        let mut next = 0;
        while let Some(&own) = part.get(next) {
            next += 1;
            for edge in edges(&facets[own]) {
                for other in owners_of(&owners, &edge) {
                    let facet = &facets[other];
                    let flat = facet.normal.cross(&normal).norm() < FLAT && facet.normal.dot(&normal) > 0.0;
                    if flat && !std::mem::replace(&mut taken[other], true) {
                        part.push(other);
                    }
                }
            }
        }
        part.sort_unstable();
        parts.push(part);
    }
    parts
}

/// A flat part in coordinates of its own: a corner, two directions in its plane, and the normal into the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    /// The lowest corner of its rectangle along both directions `[m]`.
    pub(super) origin: Vector<3>,
    /// Directions along its longest edge and across it `[-]`.
    pub(super) along: [Vector<3>; 2],
    /// Lengths along these directions `[m]`.
    pub(super) lengths: [f64; 2],
    /// Normal into the flow `[-]`.
    pub(super) normal: Vector<3>,
    /// Area of its triangles `[m²]`.
    pub(super) area: f64,
}

impl Frame {
    /// That of a part with at least one facet: its longest edge is the longest on its rim.
    pub(super) fn of(part: &[Facet<3>]) -> Option<Self> {
        let Facet { normal, corners } = *part.first()?;
        let owners = by_edge(part);
        let rim = part.iter().flat_map(|facet| {
            let [a, b, c] = facet.corners;
            edges(facet).into_iter().zip([b - a, c - b, a - c])
        });
        let rim = rim.filter(|(edge, _)| owners_of(&owners, edge).count() == 1);
        let mut longest = corners[1] - corners[0];
        let mut length = 0.0;
        for (_, edge) in rim {
            // equally long ones in the order of the facets, whatever rounding says of them
            if edge.norm() > length * (1.0 + FLAT) {
                (longest, length) = (edge, edge.norm());
            }
        }
        let first = longest - normal * longest.dot(&normal);
        let first = first.normalize() * if first[first.iamax()] < 0.0 { -1.0 } else { 1.0 };
        let along = [first, normal.cross(&first)];
        let places = || part.iter().flat_map(|facet| facet.corners).map(|corner| corner - corners[0]);
        let ends = along.map(|axis| {
            places().map(|place| place.dot(&axis)).fold((0.0_f64, 0.0_f64), |(l, u), x| (l.min(x), u.max(x)))
        });
        let origin = corners[0] + along[0] * ends[0].0 + along[1] * ends[1].0;
        let area = part.iter().map(|facet| {
            let [a, b, c] = facet.corners;
            0.5 * (b - a).cross(&(c - a)).norm()
        });
        Some(Self { origin, along, lengths: ends.map(|(l, u)| u - l), normal, area: area.sum() })
    }

    /// Mean breadth across the longest edge `[m]`.
    pub(super) fn breadth(&self) -> f64 {
        self.area / self.lengths[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_that_lie_in_one_plane_are_one_part_and_a_fold_parts_them() {
        let corner = |x: f64, y: f64, z: f64| Vector::<3>::new(x, y, z);
        let strip = |x: f64, width: f64, rise: f64| {
            let (a, b) = (corner(x, 0.0, 0.0), corner(x + width, 0.0, rise));
            let (c, d) = (corner(x + width, 3.0, rise), corner(x, 3.0, 0.0));
            [[a, b, c], [a, c, d]]
        };
        let triangles = [strip(0.0, 1.0, 0.0), strip(1.0, 0.5, 0.0), strip(1.5, 1.0, 1.0)].concat();
        let thin = [corner(0.0, 0.0, 0.0), corner(1.0, 0.0, 0.0), corner(2.0, 0.0, 0.0)];
        let wall = FacetWall::mesh("bed", &[&triangles[..], &[thin]].concat());
        assert_eq!(wall.facets.len(), 6, "what has no side is left out");
        let parts = flat_parts(&wall.facets);
        assert_eq!(parts, [vec![0, 1, 2, 3], vec![4, 5]]);
        let facets: Vec<_> = parts[0].iter().map(|&k| wall.facets[k]).collect();
        let frame = Frame::of(&facets).expect("facets");
        assert!(frame.along[0] == corner(0.0, 1.0, 0.0) && frame.normal == corner(0.0, 0.0, 1.0));
        assert!((frame.area - 4.5).abs() < 1e-14 && (frame.breadth() - 1.5).abs() < 1e-14);
        assert!((frame.lengths[1] - 1.5).abs() < 1e-14);
        // across the edge, the normal and the edge make a right-handed system
        assert!(frame.along[1] == corner(-1.0, 0.0, 0.0) && (frame.origin - corner(1.5, 0.0, 0.0)).norm() < 1e-14);
    }

    #[test]
    fn a_frame_begins_at_the_lower_corner_whichever_corner_comes_first() {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.8, 1.9);
        let [a, b, c, d] =
            [[1.0, 2.0], [4.0, 2.0], [4.0, 3.0], [1.0, 3.0]].map(|[x, y]| turn * Vector::<3>::new(x, y, 5.0));
        for corners in [[[a, b, c], [a, c, d]], [[c, d, a], [b, c, a]], [[d, a, c], [c, a, b]], [[b, c, d], [d, a, b]]]
        {
            let facets = corners.map(|corners| Facet::triangle(corners).expect("a triangle"));
            let frame = Frame::of(&facets).expect("facets");
            for (axis, length) in frame.along.iter().zip(frame.lengths) {
                let places = corners.iter().flatten().map(|corner| axis.dot(&(corner - frame.origin)));
                let (lower, upper) = places.fold((f64::INFINITY, 0.0_f64), |(l, u), x| (l.min(x), u.max(x)));
                assert!(lower.abs() < 1e-13 && (upper - length).abs() < 1e-13, "{lower} to {upper} of {length}");
            }
            assert!(frame.normal.dot(&(frame.origin - a)).abs() < 1e-13);
        }
    }
}
