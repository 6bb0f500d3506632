//! What each shell gives to the flow: the forces of its wall particles, pair by pair as the momentum pass takes them, and
//! contacts. Only scenes with shells come here.

use super::PairData;
use super::flow_partner::{Constants, FlowPartner};
use super::wall_partner::{WallPair, WallPartner};
use crate::lanes::algebra::{load, load_tensor, scaled, store_vector};
use crate::lanes::{LANES, LanePass, Lanes};
use crate::vector::Vector;
use crate::weakly_compressible::boundary::shell_contact::{Passed, Touch};
use crate::weakly_compressible::energy::EnergyLedger;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::surroundings::NO_SHELL;
use rayon::prelude::*;

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
            let own = FlowPartner::<V, D>::load(&pairs.momentum, &group.own);
            let correction = load_tensor::<V, D>(&particles.force_correction[places.clone()]);
            let impulse = load::<V>(&particles.mass[places.clone()]) * V::splat(time_step);
            let (_, weights) = pairs.weights[group.first_pair..].split_at(group.flow.len());
            for ((w, weight), partners) in group.wall.zip(weights).zip(owned) {
                let wall = WallPartner::<V, D>::load(&pairs.momentum, &w);
                let WallPair { traction, drag, unexplained } = WallPair::of(&constants, &own, &wall, &correction);
                let weight = impulse * V::load(weight);
                let (from_stress, from_control) =
                    (scaled(weight / own.density, &traction), scaled(weight * drag, &unexplained));
                let (mut stress, mut control) = ([Vector::zeros(); LANES], [Vector::zeros(); LANES]);
                store_vector(&from_stress, &mut stress);
                store_vector(&from_control, &mut control);
                for lane in 0..places.len() {
                    let owner = owners[partners[lane] as usize];
                    if owner != NO_SHELL {
                        out[owner as usize] += stress[lane] + control[lane];
                    }
                }
            }
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
    let (position, mass, by_walls) = (&particles.position[..flow], &particles.mass, &particles.by_walls);
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
                match touch.respond(&position[index], velocity, |shell, push| out[shell] += push * mass) {
                    Ok(push) => {
                        // what the ledger has at the velocity without the push, and the loss
                        energy.gravity += mass * time_step * model.gravity.dot(&push);
                        energy.walls += mass * time_step * by_walls[index].dot(&push);
                        energy.contact -= mass * push.dot(&(*velocity + 0.5 * push));
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
