//! Facet walls and open sides in a step: impulses on the flow, contacts, outflow. The rows of inlets are facet walls here.

use super::boundary_set::Exits;
use super::boundary_state::BoundaryState;
use super::facet_contact::{self, Passed, Touch};
use crate::domain::Domain;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{OutOfRange, Quantity};
use crate::weakly_compressible::energy::energy_of;
use crate::weakly_compressible::numerics::Contact;
use crate::weakly_compressible::passes::shell_impulse::{self, Booking, NO_OWNER, WallImpulse};
use crate::weakly_compressible::{BLOCK, EnergyLedger, Images, Model, PairData, Particles};

impl<const D: usize> BoundaryState<D> {
    /// Removes the particles that have left the domain by an open side, at a time `[s]`.
    pub(crate) fn release(&mut self, particles: &mut Particles<D>, model: &Model<D>, time: f64) {
        let Self { exits, gone, books, .. } = self;
        if *exits == Exits::default() {
            return;
        }
        particles.keep_real();
        let flow = particles.flow_count();
        gone.clear();
        gone.extend(particles.position[..flow].iter().map(|place| exits.side(place).is_some()));
        if !gone.contains(&true) {
            return;
        }
        // in the order of the scene, so that the sums are those of any order in memory
        for index in particles.by_identity() {
            let Some(side) = exits.side(&particles.position[index]) else { continue };
            let outflow = &mut books.outflow.sides[side];
            outflow.particles += 1;
            outflow.mass += particles.mass[index];
            outflow.mass_times_time += particles.mass[index] * time;
            outflow.momentum += particles.velocity[index] * particles.mass[index];
            outflow.support += particles.support_impulse[index];
            outflow.energy += energy_of(particles, index, model);
        }
        particles.remove(gone);
    }

    /// Finds the facet walls of all particles, after a search.
    pub(crate) fn assign_owners(&mut self, particles: &Particles<D>, images: &Images<D>) {
        let Self { walls, owners, plane_walls, .. } = self;
        if walls.is_empty() {
            return;
        }
        let (flow, real) = (particles.flow_count(), particles.real_count());
        owners.clear();
        owners.resize(particles.position.len(), NO_OWNER);
        for index in flow..real {
            let wall = particles.wall[index - flow] as usize;
            owners[index] = wall.checked_sub(*plane_walls).map_or(NO_OWNER, |wall| wall as u32);
        }
        for image in 0..images.len() {
            owners[real + image] = owners[images.source(image)];
        }
    }

    /// Room for the impulses of a step on a flow with a number of particles. Without facet walls every block still has a slot.
    pub(crate) fn booking(&mut self, flow: usize) -> Booking<'_, D> {
        let walls = self.walls.len();
        self.blocks.resize(flow.div_ceil(BLOCK) * walls.max(1), WallImpulse::none());
        Booking { owners: &self.owners, walls, impulses: &mut self.blocks }
    }

    /// Books the forces of facet walls in a step.
    pub(crate) fn book_wall_forces(
        &mut self,
        model: &Model<D>,
        particles: &Particles<D>,
        pairs: &PairData<D>,
        time_step: f64,
    ) {
        if !self.walls.is_empty() {
            shell_impulse::run(model, particles, pairs, time_step, self.booking(particles.flow_count()));
            self.close_impulses();
        }
    }

    /// Closes the impulses of an implicit viscous step, which has left out a part of the flow's `[kg m/s]`.
    pub(crate) fn close_reaction(&mut self, unsolved: Vector<D>) {
        self.books.unsolved += unsolved;
        self.close_impulses();
    }

    /// Stops particles that approach a facet wall in a step from a time on `[s]`, with a friction `[-]`. Returns their largest speed
    /// `[m/s]` and the first particle that was found behind a wall; none without facet walls.
    pub(crate) fn touch(
        &mut self,
        (model, domain): (&Model<D>, &Domain<D>),
        particles: &mut Particles<D>,
        energy: &mut [EnergyLedger],
        friction: f64,
        (time, time_step): (f64, f64),
    ) -> Option<(f64, Option<OutOfRange>)> {
        if self.walls.is_empty() || model.numerics.contact == Contact::None {
            return None;
        }
        for wall in 0..self.walls.len() {
            let (way, turn) =
                (self.place(wall, time + time_step) - self.poses[wall].shift, &self.walls[wall].motion.turn);
            let angle = turn.as_ref().map_or(0.0, |turn| turn.angle(time + time_step) - turn.angle(time));
            self.velocities[wall] = (way / time_step, angle / time_step);
        }
        let Self { walls, grids, range, poses, velocities, blocks, .. } = self;
        let touch = Touch { domain, walls, grids, poses, velocities, range: *range, friction };
        let found = facet_contact::run(model, particles, energy, touch, time_step, blocks);
        self.close_impulses();
        let passed = found.passed.map(|(index, Passed { wall, distance })| OutOfRange {
            index,
            identity: particles.identity[index],
            quantity: Quantity::Penetration { wall: self.walls[wall].name.clone() },
            value: distance,
        });
        Some((found.largest.sqrt(), passed))
    }

    /// Moves the facet walls in a step `[s]` that ends at a time `[s]`; returns the speed of the fastest `[m/s]`.
    pub(crate) fn advance(
        &mut self,
        particles: &mut Particles<D>,
        (images, domain): (&Images<D>, &Domain<D>),
        (end, step): (f64, f64),
    ) -> f64 {
        if self.inlets.is_empty() && self.walls.iter().all(|wall| wall.motion.is_rest()) {
            return 0.0;
        }
        let mut fastest = 0.0_f64;
        for wall in 0..self.walls.len() {
            let next = self.pose(wall, end);
            self.last[wall] = next.shift - self.poses[wall].shift;
            self.poses[wall] = next;
            fastest = fastest.max(self.last[wall].norm() / step + self.rim_speeds[wall]);
        }
        particles.move_walls(self.plane_walls, &self.last, |wall, _| self.velocity(wall, end));
        self.turn(particles, domain, end);
        let walls = &mut particles.walls;
        for field in [&mut walls.velocity, &mut walls.normal, &mut walls.lever] {
            images.copy_wall_vectors(field);
        }
        images.copy_wall_tensors(&mut walls.spin);
        fastest
    }
}
