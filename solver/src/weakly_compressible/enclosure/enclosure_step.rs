//! Shells and open sides in a step: what they give to the flow, what they stop, who leaves. The rows of inlets are
//! shells here.

use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::Quantity;
use crate::weakly_compressible::enclosure::boundary_set::Exits;
use crate::weakly_compressible::enclosure::shell_contact::{Passed, Touch};
use crate::weakly_compressible::enclosure::surroundings::{NO_SHELL, Surroundings};
use crate::weakly_compressible::energy::energy_of;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::numerics::Contact;
use crate::weakly_compressible::passes::shell_impulse;
use crate::weakly_compressible::state::State;

impl<const D: usize> State<D> {
    /// Takes out what has left the domain by an open side.
    pub(crate) fn release(&mut self) {
        let Surroundings { exits, gone, books, .. } = &mut self.surroundings;
        if *exits == Exits::default() {
            return;
        }
        self.particles.keep_real();
        let (particles, flow) = (&self.particles, self.particles.flow_count());
        gone.clear();
        gone.extend(particles.position[..flow].iter().map(|place| exits.side(place).is_some()));
        if !gone.contains(&true) {
            return;
        }
        // in the order of the scene, so that the sums are those of any order in memory
        for index in particles.by_identity() {
            let Some(side) = exits.side(&particles.position[index]) else { continue };
            let departed = &mut books.departures.sides[side];
            departed.particles += 1;
            departed.mass += particles.mass[index];
            departed.mass_times_time += particles.mass[index] * self.time;
            departed.momentum += particles.velocity[index] * particles.mass[index];
            departed.support += particles.support_impulse[index];
            departed.energy += energy_of(particles, index, &self.model);
        }
        self.particles.remove(gone);
    }

    /// Finds the shells of all particles, after a search.
    pub(crate) fn assign_shells(&mut self) {
        let Surroundings { shells, owners, .. } = &mut self.surroundings;
        if shells.is_empty() {
            return;
        }
        let (flow, real) = (self.particles.flow_count(), self.particles.real_count());
        owners.clear();
        owners.resize(self.particles.position.len(), NO_SHELL);
        for index in flow..real {
            let wall = self.particles.wall(index - flow);
            owners[index] = wall.checked_sub(self.walls.len()).map_or(NO_SHELL, |shell| shell as u32);
        }
        for image in 0..self.images.len() {
            owners[real + image] = owners[self.images.source(image)];
        }
    }

    /// Books what the wall particles of shells give to the flow in a step.
    pub(crate) fn book_shells(&mut self, time_step: f64) {
        let Surroundings { shells, owners, blocks, .. } = &mut self.surroundings;
        if shells.is_empty() {
            return;
        }
        blocks.resize(self.particles.flow_count().div_ceil(BLOCK) * shells.len(), Vector::zeros());
        shell_impulse::by_wall_particles(
            &self.model,
            &self.particles,
            &self.pairs,
            owners,
            shells.len(),
            time_step,
            blocks,
        );
        self.surroundings.close_impulses();
    }

    /// Stops what approaches a shell.
    ///
    /// # Errors
    /// A particle that has passed one.
    pub(crate) fn touch_shells(&mut self, time_step: f64, friction: f64) -> Result<(), Divergence<D>> {
        let surroundings = &mut self.surroundings;
        if surroundings.shells.is_empty() || self.model.numerics.contact == Contact::None {
            return Ok(());
        }
        for shell in 0..surroundings.shells.len() {
            let way = surroundings.place(shell, self.time + time_step) - surroundings.displacements[shell];
            surroundings.velocities[shell] = way / time_step;
        }
        let Surroundings { shells, grids, range, displacements, velocities, blocks, .. } = surroundings;
        let touch = Touch { shells, grids, displacements, velocities, range: *range, friction };
        let (particles, energy) = (&mut self.particles, &mut self.pairs.energy);
        let found = shell_impulse::by_contacts(&self.model, particles, energy, touch, time_step, blocks);
        self.surroundings.close_impulses();
        self.pairs.close_ledger(&mut self.energy);
        self.largest_speed = self.largest_speed.max(found.largest.sqrt());
        match found.passed {
            None => Ok(()),
            Some((index, Passed { shell, distance })) => {
                let mut divergence = self.divergence(index, Quantity::Penetration, distance);
                let name = &self.surroundings.shells[shell].name;
                divergence.rule = format!(" before the wall `{name}`: it has passed it");
                Err(divergence)
            }
        }
    }

    /// Moves the shells to the end of a step; returns the speed of the fastest `[m/s]`.
    pub(crate) fn move_shells(&mut self, time_step: f64) -> f64 {
        let surroundings = &mut self.surroundings;
        if surroundings.inlets.is_empty() && surroundings.shells.iter().all(|shell| shell.motion.is_rest()) {
            return 0.0;
        }
        let end = self.time + time_step;
        let mut fastest = 0.0_f64;
        for shell in 0..surroundings.shells.len() {
            let next = surroundings.place(shell, end);
            surroundings.last[shell] = next - surroundings.displacements[shell];
            surroundings.displacements[shell] = next;
            fastest = fastest.max(surroundings.last[shell].norm() / time_step);
        }
        let surroundings = &*surroundings;
        self.particles.move_walls(self.walls.len(), &surroundings.last, |shell| surroundings.velocity(shell, end));
        self.images.copy_wall_vectors(&mut self.particles.walls.velocity);
        fastest
    }
}
