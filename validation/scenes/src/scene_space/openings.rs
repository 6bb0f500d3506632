//! Openings of a mesh: rings of edges that one triangle has alone, such as the top of a tank, or a triangle that is missing.

use bagnold_number::four_digits;
use bagnold_solver::vector::Vector;
use std::collections::BTreeMap;

type Corner = [u64; 3];

/// Edges at which a surface ends or turns over.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Openings {
    /// Rings of open edges, each by its corners `[m]`.
    pub(super) rings: Vec<Vec<Vector<3>>>,
    /// Edges whose neighbouring facets are seen from opposite sides.
    pub(super) turned: usize,
}

impl Openings {
    /// The openings of triangles whose neighbours have the same corners to the last bit.
    pub(super) fn of(triangles: &[[Vector<3>; 3]]) -> Self {
        let bits = |corner: &Vector<3>| -> Corner { [corner.x, corner.y, corner.z].map(|x| (x + 0.0).to_bits()) };
        let mut edges: BTreeMap<(Corner, Corner), usize> = BTreeMap::new();
        for [a, b, c] in triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((bits(from), bits(to))).or_default() += 1;
            }
        }
        let turned = edges.values().filter(|count| **count > 1).count();
        // the surface that is missing would have the edge the other way
        let mut open: BTreeMap<Corner, Vec<Corner>> = BTreeMap::new();
        for (from, to) in edges.keys().filter(|(from, to)| !edges.contains_key(&(*to, *from))) {
            open.entry(*to).or_default().push(*from);
        }
        let mut rings = Vec::new();
        while let Some(start) = open.keys().next().copied() {
            let (mut ring, mut place) = (Vec::new(), start);
            while let Some(next) = open.get_mut(&place).and_then(Vec::pop) {
                if open.get(&place).is_some_and(Vec::is_empty) {
                    open.remove(&place);
                }
                ring.push(Vector::from(place.map(f64::from_bits)));
                place = next;
                if place == start {
                    break;
                }
            }
            rings.push(ring);
        }
        Self { rings, turned }
    }

    /// The openings in words; none where the surface is closed.
    pub(super) fn in_words(&self) -> Option<String> {
        let ring = |corners: &Vec<Vector<3>>| {
            let middle = corners.iter().sum::<Vector<3>>() / corners.len() as f64;
            // a mean of corners is known to rounding
            let at =
                [middle.x, middle.y, middle.z].map(|x| four_digits(if x.abs() < 1e-9 { 0.0 } else { x })).join(", ");
            let hole = if corners.len() == 3 { ", probably a missing triangle" } else { "" };
            format!("{} edges around ({at}) m{hole}", corners.len())
        };
        let rings: Vec<String> = self.rings.iter().take(6).map(ring).collect();
        let more = self.rings.len().saturating_sub(rings.len());
        let more = if more > 0 { format!(", and {more} more") } else { String::new() };
        let noun = if self.rings.len() == 1 { "opening" } else { "openings" };
        (!rings.is_empty()).then(|| format!("{} {noun}: {}{more}", self.rings.len(), rings.join("; ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn openings_of_a_tetrahedron_are_its_missing_triangles() {
        let at = |x: f64, y: f64, z: f64| Vector::<3>::new(x, y, z);
        let [o, x, y, z] = [at(0.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(0.0, 1.0, 0.0), at(0.0, 0.0, 1.0)];
        let whole = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        assert_eq!(Openings::of(&whole), Openings { rings: vec![], turned: 0 });
        assert_eq!(Openings::of(&whole).in_words(), None);
        let hole = Openings::of(&whole[..3]);
        assert_eq!((hole.rings.len(), hole.rings[0].len(), hole.turned), (1, 3, 0));
        assert_eq!(
            hole.in_words().as_deref(),
            Some("1 opening: 3 edges around (0.3333, 0.3333, 0.3333) m, probably a missing triangle")
        );
        assert_eq!(Openings::of(&[whole[0], whole[1], whole[2], [y, x, z]]).turned, 3);
        // two missing triangles that share an edge are one opening of four edges
        assert_eq!(Openings::of(&whole[..2]).rings[0].len(), 4);
        // two that meet in a corner alone are two rings or one that passes it twice
        let apart = Openings::of(&[[o, x, y], [o, at(-1.0, 0.0, 0.0), at(0.0, -1.0, 0.0)]]);
        assert_eq!(apart.rings.iter().map(Vec::len).sum::<usize>(), 6);
    }
}
