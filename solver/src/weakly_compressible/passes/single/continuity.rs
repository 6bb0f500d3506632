//! The pair sums of continuity, velocity gradient and stress diffusion in single precision.

use super::super::new_state::RateSums;
use super::super::records::{self, LaneRecord};
use super::{Near, PART, SingleRecords, apart, flush, flush_tensor, nearness};
use crate::lanes::algebra::{accumulate, accumulate_outer, difference, dot, sum_of, zero_tensor};
use crate::lanes::{Lanes, Real};
use crate::vector::equivalent_shear_stress;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::NeighbourGroup;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{continuity, density_coupling, stress_diffusion};

/// Places in a record: position, volume, velocity, pressure, corrected pressure gradient (of a wall particle the velocity that
/// the continuity of a liquid takes), and if the stress diffuses what of the particle yields, and s.
struct Place<const D: usize>;

impl<const D: usize> Place<D> {
    const VOLUME: usize = D;
    const VELOCITY: usize = D + 1;
    const PRESSURE: usize = 2 * D + 1;
    const GRADIENT: usize = 2 * D + 2;
    const YIELDING: usize = 3 * D + 2;
    const SHORT: usize = Self::YIELDING.div_ceil(4);

    const fn quads(diffuses: bool) -> usize {
        if diffuses { (Self::YIELDING + 1 + records::deviator_values(D)).div_ceil(4) } else { Self::SHORT }
    }
}

/// Records of flow and walls.
pub(in super::super) fn fill<const D: usize>(model: &Model<D>, particles: &Particles<D>, records: &mut SingleRecords) {
    let diffuses = model.stress_diffuses();
    let quads = Place::<D>::quads(diffuses);
    records.fill(particles.position.len(), quads, model.kernel.smoothing_length(), |index, record| {
        record.position(&particles.position[index]);
        record.scalar(particles.volume[index]);
        record.vector(&particles.velocity[index]);
        let pressure = particles.pressure[index];
        record.scalar(pressure);
        let wall = particles.is_wall(index);
        record.vector(if wall {
            &particles.walls.sliding_velocity[index - particles.flow_count()]
        } else {
            &particles.pressure_gradient[index]
        });
        if diffuses {
            let stress = &particles.stress[index];
            let elasticity = model.rheology.elasticity(equivalent_shear_stress(stress), pressure);
            record.scalar(stress_diffusion::yielding(elasticity, pressure));
            record.deviator(stress);
        }
    });
}

/// What is read of a particle.
struct Partner<S, const D: usize> {
    position: [S; D],
    velocity: [S; D],
    pressure: S,
    pressure_gradient: [S; D],
}

impl<S: Real, const D: usize> Partner<S, D> {
    #[inline(always)]
    fn of(record: &LaneRecord<S>) -> Self {
        Self {
            position: records::vector(record, 0),
            velocity: records::vector(record, Place::<D>::VELOCITY),
            pressure: records::scalar(record, Place::<D>::PRESSURE),
            pressure_gradient: records::vector(record, Place::<D>::GRADIENT),
        }
    }
}

/// The two sums that the stress ratio's diffusion joins after the loop: Σ f p_b and Σ f s_b.
#[derive(Clone, Copy)]
struct Diffusion<V, const D: usize> {
    pressures: V,
    stresses: [[V; D]; D],
}

impl<V: Real, const D: usize> Diffusion<V, D> {
    #[inline(always)]
    fn none() -> Self {
        Self { pressures: V::splat(0.0), stresses: zero_tensor() }
    }
}

/// Pair sums of a group.
#[inline(always)]
pub(in super::super) fn pair_sums<V: Lanes, const D: usize, const DIFFUSES: bool>(
    model: &Model<D>,
    records: &SingleRecords,
    group: &NeighbourGroup<'_>,
) -> RateSums<V, D> {
    let quads = const { Place::<D>::quads(DIFFUSES) };
    let record = records.load::<V::Single>(quads, &group.own);
    let own = Partner::<V::Single, D>::of(&record);
    let own_yields = records::scalar(&record, Place::<D>::YIELDING);
    let zero = V::Single::splat(0.0);
    let none = zero_tensor::<V::Single, D>();
    let (mut coupling, mut gradient) = (V::splat(0.0), zero_tensor::<V, D>());
    let mut diffusion = Diffusion::<V, D>::none();
    let (mut part_coupling, mut part_gradient) = (zero, none);
    let mut part_diffusion = Diffusion::<V::Single, D>::none();
    let mut near = Near::<V::Single, D>::none();
    let mut chunks = group.flow;
    while !chunks.is_empty() {
        let part = chunks.take_first(PART);
        nearness(&model.kernel, records, quads, &own.position, part, &mut near);
        for (slot, b) in part.enumerate() {
            let Near { r, weight, .. } = near[slot & (PART - 1)];
            let record = records.load::<V::Single>(quads, &b);
            let other = Partner::<V::Single, D>::of(&record);
            if DIFFUSES {
                let yields = records::scalar(&record, Place::<D>::YIELDING);
                let stress = records::deviator::<V::Single, D>(&record, Place::<D>::YIELDING + 1);
                let sum = own.pressure + other.pressure;
                let factor = weight * stress_diffusion::pair_factor(own_yields, yields, sum);
                part_diffusion.pressures = part_diffusion.pressures + factor * other.pressure;
                for i in 0..D - 1 {
                    for j in i..D {
                        part_diffusion.stresses[i][j] = part_diffusion.stresses[i][j] + factor * stress[i][j];
                    }
                }
            }
            let sum = sum_of(&own.pressure_gradient, &other.pressure_gradient);
            let bracket = density_coupling::bracket(own.pressure - other.pressure, &sum, &r);
            part_coupling = part_coupling + weight * bracket;
            accumulate_outer(&mut part_gradient, weight, &difference(&other.velocity, &own.velocity), &r);
        }
        flush(&mut coupling, &mut part_coupling);
        flush_tensor(&mut gradient, &mut part_gradient);
        if DIFFUSES {
            flush(&mut diffusion.pressures, &mut part_diffusion.pressures);
            flush_tensor(&mut diffusion.stresses, &mut part_diffusion.stresses);
        }
    }
    let (wall_gradient, wall_compression) = wall_sums::<V, D>(model, records, quads, group, &own);
    let compression = continuity::compression(&gradient) + wall_compression;
    for i in 0..D {
        accumulate(&mut gradient[i], V::splat(1.0), &wall_gradient[i]);
    }
    let mut stress_diffusion = zero_tensor::<V, D>();
    if DIFFUSES {
        let own_stress = records::deviator::<V::Single, D>(&record, Place::<D>::YIELDING + 1);
        let pressure = V::widen(own.pressure);
        for i in 0..D - 1 {
            for j in i..D {
                stress_diffusion[i][j] =
                    diffusion.pressures * V::widen(own_stress[i][j]) - pressure * diffusion.stresses[i][j];
            }
        }
        stress_diffusion::complete(&mut stress_diffusion);
    }
    RateSums { compression, wall_compression, coupling, gradient, wall_gradient, stress_diffusion }
}

/// What walls have of the velocity gradient and of −∇·v, before the correction.
#[inline(always)]
fn wall_sums<V: Lanes, const D: usize>(
    model: &Model<D>,
    records: &SingleRecords,
    quads: usize,
    group: &NeighbourGroup<'_>,
    own: &Partner<V::Single, D>,
) -> ([[V; D]; D], V) {
    let unit = V::Single::splat(records.unit);
    let (mut gradient, mut compression) = (zero_tensor::<V, D>(), V::splat(0.0));
    let (mut part_gradient, mut part_compression) = (zero_tensor::<V::Single, D>(), V::Single::splat(0.0));
    let mut chunks = group.wall;
    while !chunks.is_empty() {
        for w in chunks.take_first(PART) {
            let record = records.load_start::<V::Single>(quads, const { Place::<D>::SHORT }, &w);
            let wall = Partner::<V::Single, D>::of(&record);
            let r = apart(&own.position, &wall.position, unit);
            let volume = records::scalar(&record, Place::<D>::VOLUME);
            let weight = model.kernel.gradient_weight(dot(&r, &r), volume);
            accumulate_outer(&mut part_gradient, weight, &difference(&wall.velocity, &own.velocity), &r);
            let sliding = difference(&own.velocity, &wall.pressure_gradient);
            part_compression = part_compression + weight * dot(&sliding, &r);
        }
        flush_tensor(&mut gradient, &mut part_gradient);
        flush(&mut compression, &mut part_compression);
    }
    (gradient, compression)
}
