//! The momentum equation with the single divergence: a_a = g + [Σ V_b F traction]/ρ_a + artificial viscosity (15) +
//! hourglass control, and the artificial stress of soil that holds together, each a term of its own, in one loop over flow and wall
//! partners.

use super::PairData;
use super::flow_partner::{Constants, FlowPartner};
use super::records::{Records, Writer};
use super::single;
use super::wall_partner::{WallPair, WallPartner};
use crate::lanes::algebra::{accumulate, difference, dot, load, store_vector, zero_vector};
use crate::lanes::{LANES, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::{BLOCK, NeighbourGroup};
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{artificial_viscosity, hourglass, pair_distance, stress_divergence};
use crate::weakly_compressible::wall_fields::mirrored_lanes;

/// Writes a record in the layout of [`FlowPartner`] or, for wall particles, of [`WallPartner`].
#[inline(always)]
fn write<const D: usize>(particles: &Particles<D>, inverse_density: f64, index: usize, record: &mut Writer<'_>) {
    let wall = particles.is_wall(index).then(|| index - particles.flow_count());
    let walls = &particles.walls;
    record.vector(&particles.position[index]);
    record.vector(wall.map_or(&particles.velocity[index], |wall| &walls.velocity[wall]));
    record.scalar(wall.map_or(particles.density[index], |wall| walls.depth[wall]));
    record.scalar(hourglass::pressure_speed(particles.pressure[index], inverse_density));
    record.scalar(wall.map_or(particles.artificial_viscosity[index], |_| 0.0));
    record.tensor(&particles.corrected_stress[index]);
    match wall {
        Some(wall) => record.vector(&walls.normal[wall]),
        None => record.tensor(&particles.velocity_gradient[index]),
    }
}

/// Accelerations `[m/s²]` of the flow particles, and what walls and mirrors have of it.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let shared = &*particles;
    let inverse_density = 1.0 / model.equation_of_state.reference_density;
    if model.pairs_in_single() {
        single::momentum::fill(model, shared, &mut pairs.single);
    } else {
        pairs.momentum.fill(shared.position.len(), |index, record| write(shared, inverse_density, index, record));
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
        .into_par_iter()
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
pub(super) struct Forces<V, const D: usize> {
    /// Σ V F traction `[N/m³]`.
    pub(super) divergence: [V; D],
    /// Artificial viscosity, artificial stress and hourglass control `[m/s²]`.
    pub(super) damping: [V; D],
    pub(super) mirror_divergence: [V; D],
    pub(super) mirror_damping: [V; D],
    pub(super) wall_divergence: [V; D],
    pub(super) wall_control: [V; D],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, pairs, block, out } = self;
        let constants = Constants::of(model);
        let count = out.acceleration.len();
        let in_single = model.pairs_in_single();
        for offset in 0..count.div_ceil(LANES) {
            let group = model.list.group(block * (BLOCK / LANES) + offset);
            let none = zero_vector::<V, D>();
            let mut forces = Forces {
                divergence: none,
                damping: none,
                mirror_divergence: none,
                mirror_damping: none,
                wall_divergence: none,
                wall_control: none,
            };
            let places = offset * LANES..(offset * LANES + LANES).min(count);
            let first = block * BLOCK + places.start;
            let here = first..first + places.len();
            let density = if in_single {
                single::momentum::flow_forces(model, &constants, particles, &pairs.single, &group, &mut forces);
                let density = load::<V>(&particles.density[here.clone()]);
                single::momentum::wall_forces(model, &constants, particles, &pairs.single, &group, here, &mut forces);
                density
            } else {
                let own = FlowPartner::<V, D>::load(&pairs.momentum, &group.own);
                let (flow_weights, wall_weights) = pairs.weights[group.first_pair..].split_at(group.flow.len());
                flow_forces(&constants, particles, &pairs.momentum, &group, flow_weights, &own, &mut forces);
                let correction = particles.force_correction.load::<V>(first / LANES);
                wall_forces(&constants, &pairs.momentum, &group, wall_weights, &own, &correction, &mut forces);
                own.density
            };
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

#[inline(always)]
fn flow_forces<V: Lanes, const D: usize>(
    constants: &Constants,
    particles: &Particles<D>,
    records: &Records,
    group: &NeighbourGroup<'_>,
    weights: &[[f64; LANES]],
    own: &FlowPartner<V, D>,
    forces: &mut Forces<V, D>,
) {
    let regularisation = V::splat(pair_distance::regularisation(constants.smoothing_length));
    for (b, weight) in group.flow.zip(weights) {
        let other = FlowPartner::<V, D>::load(records, &b);
        let r = difference(&own.position, &other.position);
        let slip = difference(&own.velocity, &other.velocity);
        let weight = V::load(weight);
        let regular = dot(&r, &r) + regularisation;
        // one division serves 1/(ρ̄ r²) of (15) and 2/(ρ_a + ρ_b) of the hourglass control
        let inverse = V::splat(2.0) / ((own.density + other.density) * regular);
        let alpha = match constants.viscosity_switch {
            ViscositySwitch::Constant => V::splat(constants.artificial_viscosity * constants.speed_length),
            ViscositySwitch::MorrisMonaghan => {
                artificial_viscosity::mean_strength(own.alpha, other.alpha, constants.speed_length)
            }
        };
        let traction = stress_divergence::traction(&own.corrected_stress, &other.corrected_stress, &r);
        let push = artificial_viscosity::pair_factor(alpha, dot(&r, &slip), inverse);
        let speed_sum = own.pressure_speed + other.pressure_speed;
        let drag = hourglass::twice_viscosity(constants.hourglass_strength, speed_sum) * (inverse * regular);
        let unexplained = hourglass::unexplained(&slip, &own.velocity_gradient, &other.velocity_gradient, &r);
        let unexplained = hourglass::along_pair(&unexplained, &r, regular);
        let mass_weight = weight * other.density;
        accumulate(&mut forces.divergence, weight, &traction);
        accumulate(&mut forces.damping, mass_weight * push, &r);
        accumulate(&mut forces.damping, mass_weight * drag, &unexplained);
        let mut relief = V::splat(0.0);
        if let Some(artificial_stress) = &constants.artificial_stress {
            let square = dot(&r, &r);
            relief = weight * artificial_stress.factor(square, dot(&traction, &r) / regular) / own.density;
            accumulate(&mut forces.damping, relief, &r);
        }
        if group.has_images {
            let mirrored: V = mirrored_lanes(&particles.mirrored, particles.real_count(), &b);
            accumulate(&mut forces.mirror_divergence, mirrored * weight, &traction);
            accumulate(&mut forces.mirror_damping, mirrored * (mass_weight * push), &r);
            accumulate(&mut forces.mirror_damping, mirrored * (mass_weight * drag), &unexplained);
            if constants.artificial_stress.is_some() {
                accumulate(&mut forces.mirror_damping, mirrored * relief, &r);
            }
        }
    }
}

#[inline(always)]
fn wall_forces<V: Lanes, const D: usize>(
    constants: &Constants,
    records: &Records,
    group: &NeighbourGroup<'_>,
    weights: &[[f64; LANES]],
    own: &FlowPartner<V, D>,
    correction: &[[V; D]; D],
    forces: &mut Forces<V, D>,
) {
    for (w, weight) in group.wall.zip(weights) {
        let wall = WallPartner::<V, D>::load(records, &w);
        let WallPair { traction, drag, unexplained } = WallPair::of(constants, own, &wall, correction);
        let weight = V::load(weight);
        accumulate(&mut forces.wall_divergence, weight, &traction);
        accumulate(&mut forces.wall_control, weight * drag, &unexplained);
    }
}
