//! Shells, open sides and inlets of a running simulation: where the shells stand, what they have given to the flow, who
//! has left and who has come in. The rows of inlets are the last of the shells.

use crate::vector::Vector;
use crate::weakly_compressible::enclosure::Enclosure;
use crate::weakly_compressible::enclosure::boundary_set::{Departures, Exits};
use crate::weakly_compressible::enclosure::facet_grid::FacetGrid;
use crate::weakly_compressible::enclosure::inlet::{Arrivals, Inlet};
use crate::weakly_compressible::enclosure::shell::Shell;
use serde::{Deserialize, Serialize};

/// The owner of particles that belong to no shell.
pub(crate) const NO_SHELL: u32 = u32::MAX;

/// What the scene says of its enclosure, and what has become of it.
#[derive(Debug)]
pub(crate) struct Surroundings<const D: usize> {
    pub(in crate::weakly_compressible) shells: Vec<Shell<D>>,
    /// Which facets of each are near a place, where they are at the start.
    pub(super) grids: Vec<FacetGrid<D>>,
    /// Distance from a shell within which a particle is touched `[m]`.
    pub(super) range: f64,
    pub(super) exits: Exits<D>,
    pub(in crate::weakly_compressible) inlets: Vec<Inlet<D>>,
    /// Where the particles of each inlet's rows begin among all wall particles.
    pub(super) first_particles: Vec<usize>,
    /// Particles of the flow at the start.
    begun: u32,
    /// How far each shell has moved since the start `[m]`, and in the last step.
    pub(super) displacements: Vec<Vector<D>>,
    pub(super) last: Vec<Vector<D>>,
    /// Mean velocity of each in the present step `[m/s]`.
    pub(super) velocities: Vec<Vector<D>>,
    /// The shell of every particle in the arrays; none of the flow.
    pub(in crate::weakly_compressible) owners: Vec<u32>,
    /// Impulses of a step, block by block.
    pub(in crate::weakly_compressible) blocks: Vec<Vector<D>>,
    pub(super) gone: Vec<bool>,
    pub(crate) books: Books<D>,
}

/// What is kept of a simulation beside what the scene and its time say.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Books<const D: usize> {
    /// Impulse that each shell has given to the flow since the start `[kg m/s]`.
    pub(crate) impulses: Vec<Vector<D>>,
    pub(crate) departures: Departures<D>,
    pub(crate) arrivals: Arrivals<D>,
    /// Impulse that implicit viscous steps have left out since the start `[kg m/s]`.
    pub(crate) unsolved: Vector<D>,
}

impl<const D: usize> Surroundings<D> {
    /// Those of an enclosure of a flow at a spacing `[m]`, with so many particles of the flow and of plane walls.
    pub(crate) fn new(enclosure: Enclosure<D>, spacing: f64, (flow, plane): (usize, usize)) -> Self {
        let shells = enclosure.surfaces();
        let Enclosure { exits, inlets, .. } = enclosure;
        let before = |shell: usize| plane + shells[..shell].iter().map(|shell| shell.backing.len()).sum::<usize>();
        let first_particles = (0..inlets.len()).map(|inlet| before(shells.len() - inlets.len() + inlet)).collect();
        let range = 0.5 * spacing;
        let none = vec![Vector::zeros(); shells.len()];
        let displacements = shells.iter().map(|shell| shell.motion.displacement(0.0)).collect();
        Self {
            grids: shells.iter().map(|shell| FacetGrid::new(&shell.facets, range)).collect(),
            range,
            exits,
            first_particles,
            begun: flow as u32,
            displacements,
            last: none.clone(),
            velocities: none.clone(),
            owners: Vec::new(),
            blocks: Vec::new(),
            gone: Vec::new(),
            books: Books {
                impulses: none,
                departures: Departures::default(),
                arrivals: Arrivals::none(inlets.len()),
                unsolved: Vector::zeros(),
            },
            inlets,
            shells,
        }
    }

    /// Goes on from books and a time.
    pub(crate) fn restore(&mut self, books: Books<D>, time: f64) {
        self.books = books;
        for shell in 0..self.shells.len() {
            self.displacements[shell] = self.place(shell, time);
        }
    }

    /// The largest speed that any shell ever has `[m/s]`.
    pub(crate) fn largest_speed(&self) -> f64 {
        let inlets = self.inlets.iter().map(Inlet::largest_speed);
        self.shells.iter().map(|shell| shell.motion.largest_speed()).chain(inlets).fold(0.0, f64::max)
    }

    /// Whether there is nothing, neither shells nor open sides.
    pub(in crate::weakly_compressible) fn is_empty(&self) -> bool {
        self.shells.is_empty() && self.exits == Exits::default()
    }

    /// The place of the first inlet's rows among the shells.
    pub(super) fn first_inlet(&self) -> usize {
        self.shells.len() - self.inlets.len()
    }

    /// How far a shell, or the rows of an inlet, are from their start at a time `[m]`.
    pub(super) fn place(&self, shell: usize, time: f64) -> Vector<D> {
        match shell.checked_sub(self.first_inlet()) {
            Some(inlet) => self.inlets[inlet].displacement(time, self.books.arrivals.inlets[inlet].rows),
            None => self.shells[shell].motion.displacement(time),
        }
    }

    /// Velocity of a shell, or of the rows of an inlet, right after a time `[m/s]`.
    pub(super) fn velocity(&self, shell: usize, time: f64) -> Vector<D> {
        match shell.checked_sub(self.first_inlet()) {
            Some(inlet) => self.inlets[inlet].direction() * self.inlets[inlet].speed(time),
            None => self.shells[shell].motion.velocity(time),
        }
    }

    /// Identity of the next particle that an inlet sets free.
    pub(super) fn next_identity(&self) -> u32 {
        self.begun + self.books.arrivals.particles() as u32
    }

    pub(crate) fn shells(&self) -> &[Shell<D>] {
        &self.shells
    }

    pub(crate) fn displacements(&self) -> &[Vector<D>] {
        &self.displacements
    }

    /// Adds the impulses of a step, in the order of the blocks.
    pub(in crate::weakly_compressible) fn close_impulses(&mut self) {
        for block in self.blocks.chunks_exact_mut(self.shells.len()) {
            for (sum, impulse) in self.books.impulses.iter_mut().zip(block) {
                *sum += std::mem::replace(impulse, Vector::zeros());
            }
        }
    }
}
