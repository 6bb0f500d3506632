//! A facet: a segment of a wall in the plane, a triangle in space, with the flow on one side of it.

use crate::vector::Vector;

/// Height of a triangle over its longest edge below which it has no side `[-]`.
const THINNEST: f64 = 1e-6;
/// Distance from a corner or an edge over the facet's size that counts as none `[-]`.
const ROUNDING: f64 = 1e-9;

/// A segment between two corners, or a triangle of three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet<const D: usize> {
    /// Corners `[m]`.
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

impl Facet<3> {
    /// The triangle of three corners `[m]` that are seen from the flow against the clock; none where it is thinner than a
    /// millionth of its longest edge, or not finite.
    #[must_use]
    pub fn triangle(corners: [Vector<3>; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let across = (b - a).cross(&(c - a));
        let longest = [b - a, c - b, a - c].map(|edge| edge.norm_squared()).into_iter().fold(0.0, f64::max);
        let area = across.norm();
        (area > THINNEST * longest && area.is_finite()).then(|| Self { corners, normal: across / area })
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

    /// Directions of its edges at a point of its rim `[-]`: at a corner of a triangle to the other two, on an edge both ways
    /// along it. A segment has none.
    #[must_use]
    pub(super) fn rays(&self, point: &Vector<D>) -> [Vector<D>; 2] {
        let [a, b, c] = &self.corners[..] else { return [Vector::zeros(); 2] };
        let edges = [[a, b, c], [b, c, a], [c, a, b]];
        let size = (b - a).norm().max((c - a).norm());
        for [corner, next, last] in edges {
            if (point - corner).norm() <= ROUNDING * size {
                return [(next - corner).normalize(), (last - corner).normalize()];
            }
        }
        let from = |edge: &[&Vector<D>; 3]| (point - nearest(&[*edge[0], *edge[1]], point)).norm_squared();
        let closest = edges.into_iter().min_by(|one, other| from(one).total_cmp(&from(other)));
        closest.map_or([Vector::zeros(); 2], |[start, end, _]| {
            let along = (end - start).normalize();
            [along, -along]
        })
    }

    /// Directions out of a triangle across its edges in its plane `[-]`, each with the place of the edge along it `[m]`; zero for a
    /// segment.
    pub(super) fn edges(&self) -> [(Vector<D>, f64); D] {
        std::array::from_fn(|k| {
            let [start, end, opposite] = [0, 1, 2].map(|next| self.corners[(k + next) % D]);
            let (along, across) = (end - start, start - opposite);
            let out =
                if D < 3 { Vector::zeros() } else { across - along * (across.dot(&along) / along.norm_squared()) };
            let out = out.try_normalize(0.0).unwrap_or(out);
            (out, out.dot(&start))
        })
    }

    /// Angle that it fills around a point of its rim `[rad]`; 1 for a segment, whose ends are all alike.
    #[must_use]
    pub(super) fn angle(&self, point: &Vector<D>) -> f64 {
        if D < 3 {
            return 1.0;
        }
        let [one, other] = self.rays(point);
        libm::acos(one.dot(&other).clamp(-1.0, 1.0))
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

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn no_point_of_a_triangle_is_nearer_than_the_nearest() {
        let corners = [[0.1, -0.2, 0.4], [1.3, 0.1, 0.2], [0.3, 0.9, -0.5]].map(Vector::<3>::from);
        let facet = Facet::triangle(corners).expect("a triangle");
        let [a, b, c] = corners;
        let parts = 60;
        let points = (0..=parts).flat_map(|i| (0..=parts - i).map(move |j| (i, j)));
        let points: Vec<_> = points
            .map(|(i, j)| a + (b - a) * (f64::from(i) / f64::from(parts)) + (c - a) * (f64::from(j) / f64::from(parts)))
            .collect();
        let distance =
            |place: &Vector<3>| points.iter().map(|point| (point - place).norm()).fold(f64::INFINITY, f64::min);
        for k in 0..9_u32.pow(3) {
            // all around, and in the plane of the triangle, also beyond its edges and corners
            let [i, j, l] = [k % 9, k / 9 % 9, k / 81].map(|k| 0.5 * f64::from(k) - 1.5);
            let place = a + (b - a) * i + (c - a) * j + facet.normal * (l - 0.5);
            let nearest = facet.nearest(&place);
            let (found, least) = ((nearest - place).norm(), distance(&place));
            assert!(found < least + 1e-12 && found > least - 0.03, "{found} and {least} from {place:?}");
            assert!(distance(&nearest) < 0.03, "{nearest:?} is no point of the triangle");
        }
    }

    #[test]
    fn a_triangle_faces_those_who_see_its_corners_against_the_clock() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector::<3>::from);
        let facet = Facet::triangle(corners).expect("a triangle");
        assert!(facet.normal == Vector::<3>::new(0.0, 0.0, 1.0));
        assert!((facet.angle(&corners[0]) - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        assert!((facet.angle(&corners[1]) - 0.5_f64.atan()).abs() < 1e-15);
        assert!((facet.angle(&Vector::<3>::new(1.0, 0.0, 0.0)) - std::f64::consts::PI).abs() < 1e-15);
        for thin in [[2.0, 0.0, 0.0], [1.0, 1e-7, 0.0], [f64::NAN, 1.0, 0.0], [f64::INFINITY, 1.0, 0.0]] {
            assert!(Facet::triangle([corners[0], corners[1], thin.into()]).is_none(), "{thin:?}");
        }
    }
}
