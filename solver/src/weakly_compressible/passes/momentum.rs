//! The momentum equation with the single divergence: a_a = g + [Σ V_b F traction]/ρ_a + artificial viscosity (15) +
//! hourglass control, and the artificial stress of soil that holds together, each a term of its own, in one loop over flow and wall
//! partners.

use super::flow_partner::{Constants, FlowPartner};
use super::layout::Momentum;
use super::pair_weights::{Weighing, Weights, flush_vector};
use super::precision::Precision;
use super::records::Records;
use super::wall_partner::{WallGroup, WallPair};
use crate::lanes::algebra::{accumulate, difference, dot, load, store_vector, zero_vector};
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes, Real};
use crate::parallel::prelude::*;
use crate::vector::{Vector, shear_rate};
use crate::weakly_compressible::terms::{artificial_viscosity, hourglass, pair_distance, stress_divergence};
use crate::weakly_compressible::wall_fields::mirrored_lanes;
use crate::weakly_compressible::{BLOCK, Model, NeighbourGroup, PairData, Particles, ViscositySwitch};
use std::ops::Range;

/// Records of flow and walls in the layout of [`Momentum`].
fn fill<P: Precision, const D: usize>(model: &Model<D>, particles: &Particles<D>, records: &mut Records<P>) {
    let inverse_density = 1.0 / model.equation_of_state.reference_density;
    let grains = model.rheology.strength_is_friction() && model.field_diffusion().is_none();
    let (count, values) = (particles.position.len(), Momentum::<P, D>::VALUES);
    records.fill(count, values, model.kernel.smoothing_length(), |index, record| {
        let wall = particles.is_wall(index).then(|| index - particles.flow_count());
        let walls = &particles.walls;
        record.position(&particles.position[index]);
        if P::SINGLE {
            record.scalar(particles.volume[index]);
        }
        record.scalar(wall.map_or(particles.density[index], |wall| walls.depth[wall]));
        record.vector(wall.map_or(&particles.velocity[index], |wall| &walls.velocity[wall]));
        let speed = hourglass::pressure_speed(particles.pressure[index], inverse_density);
        record.scalar(if grains && wall.is_none() {
            speed * hourglass::share(shear_rate(&particles.velocity_gradient[index]) * model.spacing, speed)
        } else {
            speed
        });
        record.tensor(&particles.corrected_stress[index]);
        match wall {
            Some(wall) => {
                record.vector(&walls.normal[wall]);
                record.scalar(walls.smoothness[wall]);
            }
            None if P::SINGLE => record.half_form(&particles.velocity_gradient[index]),
            None => {
                record.tensor(&particles.velocity_gradient[index]);
                record.scalar(particles.artificial_viscosity[index]);
            }
        }
    });
}

/// Accelerations `[m/s²]` of the flow particles, and what walls and mirrors have of it.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let shared = &*particles;
    if model.pairs_in_single() {
        fill(model, shared, &mut pairs.single);
    } else {
        fill(model, shared, &mut pairs.momentum);
    }
    let pairs = &*pairs;
    let mut acceleration = std::mem::take(&mut particles.acceleration);
    let mut support = std::mem::take(&mut particles.support);
    let mut by_walls = std::mem::take(&mut particles.by_walls);
    let mut by_damping = std::mem::take(&mut particles.by_damping);
    let mut by_wall_control = std::mem::take(&mut particles.by_wall_control);
    let shared = &*particles;
    (
        acceleration.par_chunks_mut(BLOCK),
        support.par_chunks_mut(BLOCK),
        by_walls.par_chunks_mut(BLOCK),
        by_damping.par_chunks_mut(BLOCK),
        by_wall_control.par_chunks_mut(BLOCK),
    )
        .enumerate()
        .with_min_len(4)
        .for_each(|(block, (acceleration, support, by_walls, by_damping, by_wall_control))| {
            let out = Output { acceleration, support, by_walls, by_damping, by_wall_control };
            model.instruction_set.run(Pass { model, particles: shared, pairs, block, out });
        });
    particles.acceleration = acceleration;
    particles.support = support;
    particles.by_walls = by_walls;
    particles.by_damping = by_damping;
    particles.by_wall_control = by_wall_control;
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    pairs: &'a PairData<D>,
    block: usize,
    out: Output<'a, D>,
}

/// Accelerations `[m/s²]`: all, what walls and mirrors cause, and for the energy ledger the parts that do not come from
/// the stress of the flow.
struct Output<'a, const D: usize> {
    acceleration: &'a mut [Vector<D>],
    support: &'a mut [Vector<D>],
    by_walls: &'a mut [Vector<D>],
    by_damping: &'a mut [Vector<D>],
    by_wall_control: &'a mut [Vector<D>],
}

/// The pair sums of eight particles with the flow, images included, the part of them that images behind mirrors cause,
/// and the pair sums with walls.
struct Forces<V, const D: usize> {
    /// Σ V F traction `[N/m³]`.
    divergence: [V; D],
    /// Artificial viscosity, artificial stress and hourglass control `[m/s²]`.
    damping: [V; D],
    mirror_divergence: [V; D],
    mirror_damping: [V; D],
    wall_divergence: [V; D],
    wall_control: [V; D],
}

impl<V: Real, const D: usize> Forces<V, D> {
    #[inline(always)]
    fn none() -> Self {
        let none = zero_vector::<V, D>();
        Self {
            divergence: none,
            damping: none,
            mirror_divergence: none,
            mirror_damping: none,
            wall_divergence: none,
            wall_control: none,
        }
    }

    /// Adds a part of the damping, and if images are about to that of mirrors.
    #[inline(always)]
    fn damp(&mut self, mirrored: Option<V>, factor: V, direction: &[V; D]) {
        accumulate(&mut self.damping, factor, direction);
        if let Some(mirrored) = mirrored {
            accumulate(&mut self.mirror_damping, mirrored * factor, direction);
        }
    }
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, pairs, block, out } = self;
        let constants = Constants::of(model);
        let count = out.acceleration.len();
        for offset in 0..count.div_ceil(LANES) {
            let group = model.list.group(block * (BLOCK / LANES) + offset);
            let places = offset * LANES..(offset * LANES + LANES).min(count);
            let first = block * BLOCK + places.start;
            let here = first..first + places.len();
            let inputs = Inputs { model, constants: &constants, particles, group, here: here.clone() };
            let forces: Forces<V, D> = if model.pairs_in_single() {
                pair_sums(inputs, &pairs.single, &[])
            } else {
                pair_sums(inputs, &pairs.momentum, &pairs.weights[group.first_pair..])
            };
            let density = load::<V>(&particles.density[here]);
            let (mut total, mut supported, mut by_walls) = (forces.damping, forces.damping, forces.damping);
            for i in 0..D {
                by_walls[i] = forces.wall_divergence[i] / density;
                let from_walls = by_walls[i] + forces.wall_control[i];
                total[i] = forces.divergence[i] / density + forces.damping[i] + from_walls + V::splat(model.gravity[i]);
                supported[i] = forces.mirror_divergence[i] / density + forces.mirror_damping[i] + from_walls;
            }
            store_vector(&total, &mut out.acceleration[places.clone()]);
            store_vector(&supported, &mut out.support[places.clone()]);
            store_vector(&by_walls, &mut out.by_walls[places.clone()]);
            store_vector(&forces.damping, &mut out.by_damping[places.clone()]);
            store_vector(&forces.wall_control, &mut out.by_wall_control[places]);
        }
    }
}

/// Inputs of the loops over neighbours beside their records.
struct Inputs<'a, const D: usize> {
    model: &'a Model<D>,
    constants: &'a Constants,
    particles: &'a Particles<D>,
    group: NeighbourGroup<'a>,
    /// Places of the group's particles.
    here: Range<usize>,
}

#[inline(always)]
fn pair_sums<V: Lanes, P: Precision, const D: usize>(
    Inputs { model, constants, particles, group, here }: Inputs<'_, D>,
    records: &Records<P>,
    weights: &[Weights<P>],
) -> Forces<V, D> {
    let (quads, half) = (const { Momentum::<P, D>::QUADS }, P::Lanes::<V>::splat(0.5));
    let regularisation = P::Lanes::<V>::splat(pair_distance::regularisation(constants.smoothing_length));
    let own = FlowPartner::of::<P>(&records.load::<V>(quads, &group.own));
    let weighing = Weighing::<P, V, D> { kernel: &model.kernel, records, quads, place: own.position };
    let (flow_weights, wall_weights) = weights.split_at(group.flow.len().min(weights.len()));
    let (mut forces, mut part) = (Forces::none(), Forces::<P::Lanes<V>, D>::none());
    let mut pairs = weighing.pairs(group.flow, flow_weights);
    while let Some(pairs) = pairs.next() {
        for (b, weight) in pairs {
            let other = FlowPartner::of::<P>(&records.load::<V>(quads, &b));
            let r = records.apart::<V, D>(&own.position, &other.position);
            let slip = difference(&own.velocity, &other.velocity);
            let weight = P::Lanes::<V>::load(weight);
            let (square, approach) = (dot(&r, &r), dot(&r, &slip));
            let regular = square + regularisation;
            let density_sum = own.density + other.density;
            // one division serves 1/(ρ̄ r²) of (15), 2/(ρ_a + ρ_b) of the hourglass control and 1/r² of its half form
            let inverse = P::Lanes::<V>::splat(2.0) / (density_sum * regular);
            let alpha = match constants.viscosity_switch {
                ViscositySwitch::MorrisMonaghan if !P::SINGLE => {
                    artificial_viscosity::mean_strength(own.alpha, other.alpha, constants.speed_length)
                }
                _ => P::Lanes::<V>::splat(constants.artificial_viscosity * constants.speed_length),
            };
            let traction = stress_divergence::traction(&own.corrected_stress, &other.corrected_stress, &r);
            let speed_sum = own.pressure_speed + other.pressure_speed;
            let drag = hourglass::twice_viscosity(constants.hourglass_strength, speed_sum) * (inverse * regular);
            let mass_weight = weight * other.density;
            let mut mirrored = None;
            accumulate(&mut part.divergence, weight, &traction);
            if group.has_images {
                let lanes = P::narrow(mirrored_lanes::<V>(&particles.mirrored, particles.real_count(), &b));
                accumulate(&mut part.mirror_divergence, lanes * weight, &traction);
                mirrored = Some(lanes);
            }
            let mut relief = None;
            if let Some(artificial_stress) = &constants.artificial_stress {
                relief = Some(weight * artificial_stress.factor(square, dot(&traction, &r) / regular) / own.density);
            }
            if P::SINGLE {
                // all of it acts along the pair: one factor of r
                let explained = hourglass::explained_along(&own.velocity_gradient, &other.velocity_gradient, &r);
                let unexplained = approach - explained;
                let felt = if constants.of_grains { unexplained } else { approach };
                let push = artificial_viscosity::pair_factor(alpha, approach, felt, inverse);
                let along = unexplained * (half * inverse * density_sum);
                let mut pull = mass_weight * (push + drag * along);
                if let Some(relief) = relief {
                    pull = pull + relief;
                }
                part.damp(mirrored, pull, &r);
            } else {
                let unexplained = hourglass::unexplained(&slip, &own.velocity_gradient, &other.velocity_gradient, &r);
                let felt = if constants.of_grains { dot(&r, &unexplained) } else { approach };
                let push = artificial_viscosity::pair_factor(alpha, approach, felt, inverse);
                let unexplained = hourglass::along_pair(&unexplained, &r, regular);
                part.damp(mirrored, mass_weight * push, &r);
                part.damp(mirrored, mass_weight * drag, &unexplained);
                if let Some(relief) = relief {
                    part.damp(mirrored, relief, &r);
                }
            }
        }
        flush_vector::<V, P, D>(&mut forces.divergence, &mut part.divergence);
        flush_vector::<V, P, D>(&mut forces.damping, &mut part.damping);
        if group.has_images {
            flush_vector::<V, P, D>(&mut forces.mirror_divergence, &mut part.mirror_divergence);
            flush_vector::<V, P, D>(&mut forces.mirror_damping, &mut part.mirror_damping);
        }
    }
    if group.wall.is_empty() {
        return forces;
    }
    let seen = WallGroup::of::<V, P>(model, particles, own, here);
    let seen = seen.bounded::<V, P>(constants, records, weighing.pairs(group.wall, wall_weights));
    let mut walls = weighing.pairs(group.wall, wall_weights);
    while let Some(walls) = walls.next() {
        for (w, weight) in walls {
            let WallPair { traction, drag, unexplained } = seen.pair::<V, P>(constants, records, &w);
            let weight = P::Lanes::<V>::load(weight);
            accumulate(&mut part.wall_divergence, weight, &traction);
            accumulate(&mut part.wall_control, weight * drag, &unexplained);
        }
        flush_vector::<V, P, D>(&mut forces.wall_divergence, &mut part.wall_divergence);
        flush_vector::<V, P, D>(&mut forces.wall_control, &mut part.wall_control);
    }
    forces
}
