//! Edges of a mesh at which a surface ends or turns over.

use super::mesh::Triangle;
use std::collections::BTreeMap;

type Corner = [u64; 3];

/// Defects of the edges of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct EdgeDefects {
    /// Holes of the size of one triangle, each by a corner `[m]`.
    pub(crate) holes: Vec<[f64; 3]>,
    /// Edges along which neighbours are seen from opposite sides.
    pub(crate) turned: usize,
}

/// Searches the edges of a mesh: a hole is a ring of three edges that one triangle each has. The open top of a tank has more.
pub(crate) fn defects(triangles: &[Triangle]) -> EdgeDefects {
    let bits = |corner: &[f64; 3]| -> Corner { corner.map(f64::to_bits) };
    let mut edges: BTreeMap<(Corner, Corner), usize> = BTreeMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((bits(from), bits(to))).or_default() += 1;
        }
    }
    let turned = edges.values().filter(|count| **count > 1).count();
    // the surface that is missing would have the edge the other way
    let open: BTreeMap<Corner, Corner> =
        edges.keys().filter(|(from, to)| !edges.contains_key(&(*to, *from))).map(|(from, to)| (*to, *from)).collect();
    let ring = |start: &Corner| {
        let second = open.get(start)?;
        let third = open.get(second)?;
        let is_closed = open.get(third) == Some(start) && start < second && start < third;
        is_closed.then(|| start.map(f64::from_bits))
    };
    EdgeDefects { holes: open.keys().filter_map(ring).collect(), turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_and_a_turned_triangle_of_a_tetrahedron_are_found() {
        let [o, x, y, z] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let whole = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        assert_eq!(defects(&whole), EdgeDefects { holes: vec![], turned: 0 });
        assert_eq!(defects(&whole[..3]), EdgeDefects { holes: vec![z], turned: 0 });
        assert_eq!(defects(&[whole[0], whole[1], whole[2], [y, x, z]]).turned, 3);
        // two triangles of a plate: its rim is no hole
        assert!(defects(&[[o, x, y], [x, [1.0, 1.0, 0.0], y]]).holes.is_empty());
    }
}
