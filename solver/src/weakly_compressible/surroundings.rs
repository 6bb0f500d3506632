//! Shells and open sides of a running simulation: where the shells stand, what they have given to the flow, who has left.

use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::boundary::Enclosure;
use crate::weakly_compressible::boundary::enclosure::{Departures, Exits};
use crate::weakly_compressible::boundary::facet_grid::FacetGrid;
use crate::weakly_compressible::boundary::shell::Shell;
use crate::weakly_compressible::boundary::shell_contact::{Passed, Touch};
use crate::weakly_compressible::divergence::Quantity;
use crate::weakly_compressible::energy::energy_of;
use crate::weakly_compressible::model::GradientUse;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::numerics::Contact;
use crate::weakly_compressible::passes::shell_impulse;
use crate::weakly_compressible::state::State;
use serde::{Deserialize, Serialize};

/// The owner of particles that belong to no shell.
pub(crate) const NO_SHELL: u32 = u32::MAX;

/// What the scene says of its enclosure, and what has become of it.
#[derive(Debug)]
pub(crate) struct Surroundings<const D: usize> {
    shells: Vec<Shell<D>>,
    /// Which facets of each are near a place, where they are at the start.
    grids: Vec<FacetGrid<D>>,
    /// Distance from a shell within which a particle is touched `[m]`.
    range: f64,
    exits: Exits<D>,
    /// How far each shell has moved since the start `[m]`, and in the last step.
    displacements: Vec<Vector<D>>,
    last: Vec<Vector<D>>,
    /// Mean velocity of each in the present step `[m/s]`.
    velocities: Vec<Vector<D>>,
    /// The shell of every particle in the arrays; none of the flow.
    owners: Vec<u32>,
    /// Impulses of a step, block by block.
    blocks: Vec<Vector<D>>,
    gone: Vec<bool>,
    pub(crate) books: Books<D>,
}

/// What is kept of a simulation beside what the scene and its time say.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Books<const D: usize> {
    /// Impulse that each shell has given to the flow since the start `[kg m/s]`.
    pub(crate) impulses: Vec<Vector<D>>,
    pub(crate) departures: Departures<D>,
}

impl<const D: usize> Surroundings<D> {
    /// Those of an enclosure of a flow with a particle spacing `[m]`.
    pub(crate) fn new(enclosure: Enclosure<D>, spacing: f64) -> Self {
        let Enclosure { shells, exits } = enclosure;
        let range = 0.5 * spacing;
        let none = vec![Vector::zeros(); shells.len()];
        let displacements = shells.iter().map(|shell| shell.motion.displacement(0.0)).collect();
        Self {
            grids: shells.iter().map(|shell| FacetGrid::new(&shell.facets, range)).collect(),
            range,
            exits,
            displacements,
            last: none.clone(),
            velocities: none.clone(),
            owners: Vec::new(),
            blocks: Vec::new(),
            gone: Vec::new(),
            books: Books { impulses: none, departures: Departures::default() },
            shells,
        }
    }

    /// Goes on from books and a time.
    pub(crate) fn restore(&mut self, books: Books<D>, time: f64) {
        self.books = books;
        for (place, shell) in self.displacements.iter_mut().zip(&self.shells) {
            *place = shell.motion.displacement(time);
        }
    }

    /// The largest speed that any shell ever has `[m/s]`.
    pub(crate) fn largest_speed(&self) -> f64 {
        self.shells.iter().map(|shell| shell.motion.largest_speed()).fold(0.0, f64::max)
    }

    pub(crate) fn shells(&self) -> &[Shell<D>] {
        &self.shells
    }

    pub(crate) fn displacements(&self) -> &[Vector<D>] {
        &self.displacements
    }

    /// Adds the impulses of a step, in the order of the blocks.
    fn close_impulses(&mut self) {
        for block in self.blocks.chunks_exact_mut(self.shells.len()) {
            for (sum, impulse) in self.books.impulses.iter_mut().zip(block) {
                *sum += std::mem::replace(impulse, Vector::zeros());
            }
        }
    }
}

impl<const D: usize> State<D> {
    /// Takes out what has left the domain by an open side.
    pub(crate) fn release(&mut self) {
        let Surroundings { exits, gone, books, .. } = &mut self.surroundings;
        if *exits == Exits::default() {
            return;
        }
        self.particles.keep_real();
        let (particles, flow) = (&self.particles, self.particles.flow_count());
        let single = self.model.gradient_use() == GradientUse::Stress && self.model.rheology.is_plastic();
        let shear_modulus = single.then(|| self.model.shear_modulus());
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
            departed.energy += energy_of(particles, index, &self.model.equation_of_state, shear_modulus);
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
        let Surroundings { shells, grids, range, displacements, velocities, blocks, .. } = surroundings;
        if shells.is_empty() || self.model.numerics.contact == Contact::None {
            return Ok(());
        }
        for ((velocity, shell), place) in velocities.iter_mut().zip(&*shells).zip(&*displacements) {
            *velocity = (shell.motion.displacement(self.time + time_step) - place) / time_step;
        }
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
        let Surroundings { shells, displacements, last, .. } = &mut self.surroundings;
        if shells.iter().all(|shell| shell.motion.is_rest()) {
            return 0.0;
        }
        let end = self.time + time_step;
        let mut fastest = 0.0_f64;
        for ((place, last), shell) in displacements.iter_mut().zip(&mut *last).zip(&*shells) {
            let next = shell.motion.displacement(end);
            *last = next - *place;
            *place = next;
            fastest = fastest.max(last.norm() / time_step);
        }
        self.particles.move_walls(self.walls.len(), last, |shell| shells[shell].motion.velocity(end));
        self.images.copy_vectors(&mut self.particles.wall_velocity);
        fastest
    }
}
