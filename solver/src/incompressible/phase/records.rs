//! Particle data that passes over pairs read, packed so that eight neighbours are loaded in quads: the position first,
//! behind it what a pass needs.

use crate::lanes::{LANES, LaneIndices, Lanes};
use crate::vector::Vector;

/// Fields that a record has at most.
pub(crate) const FIELDS: usize = 16;

/// Packs positions and what `fill` writes behind them, in records of a given number of quads.
pub(crate) fn pack<const D: usize>(
    records: &mut Vec<[f64; 4]>,
    quads: usize,
    position: &[Vector<D>],
    fill: impl Fn(usize, &mut [f64]),
) {
    records.resize(position.len() * quads, [0.0; 4]);
    for (a, (record, position)) in records.chunks_exact_mut(quads).zip(position).enumerate() {
        let (place, behind) = record.as_flattened_mut().split_at_mut(D);
        place.copy_from_slice(position.as_slice());
        fill(a, behind);
    }
}

/// Fields of eight records of a given number of quads, shape `[fields][8]`; missing fields are zero.
#[inline(always)]
pub(crate) fn load<V: Lanes>(records: &[[f64; 4]], quads: usize, indices: &LaneIndices<'_>) -> [V; FIELDS] {
    let mut fields = [V::splat(0.0); FIELDS];
    for quad in 0..quads {
        let loaded = V::load_quads(records, quads, quad, indices);
        for k in 0..4 {
            fields[4 * quad + k] = loaded[k];
        }
    }
    fields
}

/// The fields of a group's own records, of `count` in all; those of the last one in lanes that are left.
#[inline(always)]
pub(crate) fn of_group<V: Lanes>(records: &[[f64; 4]], quads: usize, group: usize, count: usize) -> [V; FIELDS] {
    load(records, quads, &LaneIndices::new(&group_indices(group, count), count))
}

/// The indices of a group of `count`, the last one in lanes that are left.
#[inline(always)]
pub(crate) fn group_indices(group: usize, count: usize) -> [u32; LANES] {
    let mut indices = [0; LANES];
    for lane in 0..LANES {
        indices[lane] = (group * LANES + lane).min(count - 1) as u32;
    }
    indices
}
