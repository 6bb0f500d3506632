//! A facet: a segment of a wall in the plane, a triangle in space, with the flow on one side of it.
//!
//! Where a place stands is told by the facet nearest to it. At a corner several are equally near; the sign then is that
//! of the sum of their normals, which is right for corners into the flow and out of it (Bærentzen & Aanæs 2005).

use crate::vector::Vector;

/// How much farther than the nearest a facet may be to count as equally near `[-]`.
const TIE: f64 = 1e-9;

/// A segment between two corners, or a triangle of three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet<const D: usize> {
    /// Its corners `[m]`.
    pub corners: [Vector<D>; D],
    /// Unit normal into the flow `[-]`.
    pub normal: Vector<D>,
}

impl Facet<2> {
    /// The segment from one corner to another `[m]` with the flow to its left; none where both are one point.
    #[must_use]
    pub fn segment(from: Vector<2>, to: Vector<2>) -> Option<Self> {
        let along = to - from;
        let length = along.norm();
        let normal = Vector::<2>::new(-along[1], along[0]) / length;
        (length > 0.0 && length.is_finite()).then_some(Self { corners: [from, to], normal })
    }
}

impl<const D: usize> Facet<D> {
    /// Distance of a place from the facet's plane `[m]`, positive on the flow's side.
    #[inline(always)]
    #[must_use]
    pub fn height(&self, place: &Vector<D>) -> f64 {
        self.normal.dot(&(place - self.corners[0]))
    }

    /// Whether a place may be nearer than `range` `[m]`, by the facet's box.
    #[inline(always)]
    #[must_use]
    pub fn may_reach(&self, place: &Vector<D>, range: f64) -> bool {
        let mut near = true;
        for axis in 0..D {
            let (mut lower, mut upper) = (f64::INFINITY, f64::NEG_INFINITY);
            for corner in &self.corners {
                lower = lower.min(corner[axis]);
                upper = upper.max(corner[axis]);
            }
            near &= place[axis] > lower - range && place[axis] < upper + range;
        }
        near
    }

    /// The point of the facet that is nearest to a place `[m]`.
    #[must_use]
    pub fn nearest(&self, place: &Vector<D>) -> Vector<D> {
        nearest(&self.corners, place)
    }
}

/// The nearest point of a corner, an edge or a triangle; a corner's own coordinates where that is nearest.
fn nearest<const D: usize>(corners: &[Vector<D>], place: &Vector<D>) -> Vector<D> {
    match corners {
        [start, end] => {
            let along = end - start;
            let part = (place - start).dot(&along) / along.norm_squared();
            if part >= 1.0 {
                *end
            } else if part > 0.0 {
                start + along * part
            } else {
                *start
            }
        }
        [a, b, c] => {
            let (ab, ac, ap) = (b - a, c - a, place - a);
            let (bb, bc, cc) = (ab.dot(&ab), ab.dot(&ac), ac.dot(&ac));
            let (pb, pc) = (ap.dot(&ab), ap.dot(&ac));
            let area = bb * cc - bc * bc;
            let (u, v) = ((cc * pb - bc * pc) / area, (bb * pc - bc * pb) / area);
            if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
                return a + ab * u + ac * v;
            }
            let edges = [[*a, *b], [*b, *c], [*c, *a]].map(|edge| nearest(&edge, place));
            edges.into_iter().fold(*a, |best, point| {
                if (place - point).norm_squared() < (place - best).norm_squared() { point } else { best }
            })
        }
        _ => corners.first().copied().unwrap_or(*place),
    }
}

/// Where a place stands with regard to some facets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// Distance from the nearest facet `[m]`, negative behind it. Beyond a rim where the facets end it is positive.
    pub distance: f64,
    /// The nearest facet, by its place among them: where several are equally near, the one that the place is behind of by
    /// the least, or else the first.
    pub facet: usize,
}

/// Where a place stands; none without facets. `facets` yields them with the place as each of them sees it.
pub fn standing<'a, const D: usize>(
    facets: impl Iterator<Item = (&'a Facet<D>, Vector<D>)> + Clone,
) -> Option<Standing> {
    let ways = facets.clone().map(|(facet, place)| (place - facet.nearest(&place)).norm());
    let least = ways.fold(f64::INFINITY, f64::min);
    if least == f64::INFINITY {
        return None;
    }
    let mut tied = 0;
    let (mut sum, mut way) = (Vector::<D>::zeros(), Vector::<D>::zeros());
    let (mut beyond_a_rim, mut behind_one) = (false, false);
    let (mut first, mut owner, mut depth) = (0, None, f64::INFINITY);
    for (index, (facet, place)) in facets.enumerate() {
        let from = place - facet.nearest(&place);
        if from.norm() > least * (1.0 + TIE) {
            continue;
        }
        let height = facet.height(&place);
        if tied == 0 {
            (first, way) = (index, from);
            beyond_a_rim = height.abs() < (1.0 - TIE) * least;
        }
        tied += 1;
        sum += facet.normal;
        behind_one |= from.dot(&facet.normal) < 0.0;
        if height < 0.0 && -height < depth {
            (owner, depth) = (Some(index), -height);
        }
    }
    let cancel = sum.norm() < TIE;
    let behind = if cancel { behind_one } else { way.dot(&sum) < 0.0 };
    let behind = behind && !(tied == 1 && beyond_a_rim);
    Some(Standing { distance: if behind { -least } else { least }, facet: owner.unwrap_or(first) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(points: &[[f64; 2]]) -> Vec<Facet<2>> {
        points.windows(2).filter_map(|ends| Facet::segment(ends[0].into(), ends[1].into())).collect()
    }

    fn stands(facets: &[Facet<2>], x: f64, y: f64) -> Standing {
        let place = Vector::<2>::new(x, y);
        standing(facets.iter().map(|facet| (facet, place))).expect("facets")
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

    #[test]
    fn the_nearest_point_of_a_triangle_lies_on_its_face_an_edge_or_a_corner() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector::<3>::from);
        let facet = Facet { corners, normal: Vector::<3>::new(0.0, 0.0, 1.0) };
        for (place, expected) in [
            ([0.2, 0.3, 0.7], [0.2, 0.3, 0.0]),
            ([0.3, -0.5, 0.1], [0.3, 0.0, 0.0]),
            ([1.0, 1.0, -0.4], [0.5, 0.5, 0.0]),
            ([-0.2, -0.1, 3.0], [0.0, 0.0, 0.0]),
        ] {
            let error = facet.nearest(&place.into()) - Vector::<3>::from(expected);
            assert!(error.norm() < 1e-15, "{place:?}");
        }
    }
}
