//! What each shell gives to the flow: the forces of its wall particles, pair by pair as the momentum pass takes them, and
//! contacts. Only scenes with shells come here.

use super::PairData;
use super::flow_partner::{Constants, FlowPartner};
use super::single::momentum::WallGroup;
use super::wall_partner::{WallPair, WallPartner};
use crate::lanes::algebra::{load, scaled, store_vector};
use crate::lanes::{LANES, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::enclosure::shell_contact::{Passed, Touch};
use crate::weakly_compressible::enclosure::surroundings::NO_SHELL;
use crate::weakly_compressible::energy::{EnergyLedger, PushCause, PushStep};
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::particles::Particles;

/// Adds to `impulses`, block by block of flow particles and in each shell by shell, what the wall particles give in a step
/// `[kg m/s]`. `owners` has the shell of every particle in the arrays.
pub(crate) fn by_wall_particles<const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    pairs: &PairData<D>,
    owners: &[u32],
    shells: usize,
    time_step: f64,
    impulses: &mut [Vector<D>],
) {
    impulses.par_chunks_mut(shells).enumerate().with_min_len(4).for_each(|(block, out)| {
        model.instruction_set.run(Pass { model, particles, pairs, owners, block, time_step, out });
    });
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    pairs: &'a PairData<D>,
    owners: &'a [u32],
    block: usize,
    time_step: f64,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, pairs, owners, block, time_step, out } = self;
        let constants = Constants::of(model);
        let count = (particles.flow_count() - block * BLOCK).min(BLOCK);
        for offset in 0..count.div_ceil(LANES) {
            let group = model.list.group(block * (BLOCK / LANES) + offset);
            let owned = group.wall.raw();
            if owned.is_empty() {
                continue;
            }
            let first = block * BLOCK + offset * LANES;
            let places = first..(first + LANES).min(block * BLOCK + count);
            let impulse = load::<V>(&particles.mass[places.clone()]) * V::splat(time_step);
            let count = places.len();
            if model.pairs_in_single() {
                let density = load::<V>(&particles.density[places.clone()]);
                let seen = WallGroup::of::<V>(particles, &pairs.single, &group, places);
                for (w, partners) in group.wall.zip(owned) {
                    let (weight, pair) = seen.pair(model, &constants, &pairs.single, &w);
                    let WallPair { traction, drag, unexplained } = pair;
                    let from_stress = widened::<V, D>(impulse / density, &scaled(weight, &traction));
                    let from_control = widened::<V, D>(impulse, &scaled(weight * drag, &unexplained));
                    book(owners, &partners[..count], &from_stress, &from_control, out);
                }
                continue;
            }
            let own = FlowPartner::<V, D>::load(&pairs.momentum, &group.own);
            let correction = particles.force_correction.load::<V>(first / LANES);
            let (_, weights) = pairs.weights[group.first_pair..].split_at(group.flow.len());
            for ((w, weight), partners) in group.wall.zip(weights).zip(owned) {
                let wall = WallPartner::<V, D>::load(&pairs.momentum, &w);
                let WallPair { traction, drag, unexplained } = WallPair::of(&constants, &own, &wall, &correction);
                let weight = impulse * V::load(weight);
                let from_stress = scaled(weight / own.density, &traction);
                let from_control = scaled(weight * drag, &unexplained);
                book(owners, &partners[..count], &from_stress, &from_control, out);
            }
        }
    }
}

/// f a of a vector in single precision.
#[inline(always)]
fn widened<V: Lanes, const D: usize>(factor: V, vector: &[V::Single; D]) -> [V; D] {
    let mut lanes = [V::splat(0.0); D];
    for i in 0..D {
        lanes[i] = factor * V::widen(vector[i]);
    }
    lanes
}

/// Adds what the wall particles `partners` give, lane by lane, to their shells.
#[inline(always)]
fn book<V: Lanes, const D: usize>(
    owners: &[u32],
    partners: &[u32],
    from_stress: &[V; D],
    from_control: &[V; D],
    out: &mut [Vector<D>],
) {
    let (mut stress, mut control) = ([Vector::zeros(); LANES], [Vector::zeros(); LANES]);
    store_vector(from_stress, &mut stress);
    store_vector(from_control, &mut control);
    for (lane, partner) in partners.iter().enumerate() {
        let owner = owners[*partner as usize];
        if owner != NO_SHELL {
            out[owner as usize] += stress[lane] + control[lane];
        }
    }
}

/// What contacts with shells found in a block.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extremes {
    /// Largest speed squared of a particle that was touched `[m²/s²]`.
    pub(crate) largest: f64,
    /// The first particle that was found behind a shell.
    pub(crate) passed: Option<(usize, Passed)>,
}

/// Stops what approaches a shell, after the velocities have been stepped; adds the impulses as [`by_wall_particles`] does.
pub(crate) fn by_contacts<const D: usize>(
    model: &Model<D>,
    particles: &mut Particles<D>,
    energy: &mut [EnergyLedger],
    touch: Touch<'_, D>,
    time_step: f64,
    impulses: &mut [Vector<D>],
) -> Extremes {
    let flow = particles.flow_count();
    let (position, mass, acceleration) = (&particles.position[..flow], &particles.mass, &particles.acceleration);
    let (by_walls, by_damping, by_wall_control) =
        (&particles.by_walls, &particles.by_damping, &particles.by_wall_control);
    (
        particles.velocity[..flow].par_chunks_mut(BLOCK),
        particles.support_impulse.par_chunks_mut(BLOCK),
        energy,
        impulses.par_chunks_mut(touch.shells.len()),
    )
        .into_par_iter()
        .with_min_len(16)
        .enumerate()
        .map(|(block, (velocities, support_impulses, energy, out))| {
            let mut extremes = Extremes { largest: 0.0, passed: None };
            for (offset, (velocity, support_impulse)) in velocities.iter_mut().zip(support_impulses).enumerate() {
                let index = block * BLOCK + offset;
                if model.list.group(index / LANES).wall.raw().is_empty() {
                    continue;
                }
                let mass = mass[index];
                // what the shells do by moving
                let mut given = 0.0;
                let book = |shell: usize, push: Vector<D>| {
                    out[shell] += push * mass;
                    given += mass * push.dot(&touch.velocities[shell]);
                };
                match touch.respond(&position[index], velocity, book) {
                    Ok(push) => {
                        PushStep {
                            mass,
                            time_step,
                            gravity: &model.gravity,
                            velocity: *velocity,
                            push,
                            given,
                            acceleration: &acceleration[index],
                            by_walls: &by_walls[index],
                            by_damping: &by_damping[index],
                            by_wall_control: &by_wall_control[index],
                        }
                        .add_to(energy, PushCause::Contact);
                        *velocity += push;
                        *support_impulse += push * mass;
                        extremes.largest = extremes.largest.max(velocity.norm_squared());
                    }
                    Err(passed) => extremes.passed = extremes.passed.or(Some((index, passed))),
                }
            }
            extremes
        })
        .reduce(
            || Extremes { largest: 0.0, passed: None },
            |a, b| Extremes {
                largest: a.largest.max(b.largest),
                passed: match (a.passed, b.passed) {
                    (Some(first), Some(second)) => Some(if second.0 < first.0 { second } else { first }),
                    (first, second) => first.or(second),
                },
            },
        )
}
