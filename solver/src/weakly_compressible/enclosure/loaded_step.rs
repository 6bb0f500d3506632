//! Walls under loads in a step: their velocities.

use super::boundary_state::BoundaryState;
use crate::vector::Vector;
use crate::weakly_compressible::{Images, Particles};

impl<const D: usize> BoundaryState<D> {
    /// Steps the velocities of walls under loads from a time on `[s]`; their particles follow with the positions of the flow.
    pub(crate) fn press(&mut self, particles: &mut Particles<D>, images: &Images<D>, (time, time_step): (f64, f64)) {
        for wall in 0..self.walls.len() {
            let Some(load) = &self.walls[wall].motion.load else { continue };
            let given = self.books.impulses[wall].dot(&load.direction);
            self.books.travels[wall].advance(load, given, time_step);
            let (velocity, rate) = (self.velocity(wall, time), self.rate(wall, time));
            particles.move_walls(self.plane_walls + wall, &[Vector::zeros()], |_, lever| velocity + lever * rate);
            images.copy_wall_vectors(&mut particles.walls.velocity);
        }
    }
}
