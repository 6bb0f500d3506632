//! All pairs, tested one by one: the reference that the fast search is tested against.

use crate::vector::Vector;

/// For each of the first `rows` positions the indices of all other positions nearer than `radius` `[m]`, ascending.
#[must_use]
pub fn neighbours<const D: usize>(positions: &[Vector<D>], rows: usize, radius: f64) -> Vec<Vec<u32>> {
    (0..rows)
        .map(|a| {
            (0..positions.len())
                .filter(|&b| b != a && (positions[a] - positions[b]).norm_squared() < radius * radius)
                .map(|b| b as u32)
                .collect()
        })
        .collect()
}
