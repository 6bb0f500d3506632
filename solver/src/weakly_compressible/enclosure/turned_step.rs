//! Walls that turn in a step: places, normals and velocities of their particles.

use super::boundary_state::BoundaryState;
use crate::domain::Domain;
use crate::weakly_compressible::Particles;

impl<const D: usize> BoundaryState<D> {
    /// Rate of a facet wall right after a time `[rad/s]`.
    pub(super) fn rate(&self, wall: usize, time: f64) -> f64 {
        self.walls[wall].motion.turn.as_ref().map_or(0.0, |turn| turn.rate(time))
    }

    /// Puts the particles of walls that turn where these are, at a time `[s]`. They have the velocity of the surface in front of them, and
    /// the forces on the flow act there.
    pub(crate) fn turn(&self, particles: &mut Particles<D>, domain: &Domain<D>, time: f64) {
        let flow = particles.flow_count();
        for (wall, begun) in self.turning.iter().enumerate() {
            let (pose, velocity, rate) = (&self.poses[wall], self.velocity(wall, time), self.rate(wall, time));
            let spin = pose.spin() * rate;
            for (index, start) in (self.first_particles[wall]..).zip(begun) {
                let (place, normal) = (pose.place(&start.position), pose.direction(&start.normal));
                let surface = place + normal * start.depth;
                // it may have wrapped at periodic sides
                let position = &mut particles.position[flow + index];
                *position += domain.shortest(place - *position);
                let walls = &mut particles.walls;
                walls.normal[index] = normal;
                walls.lever[index] = pose.lever(&surface);
                walls.velocity[index] = velocity + walls.lever[index] * rate;
                walls.spin[index] = spin;
            }
        }
    }
}
