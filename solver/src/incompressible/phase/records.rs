//! Particle data that passes over pairs read, packed so that eight neighbours are loaded in quads: the position first,
//! behind it up to as many values again.

use crate::lanes::{LANES, LaneIndices, Lanes};
use crate::vector::Vector;

/// Fields that a record has at most.
pub(crate) const FIELDS: usize = 8;

/// Quads of a record.
const fn quads(dimensions: usize) -> usize {
    (2 * dimensions).div_ceil(4)
}

/// Packs positions and what stands behind them.
pub(crate) fn pack<const D: usize, const N: usize>(
    records: &mut Vec<[f64; 4]>,
    position: &[Vector<D>],
    behind: impl Fn(usize) -> [f64; N],
) {
    records.resize(position.len() * quads(D), [0.0; 4]);
    for (a, (record, position)) in records.chunks_exact_mut(quads(D)).zip(position).enumerate() {
        let record = record.as_flattened_mut();
        record[..D].copy_from_slice(position.as_slice());
        record[D..D + N].copy_from_slice(&behind(a));
    }
}

/// The fields of eight records, shape `[fields][8]`; those that there are not are zero.
#[inline(always)]
pub(crate) fn load<V: Lanes, const D: usize>(records: &[[f64; 4]], indices: &LaneIndices<'_>) -> [V; FIELDS] {
    let mut fields = [V::splat(0.0); FIELDS];
    for quad in 0..quads(D) {
        let loaded = V::load_quads(records, quads(D), quad, indices);
        for k in 0..4 {
            fields[4 * quad + k] = loaded[k];
        }
    }
    fields
}

/// The fields of a group's own records, of `count` in all; those of the last one in lanes that are left.
#[inline(always)]
pub(crate) fn of_group<V: Lanes, const D: usize>(records: &[[f64; 4]], group: usize, count: usize) -> [V; FIELDS] {
    load::<V, D>(records, &LaneIndices::new(&group_indices(group, count), count))
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
