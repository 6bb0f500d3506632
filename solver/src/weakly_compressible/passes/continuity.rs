//! Continuity (3)(7) with the density–pressure coupling (27), the corrected velocity gradient (9), and, since all
//! it needs is then at hand, the new stress of each particle.

use super::PairData;
use super::layout;
use super::new_state::{Advance, Extremes, FieldSums, Output, RateSums};
use super::records::{self, LaneRecord};
use super::single;
use crate::lanes::algebra::{accumulate, accumulate_outer, difference, dot, load, sum_of, zero_tensor};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::material::rheology::field::Memory;
use crate::parallel::prelude::*;
use crate::vector::equivalent_shear_stress;
use crate::weakly_compressible::energy::StressWork;
use crate::weakly_compressible::model::{GradientUse, Model, PairDiffusion};
use crate::weakly_compressible::neighbours::{BLOCK, NeighbourGroup};
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{continuity, density_coupling, field_diffusion, stress_diffusion};

/// What diffuses among pairs, as a constant of the loops.
pub(super) mod diffusion {
    pub(in super::super) const NONE: u8 = 0;
    pub(in super::super) const STRESS_RATIO: u8 = 1;
    /// The law's field beside the stress ratio.
    pub(in super::super) const FIELD: u8 = 2;
}

/// Values of a record: [`Partner`], then if they diffuse [`Yielding`] and the law's field.
const fn full_values(dimension: usize, diffusion: u8) -> usize {
    layout::continuity(dimension)
        + match diffusion {
            diffusion::STRESS_RATIO => 1 + records::deviator_values(dimension),
            diffusion::FIELD => 2 + records::deviator_values(dimension),
            _ => 0,
        }
}

/// Values of a record if the density alone is updated: position, velocity.
const fn short_values(dimension: usize) -> usize {
    2 * dimension
}

/// What is read of a flow particle.
struct Partner<V, const D: usize> {
    position: [V; D],
    velocity: [V; D],
    pressure: V,
    /// Corrected pressure gradient; of a wall particle the velocity that the continuity of a liquid takes.
    pressure_gradient: [V; D],
}

impl<V: Lanes, const D: usize> Partner<V, D> {
    #[inline(always)]
    fn of(record: &LaneRecord<V>) -> Self {
        Self {
            position: records::vector(record, 0),
            velocity: records::vector(record, D),
            pressure: records::scalar(record, 2 * D),
            pressure_gradient: records::vector(record, 2 * D + 1),
        }
    }
}

/// What the diffusion of the stress ratio reads beside it.
struct Yielding<V, const D: usize> {
    /// What of the particle yields `[-]`.
    part: V,
    /// Upper triangle of s `[Pa]`.
    stress: [[V; D]; D],
}

impl<V: Lanes, const D: usize> Yielding<V, D> {
    #[inline(always)]
    fn of(record: &LaneRecord<V>) -> Self {
        Self {
            part: records::scalar(record, layout::continuity(D)),
            stress: records::deviator(record, layout::continuity(D) + 1),
        }
    }
}

/// Quads of a record of continuity.
#[inline(always)]
const fn quads(dimension: usize, diffusion: u8) -> usize {
    full_values(dimension, diffusion).div_ceil(4)
}

/// Advances density, velocity gradient and stress of the flow particles by one time step `[s]`.
pub(crate) fn run<const D: usize>(
    model: &Model<D>,
    particles: &mut Particles<D>,
    pairs: &mut PairData<D>,
    time_step: f64,
) -> Extremes {
    let flow = particles.flow_count();
    let gradient = model.gradient_use();
    if model.pairs_in_single() {
        single::continuity::fill(model, particles, &mut pairs.single);
    } else {
        fill_records(model, particles, pairs, gradient);
    }
    pairs.open_ledger(flow);
    let mut energy = std::mem::take(&mut pairs.energy);
    let mut no_field = std::mem::take(&mut pairs.no_field);
    let mut no_memory = std::mem::take(&mut pairs.no_memory);
    let shared_pairs = &*pairs;
    let mut density = std::mem::take(&mut particles.density);
    let mut velocity_gradient = std::mem::take(&mut particles.velocity_gradient);
    let mut stress = std::mem::take(&mut particles.stress);
    let mut viscosity = std::mem::take(&mut particles.viscosity);
    let mut artificial_viscosity = std::mem::take(&mut particles.artificial_viscosity);
    let mut field = std::mem::take(&mut particles.field);
    let mut memory = std::mem::take(&mut particles.memory);
    no_field.resize(flow.div_ceil(BLOCK), 0.0);
    let fields = match &mut field {
        Some(field) => field[..flow].par_chunks_mut(BLOCK),
        None => no_field.par_chunks_mut(1),
    };
    no_memory.resize(flow.div_ceil(BLOCK), Memory::default());
    let memories = match &mut memory {
        Some(memory) => memory[..flow].par_chunks_mut(BLOCK),
        None => no_memory.par_chunks_mut(1),
    };
    let shared = &*particles;
    let extremes = (
        density[..flow].par_chunks_mut(BLOCK),
        velocity_gradient[..flow].par_chunks_mut(BLOCK),
        stress[..flow].par_chunks_mut(BLOCK),
        viscosity[..flow].par_chunks_mut(BLOCK),
        artificial_viscosity[..flow].par_chunks_mut(BLOCK),
        (fields, memories).into_par_iter(),
        &mut energy,
    )
        .into_par_iter()
        .enumerate()
        .with_min_len(4)
        .map(
            |(
                block,
                (density, velocity_gradient, stress, viscosity, artificial_viscosity, (field, memory), energy),
            )| {
                let out = Output {
                    density,
                    velocity_gradient,
                    stress,
                    viscosity,
                    artificial_viscosity,
                    field,
                    memory,
                    energy,
                };
                let advance = Advance { model, particles: shared, gradient, time_step, block_start: block * BLOCK };
                let mut extremes = Extremes::NONE;
                let extremes_of_block = &mut extremes;
                model.instruction_set.run(Pass { advance, pairs: shared_pairs, out, extremes: extremes_of_block });
                extremes
            },
        )
        .reduce(|| Extremes::NONE, Extremes::merge);
    pairs.energy = energy;
    (pairs.no_field, pairs.no_memory) = (no_field, no_memory);
    (particles.field, particles.memory) = (field, memory);
    particles.density = density;
    particles.velocity_gradient = velocity_gradient;
    particles.stress = stress;
    particles.viscosity = viscosity;
    particles.artificial_viscosity = artificial_viscosity;
    extremes
}

/// Records in the layout of [`Partner`] with [`Yielding`] behind it, or the first part of it.
fn fill_records<const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    pairs: &mut PairData<D>,
    gradient: GradientUse,
) {
    let (full, diffusion) = (gradient != GradientUse::None, model.pair_diffusion());
    pairs.continuity.set_values(match (full, diffusion) {
        (false, _) => short_values(D),
        (true, PairDiffusion::None) => full_values(D, diffusion::NONE),
        (true, PairDiffusion::StressRatio) => full_values(D, diffusion::STRESS_RATIO),
        (true, PairDiffusion::Field) => full_values(D, diffusion::FIELD),
    });
    pairs.continuity.fill(particles.position.len(), |index, record| {
        record.vector(&particles.position[index]);
        record.vector(&particles.velocity[index]);
        if full {
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
        }
    });
}

struct Pass<'a, const D: usize> {
    advance: Advance<'a, D>,
    pairs: &'a PairData<D>,
    out: Output<'a, D>,
    extremes: &'a mut Extremes,
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { advance, pairs, mut out, extremes } = self;
        let count = out.density.len();
        let mut work = StressWork::<V>::new();
        let (in_single, diffusion) = (advance.model.pairs_in_single(), advance.model.pair_diffusion());
        let meets_surface = advance.model.field_meets_surface();
        let mut offset = 0;
        while offset < count {
            let group = advance.model.list.group((advance.block_start + offset) / LANES);
            let (model, particles) = (advance.model, advance.particles);
            let mut sums = match (in_single, diffusion) {
                (true, PairDiffusion::StressRatio) => {
                    single::continuity::pair_sums::<V, D, { diffusion::STRESS_RATIO }>(
                        model,
                        particles,
                        &pairs.single,
                        &group,
                    )
                }
                (true, PairDiffusion::Field) => {
                    single::continuity::pair_sums::<V, D, { diffusion::FIELD }>(model, particles, &pairs.single, &group)
                }
                (true, PairDiffusion::None) => {
                    single::continuity::pair_sums::<V, D, { diffusion::NONE }>(model, particles, &pairs.single, &group)
                }
                (false, _) if advance.gradient == GradientUse::None => divergence_only::<V, D>(pairs, &group),
                (false, PairDiffusion::StressRatio) => {
                    all_sums::<V, D, { diffusion::STRESS_RATIO }>(model, particles, pairs, &group)
                }
                (false, PairDiffusion::Field) => {
                    all_sums::<V, D, { diffusion::FIELD }>(model, particles, pairs, &group)
                }
                (false, PairDiffusion::None) => all_sums::<V, D, { diffusion::NONE }>(model, particles, pairs, &group),
            };
            if meets_surface {
                let first = advance.block_start + offset;
                let last = (first + LANES).min(advance.block_start + count);
                sums.field.eigenvalue = load::<V>(&pairs.eigenvalues[first..last]);
            }
            let end = (offset + LANES).min(count);
            advance.particles_at(offset..end, &sums, &mut out, &mut work, extremes);
            offset = end;
        }
        work.add_to(out.energy);
    }
}

#[inline(always)]
fn all_sums<V: Lanes, const D: usize, const DIFFUSION: u8>(
    model: &Model<D>,
    particles: &Particles<D>,
    pairs: &PairData<D>,
    group: &NeighbourGroup<'_>,
) -> RateSums<V, D> {
    let all = &pairs.continuity;
    let quads = const { quads(D, DIFFUSION) };
    let record = all.load::<V>(quads, &group.own);
    let own = Partner::<V, D>::of(&record);
    let own_yielding = Yielding::<V, D>::of(&record);
    let mut coupling = V::splat(0.0);
    let (mut gradient, mut wall_gradient) = (zero_tensor::<V, D>(), zero_tensor::<V, D>());
    let mut wall_compression = V::splat(0.0);
    let mut diffused = zero_tensor::<V, D>();
    let mut field = FieldSums::none();
    let (flow_weights, wall_weights) = pairs.weights[group.first_pair..].split_at(group.flow.len());
    for (b, weight) in group.flow.zip(flow_weights) {
        let record = all.load::<V>(quads, &b);
        let other = Partner::<V, D>::of(&record);
        let r = difference(&own.position, &other.position);
        let weight = V::load(weight);
        if DIFFUSION == diffusion::FIELD {
            field.add_flow(weight, records::scalar(&record, const { full_values(D, diffusion::STRESS_RATIO) }));
        }
        if DIFFUSION != diffusion::NONE {
            let yielding = Yielding::<V, D>::of(&record);
            let pressure_sum = own.pressure + other.pressure;
            let factor = stress_diffusion::pair_factor(own_yielding.part, yielding.part, pressure_sum);
            stress_diffusion::accumulate_bracket(
                &mut diffused,
                weight * factor,
                (&own_yielding.stress, own.pressure),
                (&yielding.stress, other.pressure),
            );
        }
        let sum = sum_of(&own.pressure_gradient, &other.pressure_gradient);
        coupling = coupling + weight * density_coupling::bracket(own.pressure - other.pressure, &sum, &r);
        accumulate_outer(&mut gradient, weight, &difference(&other.velocity, &own.velocity), &r);
    }
    for (w, weight) in group.wall.zip(wall_weights) {
        let record = all.load_start::<V>(quads, const { layout::continuity(D).div_ceil(4) }, &w);
        let wall = Partner::<V, D>::of(&record);
        let r = difference(&own.position, &wall.position);
        let weight = V::load(weight);
        accumulate_outer(&mut wall_gradient, weight, &difference(&wall.velocity, &own.velocity), &r);
        let sliding = difference(&own.velocity, &wall.pressure_gradient);
        wall_compression = wall_compression + weight * dot(&sliding, &r);
        if DIFFUSION == diffusion::FIELD {
            let places = w.places_from(particles.flow_count());
            let places = places.indices();
            let normal = gather_vectors::<V, D>(&particles.walls.normal, &places);
            let depth: V = gather(&particles.walls.depth, &places);
            let smoothness: V = gather(&particles.walls.smoothness, &places);
            field.add_wall(weight, field_diffusion::wall_factor(&r, &normal, depth, smoothness, model.spacing));
        }
    }
    let compression = continuity::compression(&gradient) + wall_compression;
    for i in 0..D {
        accumulate(&mut gradient[i], V::splat(1.0), &wall_gradient[i]);
    }
    stress_diffusion::complete(&mut diffused);
    RateSums { compression, wall_compression, coupling, gradient, wall_gradient, stress_diffusion: diffused, field }
}

#[inline(always)]
fn divergence_only<V: Lanes, const D: usize>(pairs: &PairData<D>, group: &NeighbourGroup<'_>) -> RateSums<V, D> {
    let all = &pairs.continuity;
    let own = all.load::<V>(const { short_values(D).div_ceil(4) }, &group.own);
    let place = records::vector::<V, D>(&own, 0);
    let velocity_a = records::vector::<V, D>(&own, D);
    let mut compression = V::splat(0.0);
    for (b, weight) in group.pairs.zip(&pairs.weights[group.first_pair..]) {
        let record = all.load::<V>(const { short_values(D).div_ceil(4) }, &b);
        let position = records::vector::<V, D>(&record, 0);
        let velocity = records::vector::<V, D>(&record, D);
        let r = difference(&place, &position);
        compression = compression + V::load(weight) * dot(&difference(&velocity_a, &velocity), &r);
    }
    let (zero, none) = (V::splat(0.0), zero_tensor());
    RateSums {
        compression,
        wall_compression: zero,
        coupling: zero,
        gradient: none,
        wall_gradient: none,
        stress_diffusion: none,
        field: FieldSums::none(),
    }
}
