//! Walls under loads in a step: their velocities, and the end of a wall that its load has driven out.

use super::boundary_state::BoundaryState;
use super::facet::Facet;
use super::wall_load::{ROUNDING, WallLoad, WallTravel};
use crate::run::NO_PARTICLE;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{OutOfRange, Quantity};
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::walls::Images;

impl<const D: usize> BoundaryState<D> {
    /// Steps the velocities of walls under loads from a time on `[s]`; their particles follow with the positions of the flow.
    pub(crate) fn press(&mut self, particles: &mut Particles<D>, images: &Images<D>, (time, time_step): (f64, f64)) {
        for wall in 0..self.walls.len() {
            let Some(load) = &self.walls[wall].motion.load else { continue };
            let given = self.books.impulses[wall].dot(&load.direction);
            self.books.travels[wall].advance(load, given, time_step);
            let velocity = self.velocity(wall, time);
            particles.move_walls(self.plane_walls + wall, &[Vector::zeros()], |_| velocity);
            images.copy_wall_vectors(&mut particles.walls.velocity);
        }
    }

    /// The first wall that its load has driven faster than sound `[m/s]`, out of the domain or into another wall.
    pub(crate) fn find_driven_out(&self, sound_speed: f64) -> Option<OutOfRange> {
        let loads = self.walls.iter().enumerate().filter_map(|(wall, of)| Some((wall, of.motion.load.as_ref()?)));
        let found = |(wall, load): (usize, &WallLoad<D>)| {
            let WallTravel { distance, speed, .. } = self.books.travels[wall];
            let told = |end: String| (wall, distance, end);
            if speed.abs() > sound_speed {
                return Some(told(format!("moves at {speed:.4e} m/s, faster than sound")));
            }
            let way = load.direction * (distance - load.travel);
            let (shift, facets) = (self.displacements[wall], &self.walls[wall].facets);
            let leaves = |corner: &Vector<D>| {
                let place = corner + shift;
                self.exits.side(&place).is_some() && self.exits.side(&(place - way)).is_none()
            };
            if facets.iter().flat_map(|facet| &facet.corners).any(leaves) {
                return Some(told("leaves the domain by an open side".to_owned()));
            }
            let meets = |other: &usize| {
                let (theirs, shift) = (&self.walls[*other].facets, shift - self.displacements[*other]);
                *other != wall
                    && (self.is_passed(theirs, facets, shift, way) || self.is_passed(facets, theirs, -shift, -way))
            };
            let other = (0..self.walls.len()).find(meets)?;
            Some(told(format!("meets `{}`", self.walls[other].name)))
        };
        let (wall, value, end) = loads.filter_map(found).next()?;
        let wall = self.walls[wall].name.clone();
        Some(OutOfRange { index: 0, identity: NO_PARTICLE, quantity: Quantity::LoadedWall { wall, end }, value })
    }

    /// Whether a corner of facets, displaced by a shift `[m]`, has passed other facets from their front on the last way to it `[m]`.
    fn is_passed(&self, facets: &[Facet<D>], of: &[Facet<D>], shift: Vector<D>, way: Vector<D>) -> bool {
        let tolerance = ROUNDING * self.range;
        of.iter().flat_map(|facet| &facet.corners).any(|corner| {
            let place = corner + shift;
            facets.iter().any(|facet| {
                let (before, after) = (facet.height(&(place - way)), facet.height(&place));
                let met = place - way * (after / (after - before));
                before >= -tolerance && after < -tolerance && (facet.nearest(&met) - met).norm() <= tolerance
            })
        })
    }
}
