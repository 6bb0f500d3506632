//! A wall of facets of any shape, at rest, moved along by a table of times, turned, or under a load.

use super::facet::Facet;
use super::pose::Pose;
use super::time_table::{is_sound, slope_at, value_at};
use super::wall_load::WallLoad;
use super::wall_turn::WallTurn;
use crate::vector::Vector;
use crate::weakly_compressible::Surface;

/// Side of a polyline on which the flow is, seen along its points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// One dummy particle behind a facet wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BackingParticle<const D: usize> {
    /// Position at the start `[m]`.
    pub position: Vector<D>,
    /// Normal of its facet into the flow `[-]`.
    pub normal: Vector<D>,
    /// Depth behind the plane of its facet `[m]`.
    pub depth: f64,
    /// Share of the space behind the facet wall `[m^D]`.
    pub volume: f64,
}

/// Displacements of a wall over time, linear between the times and constant beyond them, a turn, and a load that moves it further.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion<const D: usize> {
    /// Times `[s]`, rising.
    pub times: Vec<f64>,
    /// Displacements `[m]` at these times, as many.
    pub displacements: Vec<Vector<D>>,
    /// Turn of the wall, applied before its displacement.
    pub turn: Option<WallTurn<D>>,
    /// Load under which the wall moves freely.
    pub load: Option<WallLoad<D>>,
}

impl<const D: usize> Motion<D> {
    /// Whether it ever moves.
    #[must_use]
    pub fn is_rest(&self) -> bool {
        self.times.len() < 2 && self.load.is_none() && self.turn.is_none()
    }

    /// Displacement by the table at a time `[m]`.
    #[must_use]
    pub fn displacement(&self, time: f64) -> Vector<D> {
        value_at(&self.times, &self.displacements, time)
    }

    /// Pose by the tables at a time.
    #[must_use]
    pub fn pose(&self, time: f64) -> Pose<D> {
        let turned = self.turn.as_ref().map_or_else(Pose::start, |turn| turn.pose(time));
        Pose { shift: self.displacement(time), ..turned }
    }

    /// Velocity by the table right after a time `[m/s]`, without that of the turn.
    #[must_use]
    pub fn velocity(&self, time: f64) -> Vector<D> {
        slope_at(&self.times, &self.displacements, time).unwrap_or_else(Vector::zeros)
    }

    /// The largest speed that it ever has relative to a velocity `[m/s]`, between the first and the last of its times, without that of the
    /// turn.
    #[must_use]
    pub fn largest_speed(&self, frame: &Vector<D>) -> f64 {
        let rest = if self.times.len() < 2 { frame.norm() } else { 0.0 };
        let slopes = self.times.iter().filter_map(|time| slope_at(&self.times, &self.displacements, *time));
        slopes.map(|slope| (slope - frame).norm()).fold(rest, f64::max)
    }

    /// Whether times rise and all is finite.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        is_sound(&self.times, &self.displacements)
    }
}

/// A wall of facets.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetWall<const D: usize> {
    /// Name in messages and results.
    pub name: String,
    /// Facets at the start, with the flow on the side of their normals.
    pub facets: Vec<Facet<D>>,
    /// Rough or smooth.
    pub roughness: Surface,
    /// Motion from the start.
    pub motion: Motion<D>,
}

impl<const D: usize> FacetWall<D> {
    /// The largest speed of its rim by its turn `[m/s]`.
    #[must_use]
    pub fn rim_speed(&self) -> f64 {
        let corners = self.facets.iter().flat_map(|facet| &facet.corners);
        self.motion.turn.as_ref().map_or(0.0, |turn| turn.largest_speed(corners))
    }
}

impl FacetWall<2> {
    /// The wall along a polyline `[m]`, at rest and rough; points that repeat are left out.
    #[must_use]
    pub fn polyline(name: &str, points: &[Vector<2>], flow: Side) -> Self {
        let ends = points.windows(2);
        let facets = match flow {
            Side::Left => ends.filter_map(|ends| Facet::segment(ends[0], ends[1])).collect(),
            Side::Right => ends.rev().filter_map(|ends| Facet::segment(ends[1], ends[0])).collect(),
        };
        let (roughness, motion) = (Surface::Rough, Motion::default());
        Self { name: name.to_owned(), facets, roughness, motion }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_of_times_moves_between_its_rows_and_rests_beyond_them() {
        let up = |y: f64| Vector::<2>::new(0.0, y);
        let displacements = vec![up(0.0), up(0.3), up(0.3)];
        let motion = Motion { times: vec![0.1, 0.2, 0.4], displacements, ..Motion::default() };
        assert!(motion.is_sound() && !motion.is_rest());
        for (time, place, speed) in [(0.0, 0.0, 0.0), (0.15, 0.15, 3.0), (0.3, 0.3, 0.0), (9.0, 0.3, 0.0)] {
            assert!((motion.displacement(time) - up(place)).norm() < 1e-15, "{time}");
            assert!((motion.velocity(time) - up(speed)).norm() < 1e-14, "{time}");
        }
        assert!((motion.largest_speed(&up(0.0)) - 3.0).abs() < 1e-14);
        assert!((motion.largest_speed(&up(2.0)) - 2.0).abs() < 1e-14, "where it rests");
        let backwards = Motion { times: vec![0.2, 0.1], displacements: vec![up(0.0); 2], ..Motion::default() };
        assert!(!backwards.is_sound() && Motion::<2>::default().is_rest());
    }

    #[test]
    fn the_flow_is_on_the_side_that_was_named() {
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0]].map(Vector::<2>::from);
        let left = FacetWall::polyline("corner", &points, Side::Left);
        assert_eq!(left.facets.len(), 2);
        assert!(left.facets[0].normal == Vector::<2>::new(0.0, 1.0));
        let right = FacetWall::polyline("corner", &points, Side::Right);
        assert!(right.facets[1].normal == Vector::<2>::new(0.0, -1.0));
        assert!(right.facets[0].corners == [points[3], points[1]]);
    }
}
