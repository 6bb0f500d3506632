//! A fan: many triangles around one corner. All are equally near to a place whose nearest point is the corner, and what they say of
//! it there is the same for every such place but for their heights.

use super::facet::Facet;
use super::facet_side::{FacetSide, Tied, is_open_among_many};
use crate::vector::Vector;

/// Triangles of a fan at least.
const SMALLEST: usize = 256;
/// Angle of each at its corner at least `[rad]`: rounding of thinner ones may put their nearest point beside the corner.
const THINNEST: f64 = 1e-4;
/// Cosine beyond a right angle between an edge and the way from the corner to a place that is nearest to the corner `[-]`.
const CLEAR: f64 = 1e-3;

/// The triangles around a corner. It is not generic, so that it is compiled here.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fan {
    /// The corner `[m]`.
    corner: Vector<3>,
    /// Their places among all, rising.
    facets: Vec<u32>,
    /// Directions of their edges from the corner `[-]`.
    rays: Vec<Vector<3>>,
    /// Sum of their normals, each times its angle `[rad]`.
    sum: Vector<3>,
    /// Whether they leave a gap.
    is_open: bool,
}

impl Fan {
    /// The fans among facets; there are none in the plane.
    pub(super) fn all<const D: usize>(facets: &[Facet<D>]) -> Vec<Self> {
        let bits = |corner: Vector<3>| [0, 1, 2].map(|axis| (corner[axis] + 0.0).to_bits());
        let of_facet = |(facet, index): (&Facet<D>, u32)| facet.corners.map(|corner| (bits(of(&corner)), index));
        let mut corners: Vec<([u64; 3], u32)> = facets.iter().zip(0..).flat_map(of_facet).collect();
        corners.sort_unstable();
        let fans = corners.chunk_by(|one, other| one.0 == other.0).filter(|same| D == 3 && same.len() >= SMALLEST);
        fans.filter_map(|same| {
            let corner = Vector::from(same[0].0.map(f64::from_bits));
            Self::around(corner, facets, same.iter().map(|(_, index)| *index).collect())
        })
        .collect()
    }

    /// The fan of some facets around a corner; none if one of them is too thin.
    fn around<const D: usize>(corner: Vector<3>, all: &[Facet<D>], facets: Vec<u32>) -> Option<Self> {
        let (own, at) = (|| facets.iter().map(|&facet| &all[facet as usize]), of(&corner));
        let angles: Vec<f64> = own().map(|facet| facet.angle(&at)).collect();
        let rays: Vec<_> = own().enumerate().flat_map(|(own, facet)| facet.rays(&at).map(|ray| (own, ray))).collect();
        let sum = own().zip(&angles).fold(Vector::zeros(), |sum, (facet, angle)| sum + facet.normal * *angle);
        let is_thick = angles.iter().all(|angle| *angle >= THINNEST);
        let directions = rays.iter().map(|(_, ray)| of(ray)).collect();
        let is_open = is_open_among_many(rays);
        is_thick.then(|| Self { corner, facets, rays: directions, sum: of(&sum), is_open })
    }

    /// Whether a facet is one of the fan.
    pub(super) fn has<const D: usize>(&self, facet: &Facet<D>) -> bool {
        facet.corners.contains(&of(&self.corner))
    }

    /// Distance of the corner from a place `[m]` that it is clearly nearest to among all points of the fan; none from another place.
    pub(super) fn distance(&self, place: &Vector<3>) -> Option<f64> {
        let way = place - self.corner;
        let distance = way.norm();
        self.rays.iter().all(|ray| ray.dot(&way) < -CLEAR * distance).then_some(distance)
    }

    /// Side of the fan on which such a place is.
    pub(super) fn side<const D: usize>(&self, all: &[Facet<D>], place: &Vector<D>) -> FacetSide {
        let way = place - of::<3, D>(&self.corner);
        let mut tied = Tied::at(way.norm());
        self.facets.iter().for_each(|&facet| tied.add(facet as usize, &all[facet as usize], place, way));
        tied.side(of(&self.sum), || self.is_open)
    }
}

/// A vector with another number of axes.
pub(super) fn of<const D: usize, const E: usize>(vector: &Vector<D>) -> Vector<E> {
    Vector::from_fn(|axis, _| if axis < D { vector[axis] } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::super::facet_side::facet_side;
    use super::*;

    /// A cone of slivers around the origin up to a slope, part of it left out, in any order and from any corner on.
    fn cone(slope: f64, part: f64, flipped: bool) -> Vec<Facet<3>> {
        let count = 300_u32;
        let rim = |k: u32| {
            let angle = part * f64::from(k) * std::f64::consts::TAU / f64::from(count);
            Vector::<3>::new(libm::cos(angle), libm::sin(angle), slope)
        };
        let sliver = |k: u32| {
            let mut corners = [Vector::zeros(), rim(k), rim(if part < 1.0 { k + 1 } else { (k + 1) % count })];
            corners.rotate_left(k as usize % 3);
            if flipped {
                corners.reverse();
            }
            Facet::triangle(corners)
        };
        (0..count).filter_map(|k| sliver(k * 1237 % count)).collect()
    }

    #[test]
    fn a_fan_says_of_a_place_beyond_its_corner_what_all_its_facets_say_to_the_last_bit() {
        for (slope, part) in [(2.0, 1.0), (0.5, 1.0), (-2.0, 1.0), (2.0, 0.9), (0.0, 0.25)] {
            for flipped in [false, true] {
                let facets = cone(slope, part, flipped);
                let fans = Fan::all(&facets);
                assert_eq!(fans.len(), 1);
                let mut nearest = 0;
                for k in 0..343_u32 {
                    let place = Vector::<3>::from([k % 7, k / 7 % 7, k / 49].map(|k| 0.09 * f64::from(k) - 0.27));
                    if let Some(distance) = fans[0].distance(&place) {
                        nearest += 1;
                        let expected = facet_side(facets.iter().map(|facet| (facet, place)));
                        assert_eq!(Some(fans[0].side(&facets, &place)), expected, "{place}");
                        assert!(distance == place.norm());
                        assert!(facets.iter().all(|facet| facet.nearest(&place) == fans[0].corner));
                    }
                }
                assert!(nearest > 8, "{nearest} of slope {slope}");
            }
        }
        assert!(Fan::all(&cone(2.0, 1.0, false)[..200]).is_empty());
        // slivers of a hundred-thousandth
        let at = |k: u32| Vector::<3>::new(1.0, 1e-5 * f64::from(k), 0.0);
        let thin: Vec<_> = (0..300).filter_map(|k| Facet::triangle([Vector::zeros(), at(k), at(k + 1)])).collect();
        assert!(thin.len() == 300 && Fan::all(&thin).is_empty());
    }
}
