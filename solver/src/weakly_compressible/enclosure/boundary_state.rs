//! Facet walls, open sides and inlets of a running simulation: displacements, impulses on the flow, outflow and inflow. The rows of
//! inlets are the last of the facet walls.

use super::boundary_set::{BoundarySet, Exits, OutflowBySide};
use super::facet_grid::FacetGrid;
use super::facet_wall::{BackingParticle, FacetWall};
use super::inlet::{Inflow, Inlet};
use super::pose::Pose;
use super::wall_load::WallTravel;
use crate::run::ForeignState;
use crate::vector::Vector;
use crate::weakly_compressible::passes::shell_impulse::WallImpulse;
use serde::{Deserialize, Serialize};

/// Boundaries of the scene, and their state.
#[derive(Debug)]
pub(crate) struct BoundaryState<const D: usize> {
    /// The facet walls, then the rows of each inlet, at the start.
    pub(crate) walls: Vec<FacetWall<D>>,
    /// Plane walls, which come before the facet walls in the numbering of walls.
    pub(super) plane_walls: usize,
    /// Grids to find facets by, wall by wall, at the start.
    pub(super) grids: Vec<FacetGrid<D>>,
    /// Distance from a facet wall within which a particle is touched `[m]`.
    pub(super) range: f64,
    pub(super) exits: Exits<D>,
    pub(crate) inlets: Vec<Inlet<D>>,
    /// Velocity that speeds are relative to `[m/s]`.
    pub(crate) frame: Vector<D>,
    /// First particle of each facet wall, and then of each inlet's rows, among all wall particles.
    pub(super) first_particles: Vec<usize>,
    /// Particles of the flow at the start.
    begun: u32,
    /// Pose of each facet wall, and when it was last looked for those that are driven out.
    pub(crate) poses: Vec<Pose<D>>,
    pub(super) earlier: Vec<Pose<D>>,
    /// Displacement of each in the last step `[m]`.
    pub(super) last: Vec<Vector<D>>,
    /// Mean velocity `[m/s]` and rate `[rad/s]` of each in the present step.
    pub(super) velocities: Vec<(Vector<D>, f64)>,
    /// Largest speed of the particles of each by its turn `[m/s]`.
    pub(super) rim_speeds: Vec<f64>,
    /// Dummy particles at the start of each that turns.
    pub(super) turning: Vec<Vec<BackingParticle<D>>>,
    /// The facet wall of every particle in the arrays; none for the flow.
    pub(super) owners: Vec<u32>,
    /// Impulses of a step, block by block.
    pub(super) blocks: Vec<WallImpulse<D>>,
    pub(super) gone: Vec<bool>,
    pub(crate) books: Books<D>,
}

/// Sums over a run, which neither the scene nor the time gives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Books<const D: usize> {
    /// Impulse that each facet wall has given to the flow since the start `[kg m/s]`.
    pub(crate) impulses: Vec<Vector<D>>,
    /// Their moments about the axes that walls turn about `[kg m²/s]`; zero of other walls.
    pub(crate) moments: Vec<f64>,
    /// State of each facet wall under a load.
    pub(crate) travels: Vec<WallTravel>,
    pub(crate) outflow: OutflowBySide<D>,
    pub(crate) inflow: Inflow<D>,
    /// Impulse that implicit viscous steps have left out since the start `[kg m/s]`.
    pub(crate) unsolved: Vector<D>,
}

impl<const D: usize> BoundaryState<D> {
    /// State at the start at a spacing `[m]`, with numbers of plane walls, of their particles and of particles of the flow, and the dummy
    /// particles of each facet wall.
    pub(crate) fn new(
        enclosure: BoundarySet<D>,
        spacing: f64,
        (plane_walls, plane): (usize, usize),
        flow: usize,
        backing: &[Vec<BackingParticle<D>>],
    ) -> Self {
        let BoundarySet { mut walls, exits, inlets, frame } = enclosure;
        walls.extend(inlets.iter().map(Inlet::wall));
        let before = |wall: usize| plane + backing[..wall].iter().map(Vec::len).sum::<usize>();
        let first_particles = (0..walls.len()).map(before).collect();
        let turning = walls.iter().zip(backing);
        let turning = turning.map(|(wall, own)| wall.motion.turn.iter().flat_map(|_| own.clone()).collect());
        let rim_speed = |(wall, backing): (&FacetWall<D>, &Vec<BackingParticle<D>>)| {
            wall.motion.turn.as_ref().map_or(0.0, |turn| turn.largest_speed(backing.iter().map(|own| &own.position)))
        };
        let range = 0.5 * spacing;
        let none = vec![Vector::zeros(); walls.len()];
        let travels = walls.iter().map(|wall| WallTravel::of(wall.motion.load.as_ref())).collect();
        let mut state = Self {
            plane_walls,
            grids: walls.iter().map(|wall| FacetGrid::new(&wall.facets, range)).collect(),
            range,
            exits,
            first_particles,
            begun: flow as u32,
            poses: vec![Pose::start(); walls.len()],
            earlier: Vec::new(),
            last: none.clone(),
            velocities: vec![(Vector::zeros(), 0.0); walls.len()],
            rim_speeds: walls.iter().zip(backing).map(rim_speed).collect(),
            turning: turning.collect(),
            owners: Vec::new(),
            blocks: Vec::new(),
            gone: Vec::new(),
            books: Books {
                impulses: none,
                moments: vec![0.0; walls.len()],
                travels,
                outflow: OutflowBySide::default(),
                inflow: Inflow::none(inlets.len()),
                unsolved: Vector::zeros(),
            },
            inlets,
            frame,
            walls,
        };
        state.place_walls(0.0);
        state
    }

    /// Continues from books and a time.
    pub(crate) fn restore(&mut self, books: Books<D>, time: f64) {
        self.books = books;
        self.place_walls(time);
    }

    fn place_walls(&mut self, time: f64) {
        for wall in 0..self.walls.len() {
            self.poses[wall] = self.pose(wall, time);
        }
        self.earlier.clone_from(&self.poses);
    }

    /// Largest speed of any facet wall at any time by its table, and by its load now, relative to the frame `[m/s]`.
    pub(crate) fn largest_speed(&self) -> f64 {
        let inlets = self.inlets.iter().map(|inlet| inlet.largest_speed() + self.frame.norm());
        let walls = self.walls.iter().zip(&self.books.travels).zip(&self.rim_speeds);
        let walls =
            walls.map(|((wall, travel), rim)| wall.motion.largest_speed(&self.frame) + travel.speed.abs() + rim);
        walls.chain(inlets).fold(0.0, f64::max)
    }

    /// Whether there is nothing, neither facet walls nor open sides.
    pub(crate) fn is_empty(&self) -> bool {
        self.walls.is_empty() && self.exits == Exits::default()
    }

    /// The place of the first inlet's rows among the facet walls.
    pub(super) fn first_inlet(&self) -> usize {
        self.walls.len() - self.inlets.len()
    }

    /// Displacement of a facet wall, or of the rows of an inlet, at a time `[m]`.
    pub(super) fn place(&self, wall: usize, time: f64) -> Vector<D> {
        match wall.checked_sub(self.first_inlet()) {
            Some(inlet) => self.inlets[inlet].displacement(time, self.books.inflow.inlets[inlet].rows),
            None => self.walls[wall].motion.displacement(time) + self.by_load(wall, |travel| travel.distance),
        }
    }

    /// Pose of a facet wall, or of the rows of an inlet, at a time.
    pub(super) fn pose(&self, wall: usize, time: f64) -> Pose<D> {
        Pose { shift: self.place(wall, time), ..self.walls[wall].motion.pose(time) }
    }

    /// Velocity of a facet wall without its turn, or of the rows of an inlet, right after a time `[m/s]`.
    pub(crate) fn velocity(&self, wall: usize, time: f64) -> Vector<D> {
        match wall.checked_sub(self.first_inlet()) {
            Some(inlet) => self.inlets[inlet].direction() * self.inlets[inlet].speed(time),
            None => self.walls[wall].motion.velocity(time) + self.by_load(wall, |travel| travel.speed),
        }
    }

    /// What a wall has of a distance or a speed along its load; zero without one.
    fn by_load(&self, wall: usize, part: impl Fn(&WallTravel) -> f64) -> Vector<D> {
        let load = self.walls[wall].motion.load.as_ref();
        load.map_or_else(Vector::zeros, |load| load.direction * part(&self.books.travels[wall]))
    }

    /// Identity of the next particle that an inlet sets free.
    pub(super) fn next_identity(&self) -> u32 {
        self.begun + self.books.inflow.particles() as u32
    }

    /// Adds the impulses of a step, in the order of the blocks.
    pub(super) fn close_impulses(&mut self) {
        for block in self.blocks.chunks_exact_mut(self.walls.len().max(1)) {
            let sums = self.books.impulses.iter_mut().zip(&mut self.books.moments);
            for ((impulse, moment), own) in sums.zip(block) {
                let WallImpulse { linear, angular } = std::mem::replace(own, WallImpulse::none());
                *impulse += linear;
                *moment += angular;
            }
        }
    }
}

impl<const D: usize> Books<D> {
    /// Checks the rows that inlets have released into a flow, given its number of particles. Returns the number of all particles.
    ///
    /// # Errors
    /// Rows of other inlets than these.
    pub(crate) fn check_rows(&self, inlets: &[Inlet<D>], flow: usize) -> Result<usize, ForeignState> {
        ForeignState::check("inlets", self.inflow.inlets.len(), inlets.len())?;
        let cells = |inlet: usize| inlets.get(inlet).map_or(0, |inlet| inlet.cells.len() as u64);
        let mut rows = vec![0; inlets.len()];
        let mut next = flow as u64;
        let mut sound = true;
        for row in &self.inflow.rows {
            let inlet = row.inlet as usize;
            sound &= inlet < inlets.len() && u64::from(row.first) == next;
            next = next.saturating_add(cells(inlet));
            rows.get_mut(inlet).into_iter().for_each(|rows| *rows += 1);
        }
        let counted = |(inlet, rows): (usize, &u64)| {
            let fed = &self.inflow.inlets[inlet];
            fed.rows == *rows && fed.particles == rows.saturating_mul(cells(inlet))
        };
        sound &= rows.iter().enumerate().all(counted);
        ForeignState::check("whole sets of rows", usize::from(sound), 1)?;
        Ok(next as usize)
    }
}
