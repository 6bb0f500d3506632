//! Bodies of material: boxes, cylinders and balls, and the places in them that particles start from.

use super::{Place, vector};
use crate::case::ParameterError;
use bagnold_solver::parameter::positive;
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A piece of the material at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "kebab-case")]
pub enum Body {
    /// A box along the axes.
    Box {
        /// Lower corner x, y, z `[m]`.
        lower: Place,
        /// Upper corner x, y, z `[m]`.
        upper: Place,
        /// Velocity at the start, x, y, z `[m/s]`.
        #[serde(default)]
        velocity: Place,
    },
    /// A cylinder.
    Cylinder {
        /// Middle of one end x, y, z `[m]`.
        from: Place,
        /// Middle of the other end x, y, z `[m]`.
        to: Place,
        /// Its radius `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        radius: f64,
        /// Velocity at the start, x, y, z `[m/s]`.
        #[serde(default)]
        velocity: Place,
    },
    /// A ball.
    Sphere {
        /// Its middle x, y, z `[m]`.
        centre: Place,
        /// Its radius `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        radius: f64,
        /// Velocity at the start, x, y, z `[m/s]`.
        #[serde(default)]
        velocity: Place,
    },
}

impl Body {
    /// Velocity at the start `[m/s]`.
    pub(super) fn velocity(&self) -> Vector<3> {
        let (Self::Box { velocity, .. } | Self::Cylinder { velocity, .. } | Self::Sphere { velocity, .. }) = self;
        vector(velocity)
    }

    /// Lower and upper corner of its box `[m]`.
    pub(super) fn extent(&self) -> (Vector<3>, Vector<3>) {
        match self {
            Self::Box { lower, upper, .. } => (vector(lower), vector(upper)),
            Self::Cylinder { from, to, radius, .. } => {
                let (from, to) = (vector(from), vector(to));
                let axis = (to - from).normalize();
                let beside = axis.map(|part| radius * (1.0 - part * part).max(0.0).sqrt());
                (from.inf(&to) - beside, from.sup(&to) + beside)
            }
            Self::Sphere { centre, radius, .. } => {
                (vector(centre) - Vector::repeat(*radius), vector(centre) + Vector::repeat(*radius))
            }
        }
    }

    /// Whether it holds a place.
    pub(super) fn holds(&self, place: &Vector<3>) -> bool {
        match self {
            Self::Box { lower, upper, .. } => {
                let (lower, upper) = (vector(lower), vector(upper));
                (0..3).all(|axis| place[axis] >= lower[axis] && place[axis] < upper[axis])
            }
            Self::Cylinder { from, to, radius, .. } => {
                let (axis, from) = (vector(to) - vector(from), vector(from));
                let part = (place - from).dot(&axis) / axis.norm_squared();
                (0.0..1.0).contains(&part) && (place - from - axis * part).norm_squared() <= radius * radius
            }
            Self::Sphere { centre, radius, .. } => (place - vector(centre)).norm_squared() <= radius * radius,
        }
    }

    /// Refuses a body without an inside.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        let shown = |place: &Place| format!("({}, {}, {})", place.0, place.1, place.2);
        match self {
            Self::Box { lower, upper, .. } if !(vector(upper) - vector(lower)).iter().all(|edge| *edge > 0.0) => {
                let rule = "greater than `lower` along x, y and z";
                Err(ParameterError::field("upper", shown(upper), rule, "give the corner that is opposite to `lower`"))
            }
            Self::Cylinder { from, to, .. } if from == to => {
                Err(ParameterError::field("to", shown(to), "unlike `from`", "give the middles of both ends"))
            }
            _ => Ok(()),
        }
    }
}

/// Whether any body holds a place, and the first that does.
pub(super) fn holder<'a>(bodies: &'a [Body], place: &Vector<3>) -> Option<&'a Body> {
    bodies.iter().find(|body| body.holds(place))
}

/// Depth of a place below the surface of the material, against the direction `up`: as far as bodies reach `[m]`.
pub(super) fn depth(bodies: &[Body], place: &Vector<3>, up: &Vector<3>, spacing: f64) -> f64 {
    let step = 0.125 * spacing;
    let mut steps = 0.0;
    while holder(bodies, &(place + up * ((steps + 0.5) * step))).is_some() {
        steps += 1.0;
    }
    steps * step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_hold_what_is_inside_and_their_boxes_hold_them() {
        let velocity = (0.0, 0.0, 0.0);
        let cuboid = Body::Box { lower: (0.0, 0.0, 0.0), upper: (1.0, 2.0, 3.0), velocity };
        let cylinder = Body::Cylinder { from: (0.0, 0.0, 0.0), to: (3.0, 0.0, 4.0), radius: 1.0, velocity };
        let ball = Body::Sphere { centre: (1.0, 1.0, 1.0), radius: 0.5, velocity };
        for (body, inside, outside) in [
            (&cuboid, [0.5, 1.5, 2.5], [0.5, 2.5, 1.5]),
            (&cylinder, [1.5, 0.9, 2.0], [1.5, 1.1, 2.0]),
            (&cylinder, [0.7, 0.0, -0.4], [0.7, 0.0, -0.6]),
            (&ball, [1.3, 1.3, 1.2], [1.3, 1.3, 1.3]),
        ] {
            assert!(body.holds(&inside.into()) && !body.holds(&outside.into()), "{body:?}");
            let (lower, upper) = body.extent();
            assert!((0..3).all(|axis| lower[axis] <= inside[axis] && upper[axis] >= inside[axis]), "{body:?}");
            assert!(body.check().is_ok());
        }
        let (lower, upper) = cylinder.extent();
        assert!((lower - Vector::<3>::new(-0.8, -1.0, -0.6)).norm() < 1e-12, "{lower}");
        assert!((upper - Vector::<3>::new(3.8, 1.0, 4.6)).norm() < 1e-12, "{upper}");
        let up = Vector::<3>::new(0.0, 0.0, 1.0);
        assert!((depth(&[cuboid], &[0.5, 0.5, 2.0].into(), &up, 0.1) - 1.0).abs() < 0.02);
        let flat = Body::Box { lower: (0.0, 0.0, 0.0), upper: (1.0, 0.0, 1.0), velocity };
        assert_eq!(
            flat.check().expect_err("flat").to_string(),
            "`upper` is (1, 0, 1), but must be greater than `lower` along x, y and z; give the corner that is opposite to \
             `lower`"
        );
    }
}
