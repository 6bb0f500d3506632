//! Continuity (3)(7) with the density–pressure coupling (27), the corrected velocity gradient (9), and, since all
//! it needs is then at hand, the new stress of each particle.

use super::exchange::{Exchange, Inputs, Numbers};
use super::field_diffusion::FieldDiffusion;
use super::layout::Continuity;
use super::new_state::{Advance, Eight, Extremes, Output, RateSums};
use super::pair_weights::{Weighing, Weights, flush, flush_tensor};
use super::pore_pressure::{self, PorePressure};
use super::precision::Precision;
use super::records::{self, LaneRecord, Records};
use super::stress_ratio::{self, StressRatio};
use crate::lanes::algebra::{accumulate, accumulate_outer, difference, dot, load, sum_of, zero_tensor};
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes, Real};
use crate::parallel::prelude::*;
use crate::weakly_compressible::energy::StressWork;
use crate::weakly_compressible::terms::{continuity, density_coupling};
use crate::weakly_compressible::{BLOCK, GradientUse, Model, NeighbourGroup, PairData, PairDiffusion, Particles};

/// Fields that are read of a particle, whatever is exchanged.
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
            velocity: records::vector(record, Continuity::<P, D>::VELOCITY),
            pressure: records::scalar(record, Continuity::<P, D>::PRESSURE),
            pressure_gradient: records::vector(record, Continuity::<P, D>::GRADIENT),
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
    let shared_pairs = &*pairs;
    let mut density = std::mem::take(&mut particles.density);
    let mut velocity_gradient = std::mem::take(&mut particles.velocity_gradient);
    let mut stress = std::mem::take(&mut particles.stress);
    let mut viscosity = std::mem::take(&mut particles.viscosity);
    let mut artificial_viscosity = std::mem::take(&mut particles.artificial_viscosity);
    let mut field = std::mem::take(&mut particles.field);
    let mut memory = std::mem::take(&mut particles.memory);
    let shared = &*particles;
    let extremes = (
        density[..flow].par_chunks_mut(BLOCK),
        velocity_gradient[..flow].par_chunks_mut(BLOCK),
        stress[..flow].par_chunks_mut(BLOCK),
        viscosity[..flow].par_chunks_mut(BLOCK),
        artificial_viscosity[..flow].par_chunks_mut(BLOCK),
        (
            field.as_mut().map(|field| field[..flow].par_chunks_mut(BLOCK)),
            memory.as_mut().map(|memory| memory[..flow].par_chunks_mut(BLOCK)),
        )
            .into_items(),
        &mut energy,
    )
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
    let exchanged = model.pair_diffusion();
    let values = if in_full { Continuity::<P, D>::values(exchanged) } else { Continuity::<P, D>::PRESSURE };
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
        match exchanged {
            PairDiffusion::None => {}
            PairDiffusion::StressRatio => stress_ratio::write(model, particles, index, record),
            PairDiffusion::Field => {
                stress_ratio::write(model, particles, index, record);
                record.scalar(particles.kept(index).value);
            }
            PairDiffusion::PorePressure => pore_pressure::write(model, particles, index, record),
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
                sums.exchanged.field.eigenvalue = load::<V>(&pairs.eigenvalues[first..last]);
            }
            let end = (offset + LANES).min(count);
            let places = offset..end;
            Eight { advance, places, sums, out: &mut out, work: &mut work, extremes: &mut *extremes }.step();
            offset = end;
        }
        work.add_to(out.energy);
    }
}

/// Pair sums of a group, whatever is exchanged.
#[inline(always)]
fn sums_of<V: Lanes, P: Precision, const D: usize>(
    inputs: Inputs<'_, D>,
    records: &Records<P>,
    weights: &[Weights<P>],
) -> RateSums<V, D> {
    match inputs.model.pair_diffusion() {
        PairDiffusion::None => pair_sums::<V, P, D, ()>(inputs, records, weights),
        PairDiffusion::StressRatio => pair_sums::<V, P, D, StressRatio<V, P, D>>(inputs, records, weights),
        PairDiffusion::Field => pair_sums::<V, P, D, FieldDiffusion<V, P, D>>(inputs, records, weights),
        PairDiffusion::PorePressure => pair_sums::<V, P, D, PorePressure<V, P>>(inputs, records, weights),
    }
}

#[inline(always)]
fn pair_sums<V: Lanes, P: Precision, const D: usize, X: Exchange<V, P, D>>(
    inputs: Inputs<'_, D>,
    records: &Records<P>,
    weights: &[Weights<P>],
) -> RateSums<V, D> {
    let Inputs { model, group, .. } = inputs;
    let quads = const { Continuity::<P, D>::values(X::KIND).div_ceil(4) };
    let record = records.load::<V>(quads, &group.own);
    let own = Partner::of::<P>(&record);
    let mut exchange = X::around(&record, own.pressure);
    let weighing = Weighing::<P, V, D> { kernel: &model.kernel, records, quads, place: own.position };
    let (flow_weights, wall_weights) = weights.split_at(group.flow.len().min(weights.len()));
    let mut sums = RateSums::<V, D>::none();
    let mut part_gradient = zero_tensor::<Numbers<P, V>, D>();
    let (mut part_coupling, mut part_compression) = (Numbers::<P, V>::splat(0.0), Numbers::<P, V>::splat(0.0));
    let mut pairs = weighing.pairs(group.flow, flow_weights);
    while let Some(pairs) = pairs.next() {
        for (b, weight) in pairs {
            let record = records.load::<V>(quads, &b);
            let other = Partner::of::<P>(&record);
            let r = records.apart::<V, D>(&own.position, &other.position);
            let weight = Numbers::<P, V>::load(weight);
            exchange.add(weight, &record, other.pressure);
            let sum = sum_of(&own.pressure_gradient, &other.pressure_gradient);
            let bracket = density_coupling::bracket(own.pressure - other.pressure, &sum, &r);
            part_coupling = part_coupling + weight * bracket;
            accumulate_outer(&mut part_gradient, weight, &difference(&other.velocity, &own.velocity), &r);
        }
        flush::<V, P>(&mut sums.coupling, &mut part_coupling);
        flush_tensor::<V, P, D>(&mut sums.gradient, &mut part_gradient);
        exchange.flush();
    }
    let mut walls = weighing.pairs(group.wall, wall_weights);
    while let Some(walls) = walls.next() {
        for (w, weight) in walls {
            let first = const { Continuity::<P, D>::EXCHANGED.div_ceil(4) };
            let wall = Partner::of::<P>(&records.load_start::<V>(quads, first, &w));
            let r = records.apart::<V, D>(&own.position, &wall.position);
            let weight = Numbers::<P, V>::load(weight);
            accumulate_outer(&mut part_gradient, weight, &difference(&wall.velocity, &own.velocity), &r);
            let sliding = difference(&own.velocity, &wall.pressure_gradient);
            part_compression = part_compression + weight * dot(&sliding, &r);
            exchange.add_wall(&inputs, &w, P::widen(weight), &r);
        }
        flush_tensor::<V, P, D>(&mut sums.wall_gradient, &mut part_gradient);
        flush::<V, P>(&mut sums.wall_compression, &mut part_compression);
    }
    sums.compression = continuity::compression(&sums.gradient) + sums.wall_compression;
    for i in 0..D {
        accumulate(&mut sums.gradient[i], V::splat(1.0), &sums.wall_gradient[i]);
    }
    sums.exchanged = exchange.sums();
    sums
}

/// Pair sums where the density alone is updated, in double precision.
#[inline(always)]
fn divergence_only<V: Lanes, const D: usize>(
    records: &Records,
    group: &NeighbourGroup<'_>,
    weights: &[Weights<f64>],
) -> RateSums<V, D> {
    let (quads, velocity) = const { (Continuity::<f64, D>::PRESSURE.div_ceil(4), Continuity::<f64, D>::VELOCITY) };
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
