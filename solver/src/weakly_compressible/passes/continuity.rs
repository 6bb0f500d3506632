//! Continuity (3)(7) with the density–pressure coupling (27), the corrected velocity gradient (9), and, since all
//! it needs is then at hand, the new stress of each particle.

use super::PairData;
use super::new_state::{Advance, Extremes, Output, RateSums};
use super::pair_weights::{Weighing, Weights, flush, flush_tensor, widened};
use super::precision::Precision;
use super::records::{self, LaneRecord, Records};
use crate::lanes::algebra::{accumulate, accumulate_outer, difference, dot, load, sum_of};
use crate::lanes::{LANES, LanePass, Lanes, Real, gather, gather_vectors};
use crate::material::rheology::field::Memory;
use crate::parallel::prelude::*;
use crate::vector::equivalent_shear_stress;
use crate::weakly_compressible::energy::StressWork;
use crate::weakly_compressible::model::{GradientUse, Model, PairDiffusion};
use crate::weakly_compressible::neighbours::{BLOCK, NeighbourGroup};
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{continuity, density_coupling, field_diffusion, stress_diffusion};
use std::marker::PhantomData;

/// Quantities that diffuse among pairs, as a constant of the loops. The field diffuses beside the stress ratio.
const NONE: u8 = PairDiffusion::None as u8;
const STRESS_RATIO: u8 = PairDiffusion::StressRatio as u8;
const FIELD: u8 = PairDiffusion::Field as u8;
const PORE_PRESSURE: u8 = PairDiffusion::PorePressure as u8;

/// Places in a record, which begins with a position and, where weights are computed anew, a volume.
struct Place<P, const D: usize>(PhantomData<P>);

impl<P: Precision, const D: usize> Place<P, D> {
    const VELOCITY: usize = D + P::VOLUMES;
    /// Behind it is what the density alone does not take.
    const PRESSURE: usize = Self::VELOCITY + D;
    /// Corrected pressure gradient; of a wall particle the velocity that the continuity of a liquid takes.
    const GRADIENT: usize = Self::PRESSURE + 1;
    /// Yielding share of the particle `[-]`, followed by s: inputs of the stress-ratio diffusion.
    const YIELDING: usize = Self::GRADIENT + D;
    /// The law's field, if it diffuses.
    const FIELD: usize = Self::YIELDING + 1 + records::deviator_values(D);

    const fn values(diffusion: u8) -> usize {
        match diffusion {
            STRESS_RATIO => Self::FIELD,
            FIELD => Self::FIELD + 1,
            PORE_PRESSURE => Self::YIELDING + 2,
            _ => Self::YIELDING,
        }
    }
}

/// Fields that are read of a particle, whichever quantity diffuses.
struct Partner<V, const D: usize> {
    position: [V; D],
    velocity: [V; D],
    pressure: V,
    pressure_gradient: [V; D],
}

impl<V: Real, const D: usize> Partner<V, D> {
    #[inline(always)]
    fn of<P: Precision>(record: &LaneRecord<V>) -> Self {
        Self {
            position: records::vector(record, 0),
            velocity: records::vector(record, Place::<P, D>::VELOCITY),
            pressure: records::scalar(record, Place::<P, D>::PRESSURE),
            pressure_gradient: records::vector(record, Place::<P, D>::GRADIENT),
        }
    }
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
        fill(model, particles, &mut pairs.single, true);
    } else {
        fill(model, particles, &mut pairs.continuity, gradient != GradientUse::None);
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

/// Records of flow and walls, or unless `in_full` only the first part of them.
fn fill<P: Precision, const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    records: &mut Records<P>,
    in_full: bool,
) {
    let diffusion = model.pair_diffusion();
    let values = if in_full { Place::<P, D>::values(diffusion as u8) } else { Place::<P, D>::PRESSURE };
    records.fill(particles.position.len(), values, model.kernel.smoothing_length(), |index, record| {
        record.position(&particles.position[index]);
        if P::SINGLE {
            record.scalar(particles.volume[index]);
        }
        record.vector(&particles.velocity[index]);
        if !in_full {
            return;
        }
        let pressure = particles.pressure[index];
        record.scalar(pressure);
        let wall = particles.is_wall(index);
        record.vector(if wall {
            &particles.walls.sliding_velocity[index - particles.flow_count()]
        } else {
            &particles.pressure_gradient[index]
        });
        if diffusion == PairDiffusion::PorePressure {
            let kept = particles.kept(index);
            record.scalar(kept.value);
            record.scalar(model.relative_conductivity(kept.memory[0]));
        } else if diffusion != PairDiffusion::None {
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
        let in_single = advance.model.pairs_in_single();
        let meets_surface = advance.model.field_meets_surface();
        let mut offset = 0;
        while offset < count {
            let group = advance.model.list.group((advance.block_start + offset) / LANES);
            let inputs = Inputs { model: advance.model, particles: advance.particles, group };
            let mut sums = if in_single {
                sums_of::<V, f32, D>(inputs, &pairs.single, &[])
            } else if advance.gradient == GradientUse::None {
                divergence_only(&pairs.continuity, &group, &pairs.weights[group.first_pair..])
            } else {
                sums_of::<V, f64, D>(inputs, &pairs.continuity, &pairs.weights[group.first_pair..])
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

/// Inputs of the loops over neighbours beside their records.
#[derive(Clone, Copy)]
struct Inputs<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    group: NeighbourGroup<'a>,
}

/// Pair sums of a group, whatever diffuses.
#[inline(always)]
fn sums_of<V: Lanes, P: Precision, const D: usize>(
    inputs: Inputs<'_, D>,
    records: &Records<P>,
    weights: &[Weights<P>],
) -> RateSums<V, D> {
    match inputs.model.pair_diffusion() {
        PairDiffusion::None => pair_sums::<V, P, D, NONE>(inputs, records, weights),
        PairDiffusion::StressRatio => pair_sums::<V, P, D, STRESS_RATIO>(inputs, records, weights),
        PairDiffusion::Field => pair_sums::<V, P, D, FIELD>(inputs, records, weights),
        PairDiffusion::PorePressure => pair_sums::<V, P, D, PORE_PRESSURE>(inputs, records, weights),
    }
}

#[inline(always)]
fn pair_sums<V: Lanes, P: Precision, const D: usize, const DIFFUSION: u8>(
    Inputs { model, particles, group }: Inputs<'_, D>,
    records: &Records<P>,
    weights: &[Weights<P>],
) -> RateSums<V, D> {
    let quads = const { Place::<P, D>::values(DIFFUSION).div_ceil(4) };
    let record = records.load::<V>(quads, &group.own);
    let own = Partner::of::<P>(&record);
    let own_yields = records::scalar(&record, Place::<P, D>::YIELDING);
    // of a pore liquid these two places have its pressure and conductivity
    let own_conductivity = records::scalar(&record, Place::<P, D>::YIELDING + 1);
    let own_stress: [[_; D]; D] = records::deviator(&record, Place::<P, D>::YIELDING + 1);
    let weighing = Weighing::<P, V, D> { kernel: &model.kernel, records, quads, place: own.position };
    let (flow_weights, wall_weights) = weights.split_at(group.flow.len().min(weights.len()));
    let (mut sums, mut part) = (RateSums::<V, D>::none(), RateSums::<P::Lanes<V>, D>::none());
    // Σ f p_b of the stress ratio's diffusion
    let (mut pressures, mut part_pressures) = (V::splat(0.0), P::Lanes::<V>::splat(0.0));
    let mut pairs = weighing.pairs(group.flow, flow_weights);
    while let Some(pairs) = pairs.next() {
        for (b, weight) in pairs {
            let record = records.load::<V>(quads, &b);
            let other = Partner::of::<P>(&record);
            let r = records.apart::<V, D>(&own.position, &other.position);
            let weight = P::load::<V>(weight);
            if DIFFUSION == FIELD {
                part.field.taken = part.field.taken + weight * records::scalar(&record, Place::<P, D>::FIELD);
                part.field.weights = part.field.weights + weight;
            }
            if DIFFUSION == PORE_PRESSURE {
                let conductivity = records::scalar(&record, Place::<P, D>::YIELDING + 1);
                let mean = field_diffusion::mean_conductivity(own_conductivity, conductivity);
                let difference = records::scalar(&record, Place::<P, D>::YIELDING) - own_yields;
                part.field.taken = part.field.taken + weight * mean * difference;
                part.field.weights = part.field.weights + weight;
            }
            if DIFFUSION == STRESS_RATIO || DIFFUSION == FIELD {
                let yields = records::scalar(&record, Place::<P, D>::YIELDING);
                let stress = records::deviator(&record, Place::<P, D>::YIELDING + 1);
                let pressure_sum = own.pressure + other.pressure;
                let factor = weight * stress_diffusion::pair_factor(own_yields, yields, pressure_sum);
                let sum = &mut part.stress_diffusion;
                if P::SINGLE {
                    part_pressures = part_pressures + factor * other.pressure;
                    stress_diffusion::accumulate_stress(sum, factor, &stress);
                } else {
                    let (of_a, of_b) = ((&own_stress, own.pressure), (&stress, other.pressure));
                    stress_diffusion::accumulate_bracket(sum, factor, of_a, of_b);
                }
            }
            let sum = sum_of(&own.pressure_gradient, &other.pressure_gradient);
            let bracket = density_coupling::bracket(own.pressure - other.pressure, &sum, &r);
            part.coupling = part.coupling + weight * bracket;
            accumulate_outer(&mut part.gradient, weight, &difference(&other.velocity, &own.velocity), &r);
        }
        flush::<V, P>(&mut sums.coupling, &mut part.coupling);
        flush_tensor::<V, P, D>(&mut sums.gradient, &mut part.gradient);
        if DIFFUSION == FIELD || DIFFUSION == PORE_PRESSURE {
            flush::<V, P>(&mut sums.field.taken, &mut part.field.taken);
            flush::<V, P>(&mut sums.field.weights, &mut part.field.weights);
        }
        if DIFFUSION == STRESS_RATIO || DIFFUSION == FIELD {
            flush::<V, P>(&mut pressures, &mut part_pressures);
            flush_tensor::<V, P, D>(&mut sums.stress_diffusion, &mut part.stress_diffusion);
        }
    }
    if DIFFUSION == FIELD {
        sums.field.given = sums.field.weights;
    }
    let mut walls = weighing.pairs(group.wall, wall_weights);
    while let Some(walls) = walls.next() {
        for (w, weight) in walls {
            let first = const { Place::<P, D>::YIELDING.div_ceil(4) };
            let wall = Partner::of::<P>(&records.load_start::<V>(quads, first, &w));
            let r = records.apart::<V, D>(&own.position, &wall.position);
            let weight = P::load::<V>(weight);
            accumulate_outer(&mut part.wall_gradient, weight, &difference(&wall.velocity, &own.velocity), &r);
            let sliding = difference(&own.velocity, &wall.pressure_gradient);
            part.wall_compression = part.wall_compression + weight * dot(&sliding, &r);
            if DIFFUSION == PORE_PRESSURE {
                sums.field.weights = sums.field.weights + P::widen::<V>(weight);
            }
            if DIFFUSION == FIELD {
                let places = w.places_from(particles.flow_count());
                let places = places.indices();
                let normal = gather_vectors::<V, D>(&particles.walls.normal, &places);
                let depth: V = gather(&particles.walls.depth, &places);
                let smoothness: V = gather(&particles.walls.smoothness, &places);
                let (weight, r) = (P::widen::<V>(weight), widened::<V, P, D>(&r));
                let factor = field_diffusion::wall_factor(&r, &normal, depth, smoothness, model.spacing);
                sums.field.given = sums.field.given + weight * factor;
                sums.field.weights = sums.field.weights + weight;
            }
        }
        flush_tensor::<V, P, D>(&mut sums.wall_gradient, &mut part.wall_gradient);
        flush::<V, P>(&mut sums.wall_compression, &mut part.wall_compression);
    }
    sums.compression = continuity::compression(&sums.gradient) + sums.wall_compression;
    for i in 0..D {
        accumulate(&mut sums.gradient[i], V::splat(1.0), &sums.wall_gradient[i]);
        if P::SINGLE && (DIFFUSION == STRESS_RATIO || DIFFUSION == FIELD) {
            for j in 0..D {
                let (stress_a, pressure_a) = (P::widen::<V>(own_stress[i][j]), P::widen::<V>(own.pressure));
                sums.stress_diffusion[i][j] = pressures * stress_a - pressure_a * sums.stress_diffusion[i][j];
            }
        }
    }
    stress_diffusion::complete(&mut sums.stress_diffusion);
    sums
}

/// Pair sums where the density alone is updated, in double precision.
#[inline(always)]
fn divergence_only<V: Lanes, const D: usize>(
    records: &Records,
    group: &NeighbourGroup<'_>,
    weights: &[Weights<f64>],
) -> RateSums<V, D> {
    let (quads, velocity) = const { (Place::<f64, D>::PRESSURE.div_ceil(4), Place::<f64, D>::VELOCITY) };
    let own = records.load::<V>(quads, &group.own);
    let (place, velocity_a) = (records::vector(&own, 0), records::vector(&own, velocity));
    let mut sums = RateSums::none();
    for (b, weight) in group.pairs.zip(weights) {
        let other = records.load::<V>(quads, &b);
        let r: [V; D] = difference(&place, &records::vector(&other, 0));
        let slip = difference(&velocity_a, &records::vector(&other, velocity));
        sums.compression = sums.compression + V::load(weight) * dot(&slip, &r);
    }
    sums
}
