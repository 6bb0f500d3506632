//! Bodies of material: boxes, cylinders and balls, and the places that they hold.

use super::SpaceVector;
use crate::case::ParameterError;
use crate::enclosed::setting::{self, shown, vector};
use crate::enclosed::shapes;
use bagnold_solver::parameter::positive;
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A piece of the material at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "kebab-case")]
pub enum SpaceBody {
    /// A box along the axes.
    Box {
        /// Lower corner x, y, z `[m]`.
        lower: SpaceVector,
        /// Upper corner x, y, z `[m]`.
        upper: SpaceVector,
        /// Velocity at the start, x, y, z `[m/s]`.
        #[serde(default)]
        velocity: SpaceVector,
    },
    /// A cylinder.
    Cylinder {
        /// Middle of one end x, y, z `[m]`.
        from: SpaceVector,
        /// Middle of the other end x, y, z `[m]`.
        to: SpaceVector,
        /// Radius `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        radius: f64,
        /// Velocity at the start, x, y, z `[m/s]`.
        #[serde(default)]
        velocity: SpaceVector,
    },
    /// A ball.
    Sphere {
        /// Middle x, y, z `[m]`.
        centre: SpaceVector,
        /// Radius `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        radius: f64,
        /// Velocity at the start, x, y, z `[m/s]`.
        #[serde(default)]
        velocity: SpaceVector,
    },
}

impl setting::SceneBody<3> for SpaceBody {
    fn velocity(&self) -> Vector<3> {
        let (Self::Box { velocity, .. } | Self::Cylinder { velocity, .. } | Self::Sphere { velocity, .. }) = self;
        vector(velocity)
    }

    fn extent(&self) -> (Vector<3>, Vector<3>) {
        match self {
            Self::Box { lower, upper, .. } => (vector(lower), vector(upper)),
            Self::Cylinder { from, to, radius, .. } => {
                let (from, to) = (vector::<3>(from), vector(to));
                let axis = (to - from).normalize();
                let beside = axis.map(|part| radius * (1.0 - part * part).max(0.0).sqrt());
                (from.inf(&to) - beside, from.sup(&to) + beside)
            }
            Self::Sphere { centre, radius, .. } => shapes::around_ball(&vector(centre), *radius),
        }
    }

    fn volume(&self) -> f64 {
        match self {
            Self::Box { lower, upper, .. } => shapes::box_volume::<3>(&vector(lower), &vector(upper)),
            Self::Cylinder { from, to, radius, .. } => {
                let (from, to) = (vector::<3>(from), vector(to));
                PI * radius * radius * (to - from).norm()
            }
            Self::Sphere { radius, .. } => 4.0 / 3.0 * PI * radius.powi(3),
        }
    }

    fn is_box(&self) -> bool {
        matches!(self, Self::Box { .. })
    }

    fn holds(&self, place: &Vector<3>) -> bool {
        match self {
            Self::Box { lower, upper, .. } => shapes::box_holds(&vector(lower), &vector(upper), place),
            Self::Cylinder { from, to, radius, .. } => {
                let from: Vector<3> = vector(from);
                let axis = vector(to) - from;
                let part = (place - from).dot(&axis) / axis.norm_squared();
                (0.0..1.0).contains(&part) && (place - from - axis * part).norm_squared() <= radius * radius
            }
            Self::Sphere { centre, radius, .. } => shapes::ball_holds(&vector(centre), *radius, place),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let shown = |place: &SpaceVector| shown(&vector::<3>(place));
        match self {
            Self::Box { lower, upper, .. } if !shapes::has_inside::<3>(&vector(lower), &vector(upper)) => {
                let rule = "greater than `lower` along x, y and z";
                Err(ParameterError::field("upper", shown(upper), rule, "give the corner that is opposite to `lower`"))
            }
            Self::Cylinder { from, to, .. } if from == to => {
                Err(ParameterError::field("to", shown(to), "different from `from`", "give the centres of both ends"))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::filling::depth;
    use crate::enclosed::setting::SceneBody as _;

    #[test]
    fn bodies_hold_what_is_inside_and_their_boxes_hold_them() {
        let velocity = (0.0, 0.0, 0.0);
        let cuboid = SpaceBody::Box { lower: (0.0, 0.0, 0.0), upper: (1.0, 2.0, 3.0), velocity };
        let cylinder = SpaceBody::Cylinder { from: (0.0, 0.0, 0.0), to: (3.0, 0.0, 4.0), radius: 1.0, velocity };
        let ball = SpaceBody::Sphere { centre: (1.0, 1.0, 1.0), radius: 0.5, velocity };
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
        let flat = SpaceBody::Box { lower: (0.0, 0.0, 0.0), upper: (1.0, 0.0, 1.0), velocity };
        assert_eq!(
            flat.check().expect_err("flat").to_string(),
            "`upper` is (1, 0, 1), but must be greater than `lower` along x, y and z; give the corner that is opposite to \
             `lower`"
        );
    }
}
