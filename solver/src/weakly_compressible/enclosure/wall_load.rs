//! Walls under a load: a force presses a wall along one direction, in which it moves freely.
//!
//! M dV/dt = F − R − M r V
//!
//! with the mass M, the force F of the load, the force R of the flow and the rate r of a damper that takes nothing at rest. Gravity does not
//! act on the wall. The velocity of a step follows from the impulses that the wall has given to the flow since the last one, contacts of
//! that step included: over a run their sum is the impulse of the load and the damper less the momentum of the wall, up to rounding.

use super::boundary_state::BoundaryState;
use super::facet::Facet;
use crate::run::NO_PARTICLE;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{OutOfRange, Quantity};
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::walls::Images;
use serde::{Deserialize, Serialize};

/// Distance behind a facet from which on a corner has passed it, over the range of contact `[-]`: walls slide along each other.
const PASSED: f64 = 1e-6;

/// Load on a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallLoad<const D: usize> {
    /// Unit vector along which it presses and the wall moves `[-]`.
    pub direction: Vector<D>,
    /// Force `[N]`, per metre of depth in 2-D.
    pub force: f64,
    /// Mass of the wall `[kg]`, per metre of depth in 2-D.
    pub mass: f64,
    /// Rate of the damper `[1/s]`.
    pub damping: f64,
    /// Travel from the place of the facets to the start `[m]`.
    pub travel: f64,
}

impl<const D: usize> WallLoad<D> {
    /// Whether it can move a wall.
    pub(super) fn is_sound(&self) -> bool {
        let finite = self.force.is_finite() && self.travel.is_finite() && self.damping >= 0.0;
        finite && self.mass > 0.0 && (self.direction.norm() - 1.0).abs() < PASSED
    }
}

/// State of a wall under a load; zero of other walls.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct WallTravel {
    /// Distance from the place of the facets `[m]`.
    pub(super) distance: f64,
    /// `[m/s]`
    pub(super) speed: f64,
    /// Impulse along the load that the flow had got at the last step `[kg m/s]`.
    given: f64,
}

impl WallTravel {
    /// Start under a load.
    pub(super) fn of<const D: usize>(load: Option<&WallLoad<D>>) -> Self {
        Self { distance: load.map_or(0.0, |load| load.travel), ..Self::default() }
    }

    /// Takes a step `[s]`, after the flow has got an impulse along the load `[kg m/s]`.
    fn advance<const D: usize>(&mut self, load: &WallLoad<D>, given: f64, time_step: f64) {
        let pushed = load.force * time_step - (given - self.given);
        self.speed = (self.speed + pushed / load.mass) / (1.0 + load.damping * time_step);
        self.distance += self.speed * time_step;
        self.given = given;
    }
}

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
        let tolerance = PASSED * self.range;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_load_falls_freely_and_a_damper_ends_at_its_speed() {
        let load =
            WallLoad::<2> { direction: Vector::<2>::new(0.0, -1.0), force: 6.0, mass: 2.0, damping: 0.0, travel: 0.5 };
        let mut travel = WallTravel::of(Some(&load));
        (0..1000).for_each(|_| travel.advance(&load, 0.0, 1e-3));
        assert!((travel.speed - 3.0).abs() < 1e-12 && (travel.distance - 2.0).abs() < 2e-3, "{travel:?}");
        // an impulse to the flow is the wall's loss
        travel.advance(&load, 6.0, 0.0);
        assert!(travel.speed.abs() < 1e-12);
        let damped = WallLoad { damping: 1e3, ..load };
        (0..100).for_each(|_| travel.advance(&damped, 6.0, 1e-2));
        assert!((travel.speed - 3e-3).abs() < 1e-9, "F/(M r): {travel:?}");
    }
}
