//! From cells to nodes, and from one lattice to the next.

use super::Level;

/// φ of a corner of a cell at a place in it; bit k of the corner tells the side along axis k.
#[inline(always)]
pub(super) fn share<const D: usize>(place: &[f64; D], corner: usize) -> f64 {
    let mut share = 1.0;
    for axis in 0..D {
        share *= if corner >> axis & 1 == 1 { place[axis] } else { 1.0 - place[axis] };
    }
    share
}

#[inline(always)]
pub(super) fn split<const D: usize>(mut index: usize, counts: [usize; D]) -> [usize; D] {
    std::array::from_fn(|axis| {
        let along = index % counts[axis];
        index /= counts[axis];
        along
    })
}

#[inline(always)]
pub(super) fn join<const D: usize>(place: [usize; D], counts: [usize; D]) -> usize {
    (0..D).rev().fold(0, |index, axis| index * counts[axis] + place[axis])
}

/// Calls `visit` with every cell around a node and the corner that the node is of it.
#[inline(always)]
pub(super) fn for_each_cell_around<const D: usize>(
    node: [usize; D],
    cells: [usize; D],
    periodic: [bool; D],
    mut visit: impl FnMut(usize, usize),
) {
    'corners: for corner in 0..1usize << D {
        let mut cell = node;
        for axis in 0..D {
            if corner >> axis & 1 == 1 {
                // the node is the upper end of the cell before it
                if node[axis] == 0 && !periodic[axis] {
                    continue 'corners;
                }
                cell[axis] = (node[axis] + cells[axis] - 1) % cells[axis];
            } else if node[axis] == cells[axis] {
                continue 'corners;
            }
        }
        visit(join(cell, cells), corner);
    }
}

/// Φ_coarseᵀ of the finer lattice's values, of a node.
#[inline(always)]
pub(super) fn from_finer<const D: usize>(
    node: [usize; D],
    ratio: [usize; D],
    fine: &Level<D>,
    periodic: [bool; D],
) -> f64 {
    let mut sum = 0.0;
    'neighbours: for code in 0..3usize.pow(D as u32) {
        let (mut rest, mut weight, mut place) = (code, 1.0, node);
        for axis in 0..D {
            let nodes = fine.nodes[axis];
            // one before, the same, one behind
            let shifted = ratio[axis] * node[axis] + rest % 3;
            if rest % 3 != 1 {
                weight *= 0.5;
                if ratio[axis] == 1 {
                    continue 'neighbours;
                }
            }
            rest /= 3;
            if periodic[axis] {
                place[axis] = (shifted + nodes - 1) % nodes;
            } else if shifted == 0 || shifted > nodes {
                continue 'neighbours;
            } else {
                place[axis] = shifted - 1;
            }
        }
        sum += weight * fine.value[join(place, fine.nodes)];
    }
    sum
}

/// Φ_coarse of the coarser lattice's values, at a node of the finer one.
#[inline(always)]
pub(super) fn from_coarser<const D: usize>(node: [usize; D], coarse: &Level<D>) -> f64 {
    let (mut sum, share) = (0.0, 0.5_f64.powi(D as i32));
    for corner in 0..1usize << D {
        // a node of the finer lattice is one of the coarser, or lies between two
        let place = std::array::from_fn(|axis| {
            let (ratio, k) = (coarse.ratio[axis], node[axis]);
            (k / ratio + k % ratio * (corner >> axis & 1)) % coarse.nodes[axis]
        });
        sum += share * coarse.value[join(place, coarse.nodes)];
    }
    sum
}
