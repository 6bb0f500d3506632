//! Contacts of all flow particles with shells in a step: velocities, impulses and energies.

use super::shell_contact::{Passed, Touch};
use crate::lanes::LANES;
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::energy::{EnergyLedger, PushCause, PushStep};
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::particles::Particles;

/// Extremes among the contacts of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extremes {
    /// Largest speed squared of a particle that was touched `[m²/s²]`.
    pub(super) largest: f64,
    /// The first particle that was found behind a shell.
    pub(super) passed: Option<(usize, Passed)>,
}

/// Stops particles that approach a shell, after the velocities have been stepped. Adds the impulses, block by block of flow particles
/// and in each shell by shell `[kg m/s]`.
pub(super) fn run<const D: usize>(
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
