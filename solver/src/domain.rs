//! The domain: what bounds it along each axis, and what a boundary does to a particle that has crossed it.

use crate::vector::{Tensor, Vector};
use serde::{Deserialize, Serialize};

/// Boundary of the domain along one axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AxisBoundary {
    /// Nothing: walls made of particles, or free space.
    Open,
    /// Period from `lower` to `upper` `[m]`.
    Periodic {
        /// Lower end `[m]`.
        lower: f64,
        /// Upper end `[m]`.
        upper: f64,
    },
    /// Mirror planes (free slip, symmetry) where given `[m]`.
    Mirror {
        /// Plane below the flow.
        lower: Option<f64>,
        /// Plane above the flow.
        upper: Option<f64>,
    },
}

/// The boundaries along every axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Domain<const D: usize> {
    /// Boundaries, one per axis.
    pub axes: [AxisBoundary; D],
}

impl<const D: usize> Domain<D> {
    /// A period along every axis, from a lower to an upper corner `[m]`.
    #[must_use]
    pub fn periodic(lower: [f64; D], upper: [f64; D]) -> Self {
        let axes = std::array::from_fn(|axis| AxisBoundary::Periodic { lower: lower[axis], upper: upper[axis] });
        Self { axes }
    }

    /// The period of an axis `[m]`, or without one the range of coordinates along it.
    pub(crate) fn extent(&self, axis: usize, coordinates: impl Iterator<Item = f64>) -> (f64, f64) {
        match self.axes[axis] {
            AxisBoundary::Periodic { lower, upper } => (lower, upper),
            AxisBoundary::Open | AxisBoundary::Mirror { .. } => {
                coordinates.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
            }
        }
    }

    /// Puts a position back into the period of every periodic axis.
    pub(crate) fn wrap(&self, position: &mut Vector<D>) {
        for (axis, boundary) in self.axes.iter().enumerate() {
            if let AxisBoundary::Periodic { lower, upper } = boundary {
                let length = upper - lower;
                let turns = ((position[axis] - lower) / length).floor();
                if turns != 0.0 {
                    position[axis] -= turns * length;
                }
            }
        }
    }

    /// The shortest of a way and its images along periodic axes.
    pub(crate) fn shortest(&self, mut way: Vector<D>) -> Vector<D> {
        for (part, boundary) in way.iter_mut().zip(&self.axes) {
            if let AxisBoundary::Periodic { lower, upper } = boundary {
                *part -= (*part / (upper - lower)).round() * (upper - lower);
            }
        }
        way
    }

    /// Exchanges a particle behind a mirror plane for its image in front of it: by symmetry the same flow. Without
    /// this a particle that the pressure squeezes through the plane would be lost to the flow.
    pub(crate) fn reflect(
        &self,
        position: &mut Vector<D>,
        velocity: &mut Vector<D>,
        velocity_gradient: &mut Tensor<D>,
        stress: &mut Tensor<D>,
    ) {
        for (axis, boundary) in self.axes.iter().enumerate() {
            let AxisBoundary::Mirror { lower, upper } = *boundary else { continue };
            let behind = |plane: &f64, side: f64| side * (position[axis] - plane) < 0.0;
            let lower = lower.filter(|plane| behind(plane, 1.0));
            let Some(plane) = lower.or(upper.filter(|plane| behind(plane, -1.0))) else { continue };
            position[axis] = 2.0 * plane - position[axis];
            velocity[axis] = -velocity[axis];
            for other in (0..D).filter(|&other| other != axis) {
                for tensor in [&mut *velocity_gradient, &mut *stress] {
                    tensor[(axis, other)] = -tensor[(axis, other)];
                    tensor[(other, axis)] = -tensor[(other, axis)];
                }
            }
        }
    }
}
