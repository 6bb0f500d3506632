//! The pair sums of continuity, velocity gradient and stress diffusion in single precision.

use super::super::continuity::diffusion;
use super::super::new_state::{FieldSums, RateSums};
use super::super::records::{self, LaneRecord};
use super::{Near, PART, SingleRecords, apart, flush, flush_tensor, nearness};
use crate::lanes::algebra::{accumulate, accumulate_outer, difference, dot, sum_of, zero_tensor};
use crate::lanes::{Lanes, Real, gather, gather_vectors};
use crate::vector::equivalent_shear_stress;
use crate::weakly_compressible::model::{Model, PairDiffusion};
use crate::weakly_compressible::neighbours::NeighbourGroup;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{continuity, density_coupling, field_diffusion, stress_diffusion};

/// Places in a record: position, volume, velocity, pressure, corrected pressure gradient (of a wall particle the velocity that
/// the continuity of a liquid takes), and if they diffuse what of the particle yields and s, and then the law's field.
struct Place<const D: usize>;

impl<const D: usize> Place<D> {
    const VOLUME: usize = D;
    const VELOCITY: usize = D + 1;
    const PRESSURE: usize = 2 * D + 1;
    const GRADIENT: usize = 2 * D + 2;
    const YIELDING: usize = 3 * D + 2;
    const FIELD: usize = Self::YIELDING + 1 + records::deviator_values(D);
    const SHORT: usize = Self::YIELDING.div_ceil(4);

    const fn quads(diffusion: u8) -> usize {
        match diffusion {
            diffusion::STRESS_RATIO => Self::FIELD.div_ceil(4),
            diffusion::FIELD => (Self::FIELD + 1).div_ceil(4),
            _ => Self::SHORT,
        }
    }
}

/// Records of flow and walls.
pub(in super::super) fn fill<const D: usize>(model: &Model<D>, particles: &Particles<D>, records: &mut SingleRecords) {
    let diffusion = model.pair_diffusion();
    let quads = match diffusion {
        PairDiffusion::None => Place::<D>::quads(diffusion::NONE),
        PairDiffusion::StressRatio => Place::<D>::quads(diffusion::STRESS_RATIO),
        PairDiffusion::Field => Place::<D>::quads(diffusion::FIELD),
    };
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
        if diffusion != PairDiffusion::None {
            let stress = &particles.stress[index];
            let kept = particles.kept(index);
            let elasticity = model.elasticity(equivalent_shear_stress(stress), pressure, &kept);
            record.scalar(stress_diffusion::yielding(elasticity, pressure));
            record.deviator(stress);
        }
        if diffusion == PairDiffusion::Field {
            record.scalar(particles.field.as_ref().map_or(0.0, |field| field[index]));
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
pub(in super::super) fn pair_sums<V: Lanes, const D: usize, const DIFFUSION: u8>(
    model: &Model<D>,
    particles: &Particles<D>,
    records: &SingleRecords,
    group: &NeighbourGroup<'_>,
) -> RateSums<V, D> {
    let quads = const { Place::<D>::quads(DIFFUSION) };
    let record = records.load::<V::Single>(quads, &group.own);
    let own = Partner::<V::Single, D>::of(&record);
    let own_yields = records::scalar(&record, Place::<D>::YIELDING);
    let zero = V::Single::splat(0.0);
    let none = zero_tensor::<V::Single, D>();
    let (mut coupling, mut gradient) = (V::splat(0.0), zero_tensor::<V, D>());
    let mut diffused = Diffusion::<V, D>::none();
    let (mut part_coupling, mut part_gradient) = (zero, none);
    let mut part_diffusion = Diffusion::<V::Single, D>::none();
    let mut field = FieldSums::<V>::none();
    let (mut part_taken, mut part_weights) = (zero, zero);
    let mut near = Near::<V::Single, D>::none();
    let mut chunks = group.flow;
    while !chunks.is_empty() {
        let part = chunks.take_first(PART);
        nearness(&model.kernel, records, quads, &own.position, part, &mut near);
        for (slot, b) in part.enumerate() {
            let Near { r, weight, .. } = near[slot & (PART - 1)];
            let record = records.load::<V::Single>(quads, &b);
            let other = Partner::<V::Single, D>::of(&record);
            if DIFFUSION == diffusion::FIELD {
                part_taken = part_taken + weight * records::scalar(&record, Place::<D>::FIELD);
                part_weights = part_weights + weight;
            }
            if DIFFUSION != diffusion::NONE {
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
        if DIFFUSION == diffusion::FIELD {
            field.add_flow_sums(V::widen(part_taken), V::widen(part_weights));
            (part_taken, part_weights) = (zero, zero);
        }
        if DIFFUSION != diffusion::NONE {
            flush(&mut diffused.pressures, &mut part_diffusion.pressures);
            flush_tensor(&mut diffused.stresses, &mut part_diffusion.stresses);
        }
    }
    let (wall_gradient, wall_compression) =
        wall_sums::<V, D, DIFFUSION>((model, particles), records, quads, group, &own, &mut field);
    let compression = continuity::compression(&gradient) + wall_compression;
    for i in 0..D {
        accumulate(&mut gradient[i], V::splat(1.0), &wall_gradient[i]);
    }
    let mut stress_diffusion = zero_tensor::<V, D>();
    if DIFFUSION != diffusion::NONE {
        let own_stress = records::deviator::<V::Single, D>(&record, Place::<D>::YIELDING + 1);
        let pressure = V::widen(own.pressure);
        for i in 0..D - 1 {
            for j in i..D {
                stress_diffusion[i][j] =
                    diffused.pressures * V::widen(own_stress[i][j]) - pressure * diffused.stresses[i][j];
            }
        }
        stress_diffusion::complete(&mut stress_diffusion);
    }
    RateSums { compression, wall_compression, coupling, gradient, wall_gradient, stress_diffusion, field }
}

/// What walls have of the velocity gradient and of −∇·v, before the correction, and what they take of a field.
#[inline(always)]
fn wall_sums<V: Lanes, const D: usize, const DIFFUSION: u8>(
    (model, particles): (&Model<D>, &Particles<D>),
    records: &SingleRecords,
    quads: usize,
    group: &NeighbourGroup<'_>,
    own: &Partner<V::Single, D>,
    field: &mut FieldSums<V>,
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
            if DIFFUSION == diffusion::FIELD {
                let places = w.places_from(particles.flow_count());
                let places = places.indices();
                let normal = gather_vectors::<V, D>(&particles.walls.normal, &places);
                let depth: V = gather(&particles.walls.depth, &places);
                let smoothness: V = gather(&particles.walls.smoothness, &places);
                let mut apart = normal;
                for i in 0..D {
                    apart[i] = V::widen(r[i]);
                }
                let factor = field_diffusion::wall_factor(&apart, &normal, depth, smoothness, model.spacing);
                field.add_wall(V::widen(weight), factor);
            }
        }
        flush_tensor(&mut gradient, &mut part_gradient);
        flush(&mut compression, &mut part_compression);
    }
    (gradient, compression)
}
