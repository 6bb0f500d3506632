//! Pose of a wall: what was somewhere at the start is turned about an axis and then displaced.
//!
//! x = c + R (x_0 − c) + d, R r = r + (cos θ − 1) (a e_1 + b e_2) + sin θ (a e_2 − b e_1), a = r·e_1, b = r·e_2
//!
//! with a place c on the axis, the angle θ from e_1 to e_2, unit vectors across the axis, and the displacement d. Places follow from those
//! at the start, so that no radius drifts.

use crate::vector::{Tensor, Vector};

/// Turn of a wall from the start and its displacement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<const D: usize> {
    /// Displacement `[m]`.
    pub shift: Vector<D>,
    /// A place on the axis `[m]`.
    pub centre: Vector<D>,
    /// Unit vectors across the axis, of which the first turns towards the second `[-]`; zero of a wall that does not turn.
    pub plane: [Vector<D>; 2],
    /// Sine and cosine of the angle `[-]`.
    pub angle: (f64, f64),
}

impl<const D: usize> Pose<D> {
    /// Pose at the start of a wall that does not turn.
    pub(super) fn start() -> Self {
        Self { shift: Vector::zeros(), centre: Vector::zeros(), plane: [Vector::zeros(); 2], angle: (0.0, 1.0) }
    }

    /// Present place of what was somewhere at the start `[m]`.
    #[must_use]
    pub fn place(&self, start: &Vector<D>) -> Vector<D> {
        self.centre + self.direction(&(start - self.centre)) + self.shift
    }

    /// Place at the start of what is somewhere now `[m]`; `image` gives the way from the axis to that image of it which is meant.
    #[must_use]
    pub fn back(&self, place: &Vector<D>, image: impl Fn(Vector<D>) -> Vector<D>) -> Vector<D> {
        self.centre + self.direction_back(&image(place - self.shift - self.centre))
    }

    /// Present direction of what had a direction at the start.
    pub(super) fn direction(&self, start: &Vector<D>) -> Vector<D> {
        let ([first, second], (sine, cosine)) = (self.plane, self.angle);
        let across = first * start.dot(&first) + second * start.dot(&second);
        start + across * (cosine - 1.0) + self.turned(start) * sine
    }

    /// Direction at the start of what has a direction now.
    pub(super) fn direction_back(&self, now: &Vector<D>) -> Vector<D> {
        Self { angle: (-self.angle.0, self.angle.1), ..*self }.direction(now)
    }

    /// Displacement per angle of what is somewhere now `[m]`: its velocity over the rate, and the lever of forces there.
    pub(super) fn lever(&self, place: &Vector<D>) -> Vector<D> {
        self.turned(&(place - self.shift - self.centre))
    }

    /// Velocity gradient over the rate: W with W r the lever of a way r from the axis `[-]`.
    pub(super) fn spin(&self) -> Tensor<D> {
        let [first, second] = self.plane;
        second * first.transpose() - first * second.transpose()
    }

    /// Part of a way across the axis, turned by a right angle.
    fn turned(&self, way: &Vector<D>) -> Vector<D> {
        let [first, second] = self.plane;
        second * way.dot(&first) - first * way.dot(&second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pose_keeps_lengths_and_goes_back() {
        let axis = Vector::<3>::new(2.0, -1.0, 2.0) / 3.0;
        let first = Vector::<3>::new(1.0, 2.0, 0.0).normalize();
        let centre = Vector::<3>::new(0.3, -0.2, 0.1);
        for angle in [0.0, 0.7, -2.0, 1e6] {
            let (shift, plane) = (Vector::<3>::new(0.0, 0.5, 0.0), [first, axis.cross(&first)]);
            let pose = Pose { shift, centre, plane, angle: libm::sincos(angle) };
            let start = Vector::<3>::new(1.0, 0.4, -0.7);
            let place = pose.place(&start);
            let expected = nalgebra::Rotation3::new(axis * angle) * (start - centre) + centre + pose.shift;
            assert!((place - expected).norm() < 1e-9, "{angle}");
            assert!((pose.back(&place, |way| way) - start).norm() < 1e-15, "{angle}");
            let lever = axis.cross(&(place - pose.shift - centre));
            assert!((pose.lever(&place) - lever).norm() < 1e-15);
            assert!((pose.spin() * (place - pose.shift - centre) - lever).norm() < 1e-15);
            assert!((pose.direction_back(&pose.direction(&start)) - start).norm() < 1e-15);
        }
    }
}
