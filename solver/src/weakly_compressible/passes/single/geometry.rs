//! The pair sums of the geometry pass in single precision.

use super::super::geometry::GeometrySums;
use super::super::{layout, records};
use super::{Near, PART, SingleRecords, flush_tensor, flush_vector, nearness};
use crate::lanes::algebra::{zero_tensor, zero_vector};
use crate::lanes::{Lanes, SingleLanes};
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::NeighbourGroup;
use crate::weakly_compressible::particles::Particles;

/// Records of position, volume and pressure.
pub(in super::super) fn fill<const D: usize>(model: &Model<D>, particles: &Particles<D>, records: &mut SingleRecords) {
    let quads = const { layout::geometry(D).div_ceil(4) };
    records.fill(particles.position.len(), quads, model.kernel.smoothing_length(), |index, record| {
        record.position(&particles.position[index]);
        record.scalar(particles.volume[index]);
        record.scalar(particles.pressure[index]);
    });
}

/// Pair sums of a group whose own pressures `[Pa]` are given.
#[inline(always)]
pub(in super::super) fn pair_sums<V: Lanes, const D: usize>(
    model: &Model<D>,
    records: &SingleRecords,
    group: &NeighbourGroup<'_>,
    pressure: V,
) -> GeometrySums<V, D> {
    let quads = const { layout::geometry(D).div_ceil(4) };
    let own = records.load::<V::Single>(quads, &group.own);
    let place = records::vector::<V::Single, D>(&own, 0);
    let pressure_a = records::scalar(&own, D + 1);
    let (mut moment, mut gradient) = (zero_tensor::<V, D>(), zero_vector::<V, D>());
    let (mut part_moment, mut part_gradient) = (zero_tensor::<V::Single, D>(), zero_vector::<V::Single, D>());
    let mut near = Near::<V::Single, D>::none();
    let mut chunks = group.pairs;
    while !chunks.is_empty() {
        let part = chunks.take_first(PART);
        nearness(&model.kernel, records, quads, &place, part, &mut near);
        for (slot, b) in part.enumerate() {
            let Near { r, weight, .. } = near[slot & (PART - 1)];
            let (quad, place) = const { ((D + 1) / 4, (D + 1) % 4) };
            let step = V::Single::load_quads(&records.data, quads, quad, &b)[place] - pressure_a;
            for i in 0..D {
                let weighted = weight * r[i];
                part_gradient[i] = part_gradient[i] + step * weighted;
                for j in i..D {
                    part_moment[i][j] = part_moment[i][j] - weighted * r[j];
                }
            }
        }
        flush_tensor(&mut moment, &mut part_moment);
        flush_vector(&mut gradient, &mut part_gradient);
    }
    for i in 1..D {
        for j in 0..i {
            moment[i][j] = moment[j][i];
        }
    }
    GeometrySums { moment, gradient, pressure }
}
