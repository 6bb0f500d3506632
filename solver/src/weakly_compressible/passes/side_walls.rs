//! Friction of side walls on the velocities of a plane flow, after all other forces and contacts of a step.

use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::SideWalls;
use crate::weakly_compressible::energy::{PushCause, PushStep};
use crate::weakly_compressible::terms::side_walls;
use crate::weakly_compressible::{BLOCK, EnergyLedger, Particles};

/// Retards the flow under a gravity `[m/s²]`. Adds to the energies of the blocks, and sets their impulses `[kg m/s]`.
pub(crate) fn run<const D: usize>(
    walls: SideWalls,
    gravity: &Vector<D>,
    time_step: f64,
    particles: &mut Particles<D>,
    energy: &mut [EnergyLedger],
    impulses: &mut [Vector<D>],
) {
    let friction_per_width = walls.friction_per_width();
    let flow = particles.flow_count();
    let Particles { velocity, pressure, density, mass, acceleration, by_walls, by_damping, by_wall_control, .. } =
        particles;
    (velocity[..flow].par_chunks_mut(BLOCK), energy, impulses).enumerate().with_min_len(16).for_each(
        |(block, (velocities, energy, impulse))| {
            *impulse = Vector::zeros();
            for (index, velocity) in (block * BLOCK..).zip(velocities) {
                let lost = side_walls::speed_lost(pressure[index], density[index], friction_per_width, time_step);
                let after = *velocity * side_walls::share_left(velocity.norm(), lost);
                let push = after - *velocity;
                PushStep {
                    mass: mass[index],
                    time_step,
                    gravity,
                    velocity: *velocity,
                    push,
                    given: 0.0,
                    acceleration: &acceleration[index],
                    by_walls: &by_walls[index],
                    by_damping: &by_damping[index],
                    by_wall_control: &by_wall_control[index],
                }
                .add_to(energy, PushCause::SideWalls);
                *impulse += push * mass[index];
                *velocity = after;
            }
        },
    );
}
