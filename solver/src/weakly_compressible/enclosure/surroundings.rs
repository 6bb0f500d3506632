//! Shells, open sides and inlets of a running simulation: where the shells stand, what they have given to the flow, who
//! has left and who has come in. The rows of inlets are the last of the shells.

use super::boundary_set::{Departures, Enclosure, Exits};
use super::facet_grid::FacetGrid;
use super::inlet::{Arrivals, Inlet};
use super::shell::{BackingParticle, Shell};
use crate::run::ForeignState;
use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// What the scene says of its enclosure, and what has become of it.
#[derive(Debug)]
pub(crate) struct Surroundings<const D: usize> {
    /// The shells, then the rows of each inlet, at the start.
    pub(crate) shells: Vec<Shell<D>>,
    /// Plane walls, which come before the shells in the numbering of walls.
    pub(super) plane_walls: usize,
    /// Which facets of each are near a place, where they are at the start.
    pub(super) grids: Vec<FacetGrid<D>>,
    /// Distance from a shell within which a particle is touched `[m]`.
    pub(super) range: f64,
    pub(super) exits: Exits<D>,
    pub(crate) inlets: Vec<Inlet<D>>,
    /// Where the particles of each inlet's rows begin among all wall particles.
    pub(super) first_particles: Vec<usize>,
    /// Particles of the flow at the start.
    begun: u32,
    /// How far each shell has moved since the start `[m]`, and in the last step.
    pub(crate) displacements: Vec<Vector<D>>,
    pub(super) last: Vec<Vector<D>>,
    /// Mean velocity of each in the present step `[m/s]`.
    pub(super) velocities: Vec<Vector<D>>,
    /// The shell of every particle in the arrays; none of the flow.
    pub(super) owners: Vec<u32>,
    /// Impulses of a step, block by block.
    pub(super) blocks: Vec<Vector<D>>,
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
    /// State at the start at a spacing `[m]`, with numbers of plane walls, of their particles and of particles of the flow, and the dummy
    /// particles of each shell.
    pub(crate) fn new(
        enclosure: Enclosure<D>,
        spacing: f64,
        (plane_walls, plane): (usize, usize),
        flow: usize,
        backing: &[Vec<BackingParticle<D>>],
    ) -> Self {
        let Enclosure { mut shells, exits, inlets } = enclosure;
        shells.extend(inlets.iter().map(Inlet::shell));
        let before = |shell: usize| plane + backing[..shell].iter().map(Vec::len).sum::<usize>();
        let first_particles = (shells.len() - inlets.len()..shells.len()).map(before).collect();
        let range = 0.5 * spacing;
        let none = vec![Vector::zeros(); shells.len()];
        let displacements = shells.iter().map(|shell| shell.motion.displacement(0.0)).collect();
        Self {
            plane_walls,
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

    /// Continues from books and a time.
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
    pub(crate) fn is_empty(&self) -> bool {
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
    pub(crate) fn velocity(&self, shell: usize, time: f64) -> Vector<D> {
        match shell.checked_sub(self.first_inlet()) {
            Some(inlet) => self.inlets[inlet].direction() * self.inlets[inlet].speed(time),
            None => self.shells[shell].motion.velocity(time),
        }
    }

    /// Identity of the next particle that an inlet sets free.
    pub(super) fn next_identity(&self) -> u32 {
        self.begun + self.books.arrivals.particles() as u32
    }

    /// Adds the impulses of a step, in the order of the blocks.
    pub(super) fn close_impulses(&mut self) {
        for block in self.blocks.chunks_exact_mut(self.shells.len()) {
            for (sum, impulse) in self.books.impulses.iter_mut().zip(block) {
                *sum += std::mem::replace(impulse, Vector::zeros());
            }
        }
    }
}

impl<const D: usize> Books<D> {
    /// Checks the rows that inlets have set free into a flow of so many particles. Returns how many particles there were in all.
    ///
    /// # Errors
    /// Rows of other inlets than these.
    pub(crate) fn check_rows(&self, inlets: &[Inlet<D>], flow: usize) -> Result<usize, ForeignState> {
        ForeignState::check("inlets", self.arrivals.inlets.len(), inlets.len())?;
        let cells = |inlet: usize| inlets.get(inlet).map_or(0, |inlet| inlet.cells.len() as u64);
        let mut rows = vec![0; inlets.len()];
        let mut next = flow as u64;
        let mut sound = true;
        for row in &self.arrivals.rows {
            let inlet = row.inlet as usize;
            sound &= inlet < inlets.len() && u64::from(row.first) == next;
            next = next.saturating_add(cells(inlet));
            rows.get_mut(inlet).into_iter().for_each(|rows| *rows += 1);
        }
        let counted = |(inlet, rows): (usize, &u64)| {
            let fed = &self.arrivals.inlets[inlet];
            fed.rows == *rows && fed.particles == rows.saturating_mul(cells(inlet))
        };
        sound &= rows.iter().enumerate().all(counted);
        ForeignState::check("whole sets of rows", usize::from(sound), 1)?;
        Ok(next as usize)
    }
}
