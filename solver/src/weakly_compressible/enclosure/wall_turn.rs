//! Walls that turn: about a point in the plane, about an axis in space, by angles over time.

use super::pose::Pose;
use super::time_table::{is_sound, slope_at, value_at};
use crate::vector::Vector;

/// Error of unit vectors across each other `[-]`.
const ROUNDING: f64 = 1e-9;

/// Angles of a wall over time, linear between the times and constant beyond them.
#[derive(Debug, Clone, PartialEq)]
pub struct WallTurn<const D: usize> {
    /// A place on the axis `[m]`.
    pub centre: Vector<D>,
    /// Unit vectors across the axis, of which the first turns towards the second `[-]`.
    pub plane: [Vector<D>; 2],
    /// Times `[s]`, rising.
    pub times: Vec<f64>,
    /// Angles `[rad]` at these times, as many, shape `[times][1]`.
    pub angles: Vec<Vector<1>>,
}

impl<const D: usize> WallTurn<D> {
    /// Angle at a time `[rad]`.
    #[must_use]
    pub fn angle(&self, time: f64) -> f64 {
        value_at(&self.times, &self.angles, time)[0]
    }

    /// Rate right after a time `[rad/s]`.
    pub(super) fn rate(&self, time: f64) -> f64 {
        slope_at(&self.times, &self.angles, time).map_or(0.0, |slope| slope[0])
    }

    /// Pose at a time without displacement.
    pub(super) fn pose(&self, time: f64) -> Pose<D> {
        Pose { centre: self.centre, plane: self.plane, angle: libm::sincos(self.angle(time)), ..Pose::start() }
    }

    /// The largest speed that some places ever have `[m/s]`.
    pub(super) fn largest_speed<'a>(&self, places: impl Iterator<Item = &'a Vector<D>>) -> f64 {
        let pose = self.pose(0.0);
        let radius = places.map(|place| pose.lever(place).norm()).fold(0.0, f64::max);
        self.times.iter().map(|time| self.rate(*time).abs() * radius).fold(0.0, f64::max)
    }

    /// Whether times rise from the start, all is finite and the axis has a direction.
    pub(super) fn is_sound(&self) -> bool {
        let [first, second] = self.plane;
        let unit = |one: &Vector<D>| (one.norm() - 1.0).abs() < ROUNDING;
        let plane = unit(&first) && unit(&second) && first.dot(&second).abs() < ROUNDING;
        plane && self.centre.sum().is_finite() && is_sound(&self.times, &self.angles) && self.angle(0.0) == 0.0
    }
}
