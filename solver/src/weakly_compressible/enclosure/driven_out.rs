//! Ends of walls that loads move or that turn: out of the domain, into another wall, faster than sound.

use super::boundary_state::BoundaryState;
use super::facet_wall::FacetWall;
use super::wall_load::ROUNDING;
use crate::run::NO_PARTICLE;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{OutOfRange, Quantity};

impl<const D: usize> BoundaryState<D> {
    /// The first wall that its load or its turn has driven faster than sound `[m/s]`, out of the domain or into another wall since it was
    /// looked for last.
    pub(crate) fn find_driven_out(&mut self, sound_speed: f64, time: f64) -> Option<OutOfRange> {
        let mut ends = (0..self.walls.len()).map(|wall| (wall, self.end_of(wall, sound_speed)));
        let found = ends.find_map(|(wall, end)| Some((wall, end?)));
        self.earlier.clone_from(&self.poses);
        let (index, end) = found?;
        let FacetWall { name, motion, .. } = &self.walls[index];
        let (measure, how, value) = match &motion.turn {
            Some(turn) => (("angle of a wall", "rad"), "turns and", turn.angle(time)),
            None => (("travel of a wall", "m"), "under its load", self.books.travels[index].distance),
        };
        let quantity = Quantity::DrivenWall { measure, end: format!("`{name}` {how} {end}") };
        Some(OutOfRange { index: 0, identity: NO_PARTICLE, quantity, value })
    }

    fn end_of(&self, wall: usize, sound_speed: f64) -> Option<String> {
        let motion = &self.walls[wall].motion;
        if motion.load.is_none() && motion.turn.is_none() {
            return None;
        }
        let speed = self.books.travels[wall].speed;
        if speed.abs() > sound_speed {
            return Some(format!("moves at {speed:.4e} m/s, faster than sound"));
        }
        let leaves = |corner: &Vector<D>| {
            let is_out = |place: Vector<D>| self.exits.side(&place).is_some();
            is_out(self.poses[wall].place(corner)) && !is_out(self.earlier[wall].place(corner))
        };
        if self.walls[wall].facets.iter().flat_map(|facet| &facet.corners).any(leaves) {
            return Some("leaves the domain by an open side".to_owned());
        }
        let meets = |other: &usize| *other != wall && (self.is_passed(*other, wall) || self.is_passed(wall, *other));
        let other = (0..self.walls.len()).find(meets)?;
        Some(format!("meets `{}`", self.walls[other].name))
    }

    /// Whether a corner of a wall has passed a facet of another one from its front, as that one has seen it.
    fn is_passed(&self, facets: usize, corners: usize) -> bool {
        let tolerance = ROUNDING * self.range;
        self.walls[corners].facets.iter().flat_map(|facet| &facet.corners).any(|corner| {
            let [start, end] =
                [&self.earlier, &self.poses].map(|poses| poses[facets].back(&poses[corners].place(corner), |way| way));
            self.grids[facets].near(&end).iter().any(|&index| {
                let facet = &self.walls[facets].facets[index as usize];
                let (before, after) = (facet.height(&start), facet.height(&end));
                let met = end - (end - start) * (after / (after - before));
                before >= -tolerance && after < -tolerance && (facet.nearest(&met) - met).norm() <= tolerance
            })
        })
    }
}
