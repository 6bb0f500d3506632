//! Side of facets on which a place is: in front of a wall, or behind it.
//!
//! The facet nearest to it decides. At a corner several are equally near; the sign then is that of the sum of
//! their normals, in space each times the angle that its triangle fills there, which is right for corners into the flow
//! and out of it (Bærentzen & Aanæs 2005). Beyond a rim, where facets end, there is no wall.

use super::facet::Facet;
use crate::vector::Vector;

/// Relative distance beyond the nearest up to which a facet counts as equally near `[-]`.
pub(super) const TIE: f64 = 1e-9;
/// Largest deviation from 1 of the cosine between two edges that are one `[-]`.
const ALONG: f64 = 1e-6;
/// Triangles around a point that are compared each with each: fewer are not worth a list, which a step may not allocate.
const FEW: usize = 32;

/// Distance of a place from some facets, signed by the side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FacetSide {
    /// Distance from the nearest facet `[m]`, negative behind it. Beyond a rim where the facets end it is positive.
    pub distance: f64,
    /// The nearest facet, by its place among them: where several are equally near, the one that the place is behind of by
    /// the least, or else the first.
    pub facet: usize,
}

/// Side of facets on which a place is; none without facets. `facets` yields them with the place as each of them sees it.
pub fn facet_side<'a, const D: usize>(
    facets: impl Iterator<Item = (&'a Facet<D>, Vector<D>)> + Clone,
) -> Option<FacetSide> {
    let ways = facets.clone().map(|(facet, place)| (place - facet.nearest(&place)).norm());
    let least = ways.fold(f64::INFINITY, f64::min);
    if least == f64::INFINITY {
        return None;
    }
    let mut tied = Tied::at(least);
    let mut sum = Vector::<D>::zeros();
    for (index, (facet, place)) in facets.clone().enumerate() {
        let nearest = facet.nearest(&place);
        let from = place - nearest;
        if from.norm() > least * (1.0 + TIE) {
            continue;
        }
        tied.add(index, facet, &place, from);
        sum += facet.normal * facet.angle(&nearest);
    }
    Some(tied.side(sum, || is_open(facets, least)))
}

/// Facets that are equally near to a place.
pub(super) struct Tied<const D: usize> {
    /// Their distance `[m]`.
    least: f64,
    count: usize,
    first: usize,
    /// From the nearest point of the first to the place `[m]`.
    way: Vector<D>,
    beyond_a_rim: bool,
    behind_one: bool,
    on_a_face: bool,
    owner: Option<usize>,
    depth: f64,
}

impl<const D: usize> Tied<D> {
    /// No facet yet, at a distance `[m]`.
    pub(super) fn at(least: f64) -> Self {
        let (way, depth) = (Vector::zeros(), f64::INFINITY);
        let (beyond_a_rim, behind_one, on_a_face) = (false, false, false);
        Self { least, count: 0, first: 0, way, beyond_a_rim, behind_one, on_a_face, owner: None, depth }
    }

    /// Adds one by its number, with the way from its nearest point to the place `[m]`.
    #[inline(always)]
    pub(super) fn add(&mut self, index: usize, facet: &Facet<D>, place: &Vector<D>, from: Vector<D>) {
        let height = facet.height(place);
        if self.count == 0 {
            (self.first, self.way) = (index, from);
            self.beyond_a_rim = height.abs() < (1.0 - TIE) * self.least;
        }
        self.count += 1;
        self.on_a_face |= height.abs() >= (1.0 - TIE) * self.least;
        self.behind_one |= from.dot(&facet.normal) < 0.0;
        if height < 0.0 && -height < self.depth {
            (self.owner, self.depth) = (Some(index), -height);
        }
    }

    /// Side given by the sum of their normals, each times its angle; `is_open` is true if they leave a gap around the nearest point.
    pub(super) fn side(self, sum: Vector<D>, is_open: impl FnOnce() -> bool) -> FacetSide {
        let cancel = sum.norm() < TIE;
        let behind = if cancel { self.behind_one } else { self.way.dot(&sum) < 0.0 };
        let beyond = || if D < 3 { self.count == 1 && self.beyond_a_rim } else { !self.on_a_face && is_open() };
        let behind = behind && !beyond();
        let distance = if behind { -self.least } else { self.least };
        FacetSide { distance, facet: self.owner.unwrap_or(self.first) }
    }
}

/// Whether triangles that are equally near by their rims leave a gap around the point that is nearest: an edge there has a
/// triangle on one side only.
fn is_open<'a, const D: usize>(facets: impl Iterator<Item = (&'a Facet<D>, Vector<D>)> + Clone, least: f64) -> bool {
    let tied = facets.filter_map(|(facet, place)| {
        let nearest = facet.nearest(&place);
        ((place - nearest).norm() <= least * (1.0 + TIE)).then(|| facet.rays(&nearest))
    });
    if tied.clone().nth(FEW).is_some() {
        return is_open_among_many(tied.enumerate().flat_map(|(own, rays)| rays.map(|ray| (own, ray))).collect());
    }
    let joined = |own: usize, ray: &Vector<D>| {
        tied.clone().enumerate().any(|(k, rays)| k != own && rays.iter().any(|other| other.dot(ray) > 1.0 - ALONG))
    };
    tied.clone().enumerate().any(|(own, rays)| !rays.iter().all(|ray| joined(own, ray)))
}

/// What [`is_open`] says, of the rays of many triangles with their numbers: joined rays are near each other along an axis.
pub(super) fn is_open_among_many<const D: usize>(mut rays: Vec<(usize, Vector<D>)>) -> bool {
    rays.sort_unstable_by(|one, other| one.1[0].total_cmp(&other.1[0]).then(one.0.cmp(&other.0)));
    let is_joined = |at: usize| {
        let (own, ray) = rays[at];
        let is_near = |other: &&(usize, Vector<D>)| (other.1[0] - ray[0]).abs() <= 2.0 * ALONG.sqrt();
        let joins = |other: &(usize, Vector<D>)| other.0 != own && other.1.dot(&ray) > 1.0 - ALONG;
        rays[at + 1..].iter().take_while(is_near).any(joins) || rays[..at].iter().rev().take_while(is_near).any(joins)
    };
    !(0..rays.len()).all(is_joined)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[[f64; 2]]) -> Vec<Facet<2>> {
        points.windows(2).filter_map(|ends| Facet::segment(ends[0].into(), ends[1].into())).collect()
    }

    fn stands(facets: &[Facet<2>], x: f64, y: f64) -> FacetSide {
        let place = Vector::<2>::new(x, y);
        facet_side(facets.iter().map(|facet| (facet, place))).expect("facets")
    }

    #[test]
    fn a_place_is_behind_a_step_or_in_front_of_it() {
        // the flow is above: a bed, a face that falls, a lower bed
        let step = line(&[[-2.0, 1.0], [0.0, 1.0], [0.0, 0.0], [2.0, 0.0]]);
        for (x, y, distance, facet) in [
            (-0.5, 1.25, 0.25, 0),
            (-0.5, 0.9, -0.1, 0),
            (0.3, 1.4, 0.5, 0),
            (0.3, 0.5, 0.3, 1),
            (-0.3, 0.5, -0.3, 1),
            (0.2, 0.1, 0.1, 2),
            (-0.3, -0.4, -0.5, 1),
            (0.3, -0.4, -0.4, 2),
        ] {
            let found = stands(&step, x, y);
            assert!((found.distance - distance).abs() < 1e-15 && found.facet == facet, "{found:?} at {x}, {y}");
        }
        assert!((stands(&step, -2.3, 0.6).distance - 0.5).abs() < 1e-15, "beyond the rim there is no wall");
    }

    #[test]
    fn acute_corners_are_told_from_either_side() {
        let (tan, wedge) = (0.267_949_192_431_122_7, [[-1.0, 0.267_949_192_431_122_7], [0.0, 0.0]]);
        // the flow between two walls that meet in 30°, open to the left
        let tip = line(&[[0.0, 0.0], wedge[0]]);
        let mut trough = line(&[[-1.0, -tan], [0.0, 0.0]]);
        trough.extend(&tip);
        assert!(stands(&trough, -0.5, 0.0).distance > 0.0);
        assert!((stands(&trough, 0.5, 0.0).distance + 0.5).abs() < 1e-15);
        assert!(stands(&trough, -0.5, 0.2).distance < 0.0 && stands(&trough, -0.5, -0.2).distance < 0.0);
        // the same lines the other way round: a solid wedge in the flow
        let solid: Vec<_> = trough.iter().rev().filter_map(|f| Facet::segment(f.corners[1], f.corners[0])).collect();
        assert!(stands(&solid, -0.5, 0.0).distance < 0.0);
        assert!((stands(&solid, 0.5, 0.0).distance - 0.5).abs() < 1e-15);
    }

    fn triangles(corners: &[[[f64; 3]; 3]]) -> Vec<Facet<3>> {
        corners.iter().filter_map(|corners| Facet::triangle(corners.map(Vector::<3>::from))).collect()
    }

    fn distance(facets: &[Facet<3>], place: [f64; 3]) -> f64 {
        facet_side(facets.iter().map(|facet| (facet, Vector::<3>::from(place)))).expect("facets").distance
    }

    #[test]
    fn there_is_no_wall_beyond_the_rim_of_a_mesh() {
        let (a, b, c, d) = ([0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
        let floor = triangles(&[[a, b, c], [a, c, d]]);
        for (place, expected) in [
            ([0.5, 0.5, -0.2], -0.2),
            ([0.5, 0.5, 0.2], 0.2),
            ([1.3, 0.5, -0.4], 0.5),
            // before the corners: one that two triangles share, and one of a single triangle
            ([1.3, 1.0 + 1e-3, -0.4], 0.5),
            ([1.3, -1e-3, -0.4], 0.5),
        ] {
            let found = distance(&floor, place);
            assert!((found - expected).abs() < 1e-5, "{found} at {place:?}");
        }
    }

    #[test]
    fn at_a_corner_of_a_box_the_division_into_triangles_does_not_matter() {
        // three faces with the flow between them, each in two triangles that are divided in one way or the other; their
        // edges along the axes are of different lengths
        let face = |x: [f64; 3], y: [f64; 3], turned: bool| {
            let add = |a: [f64; 3], b: [f64; 3]| [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
            let (o, xy) = ([0.0; 3], add(x, y));
            if turned { [[o, x, y], [x, xy, y]] } else { [[o, x, xy], [o, xy, y]] }
        };
        for turned in 0..8 {
            let is = |bit: usize| turned & (1 << bit) != 0;
            let faces = [
                face([1.0, 0.0, 0.0], [0.0, 2.0, 0.0], is(0)),
                face([0.0, 1.5, 0.0], [0.0, 0.0, 1.0], is(1)),
                face([0.0, 0.0, 0.7], [3.0, 0.0, 0.0], is(2)),
            ];
            let flow_inside = triangles(&faces.concat());
            let behind = distance(&flow_inside, [-0.1, -0.2, -0.2]);
            assert!((behind + 0.3).abs() < 1e-15, "{behind}, {turned}");
            assert!((distance(&flow_inside, [0.3, 0.1, 0.2]) - 0.1).abs() < 1e-15);
            let outside: Vec<_> = flow_inside
                .iter()
                .filter_map(|f| Facet::triangle([f.corners[1], f.corners[0], f.corners[2]]))
                .collect();
            assert!((distance(&outside, [-0.1, -0.2, -0.2]) - 0.3).abs() < 1e-15);
            assert!((distance(&outside, [0.3, 0.1, 0.2]) + 0.1).abs() < 1e-15);
        }
    }

    #[test]
    fn hundreds_of_slivers_around_a_corner_are_not_compared_each_with_each() {
        // a pit with the flow in it, steeper than 45 degrees, and places below its corner
        let count = 600_u32;
        let rim = |k: u32| {
            let angle = f64::from(k % count) * std::f64::consts::TAU / f64::from(count);
            [libm::cos(angle), libm::sin(angle), 2.0]
        };
        // in any order
        let pit: Vec<_> = (0..count).map(|k| k * 1237 % count).map(|k| [[0.0; 3], rim(k), rim(k + 1)]).collect();
        let seen = |corners: &[[[f64; 3]; 3]]| {
            let (facets, looks) = (triangles(corners), std::cell::Cell::new(0));
            let place = Vector::<3>::new(0.01, 0.02, -0.3);
            let look = |facet| {
                looks.set(looks.get() + 1);
                (facet, place)
            };
            let found = facet_side(facets.iter().map(look)).expect("facets").distance;
            assert!(looks.get() < 10 * facets.len(), "{} looks at {} facets", looks.get(), facets.len());
            found / place.norm()
        };
        assert!((seen(&pit) + 1.0).abs() < 1e-12, "behind a closed pit");
        let open: Vec<_> = pit.iter().copied().filter(|corners| corners[1][0] < 0.99).collect();
        assert!((seen(&open) - 1.0).abs() < 1e-12, "there is no wall beyond a rim");
    }
}
