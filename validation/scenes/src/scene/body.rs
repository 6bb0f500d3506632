//! Bodies of material: boxes, polygons and discs, and the places that they hold.

use super::PlaneVector;
use crate::case::ParameterError;
use crate::enclosed::setting::{self, shown, vector};
use crate::enclosed::shapes;
use bagnold_solver::parameter::{filled, positive};
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A piece of the material at the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "kebab-case")]
pub enum PlaneBody {
    /// A rectangle along the axes.
    Box {
        /// Lower left corner x, y `[m]`.
        lower: PlaneVector,
        /// Upper right corner x, y `[m]`.
        upper: PlaneVector,
        /// Velocity at the start, x, y `[m/s]`.
        #[serde(default)]
        velocity: PlaneVector,
    },
    /// A disc.
    Disc {
        /// Middle x, y `[m]`.
        centre: PlaneVector,
        /// Radius `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        radius: f64,
        /// Velocity at the start, x, y `[m/s]`.
        #[serde(default)]
        velocity: PlaneVector,
    },
    /// Area that a closed polyline encloses.
    Polygon {
        /// Corners x, y `[m]`, the last of which is joined to the first.
        #[schemars(transform = filled("three corners or more", "add the missing ones"))]
        points: Vec<PlaneVector>,
        /// Velocity at the start, x, y `[m/s]`.
        #[serde(default)]
        velocity: PlaneVector,
    },
}

impl setting::SceneBody<2> for PlaneBody {
    fn velocity(&self) -> Vector<2> {
        let (Self::Box { velocity, .. } | Self::Disc { velocity, .. } | Self::Polygon { velocity, .. }) = self;
        vector(velocity)
    }

    fn extent(&self) -> (Vector<2>, Vector<2>) {
        match self {
            Self::Box { lower, upper, .. } => (vector(lower), vector(upper)),
            Self::Disc { centre, radius, .. } => shapes::around_ball(&vector(centre), *radius),
            Self::Polygon { points, .. } => shapes::around(points.iter().map(vector)),
        }
    }

    fn volume(&self) -> f64 {
        match self {
            Self::Box { lower, upper, .. } => shapes::box_volume::<2>(&vector(lower), &vector(upper)),
            Self::Disc { radius, .. } => PI * radius * radius,
            Self::Polygon { points, .. } => {
                let next = points.iter().cycle().skip(1);
                let twice: f64 = points.iter().zip(next).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum();
                0.5 * twice.abs()
            }
        }
    }

    fn is_box(&self) -> bool {
        matches!(self, Self::Box { .. })
    }

    fn holds(&self, place: &Vector<2>) -> bool {
        match self {
            Self::Box { lower, upper, .. } => shapes::box_holds(&vector(lower), &vector(upper), place),
            Self::Disc { centre, radius, .. } => shapes::ball_holds(&vector(centre), *radius, place),
            Self::Polygon { points, .. } => {
                // a ray to the right crosses its sides an odd number of times
                let corner = |k: usize| vector::<2>(&points[k % points.len()]);
                let ends = (0..points.len()).map(|k| (corner(k), corner(k + 1)));
                let crossed = ends.filter(|(a, b)| {
                    let across = (a[1] > place[1]) != (b[1] > place[1]);
                    across && place[0] < a[0] + (b[0] - a[0]) * (place[1] - a[1]) / (b[1] - a[1])
                });
                crossed.count() % 2 == 1
            }
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let refused = |field, value: String, rule, remedy| Err(ParameterError::field(field, value, rule, remedy));
        match self {
            Self::Box { lower, upper, .. } if !shapes::has_inside::<2>(&vector(lower), &vector(upper)) => {
                let rule = "above and to the right of `lower`";
                refused("upper", shown(&[upper.0, upper.1]), rule, "give the upper right corner")
            }
            Self::Polygon { points, .. } if points.len() < 3 => {
                refused("points", format!("{} corners", points.len()), "three corners or more", "add the missing ones")
            }
            Self::Polygon { points, .. } => check_crossing(points, true),
            _ => Ok(()),
        }
    }
}

/// Refuses lines that cross each other: inside and outside are then not those that are meant.
pub(super) fn check_crossing(points: &[PlaneVector], closed: bool) -> Result<(), ParameterError> {
    let corners: Vec<Vector<2>> = points.iter().map(vector).collect();
    let Some((one, other)) = shapes::crossing(&corners, closed) else { return Ok(()) };
    let defect = format!("the lines that begin at points[{one}] and points[{other}] cross");
    Err(ParameterError::field("points", defect, "", "give the corners in their order along the outline"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::filling::depth;
    use crate::enclosed::setting::SceneBody as _;

    #[test]
    fn bodies_hold_what_is_inside() {
        let velocity = (0.0, 0.0);
        let triangle = PlaneBody::Polygon { points: vec![(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)], velocity };
        let disc = PlaneBody::Disc { centre: (1.0, 1.0), radius: 0.5, velocity };
        let square = PlaneBody::Box { lower: (-1.0, -1.0), upper: (0.0, 0.0), velocity };
        for (body, inside, outside) in
            [(&triangle, [0.5, 0.5], [1.5, 1.5]), (&disc, [1.3, 1.3], [1.4, 1.4]), (&square, [-0.5, -0.5], [0.1, -0.5])]
        {
            assert!(body.holds(&inside.into()) && !body.holds(&outside.into()), "{body:?}");
            assert!(body.check().is_ok());
        }
        let areas = [(&triangle, 2.0), (&disc, 0.25 * PI), (&square, 1.0)];
        assert!(areas.iter().all(|(body, area)| (body.volume() - area).abs() < 1e-12));
        let bodies = [square, triangle];
        let up = Vector::<2>::new(0.0, 1.0);
        assert!((depth(&bodies, &[-0.5, -0.75].into(), &up, 0.1) - 0.75).abs() < 0.02);
        assert!((depth(&bodies, &[0.5, 0.5].into(), &up, 0.1) - 1.0).abs() < 0.02);
        let flat = PlaneBody::Box { lower: (0.0, 0.0), upper: (1.0, 0.0), velocity };
        assert_eq!(
            flat.check().expect_err("flat").to_string(),
            "`upper` is (1, 0), but must be above and to the right of `lower`; give the upper right corner"
        );
    }
}
