//! Walls of a scene: polylines, rough or smooth, at rest or moved by a table; and the sides of its domain.

use super::Place;
use super::body::vector;
use crate::case::ParameterError;
use crate::cases::enclosed::{DomainSide, sides};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::boundary::shell::{Motion, Shell, Side};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// On which side of a polyline the flow is, seen along its points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FlowSide {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

/// A wall. It has one side: behind it is nothing, so that a plate in the flow is given all around.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WallLine {
    /// Its name, by which gauges and messages call it.
    pub name: String,
    /// Its points x, y `[m]`.
    pub points: Vec<Place>,
    /// Whether its last point is joined to the first.
    #[serde(default)]
    pub closed: bool,
    /// Side of the flow, seen along the points.
    #[serde(default = "left")]
    pub flow: FlowSide,
    /// Whether the flow sticks to it or slides.
    #[serde(default = "rough")]
    pub surface: Surface,
    /// How it moves: time `[s]`, displacement along x `[m]` and along y `[m]`, linear between the rows; empty for a wall
    /// at rest.
    #[serde(default)]
    pub motion: Vec<(f64, f64, f64)>,
}

fn left() -> FlowSide {
    FlowSide::Left
}

fn rough() -> Surface {
    Surface::Rough
}

impl WallLine {
    /// The wall for the solver, without its dummy particles.
    pub(super) fn shell(&self) -> Shell<2> {
        let mut points: Vec<Vector<2>> = self.points.iter().map(vector).collect();
        if self.closed {
            points.extend(points.first().copied());
        }
        let side = match self.flow {
            FlowSide::Left => Side::Left,
            FlowSide::Right => Side::Right,
        };
        let mut shell = Shell::polyline(&self.name, &points, side);
        shell.roughness = self.surface;
        shell.motion = Motion {
            times: self.motion.iter().map(|row| row.0).collect(),
            displacements: self.motion.iter().map(|row| Vector::<2>::new(row.1, row.2)).collect(),
        };
        shell
    }

    /// Its length `[m]`.
    pub(super) fn length(&self) -> f64 {
        self.shell().facets.iter().map(|facet| (facet.corners[1] - facet.corners[0]).norm()).sum()
    }

    /// Refuses walls without a length, tables that do not begin at rest, and a spacing that is no finer than the wall.
    pub(super) fn check(&self, spacing: f64) -> Result<(), ParameterError> {
        let refused = |field, value: String, rule, remedy| Err(ParameterError::field(field, value, rule, remedy));
        let least = if self.closed { 3 } else { 2 };
        if self.points.len() < least || self.length() <= spacing {
            let rule = if self.closed {
                "three points or more, farther apart than the spacing"
            } else {
                "two points or more, farther apart than the spacing"
            };
            return refused(
                "points",
                format!("{} points", self.points.len()),
                rule,
                "give the wall's corners in their order",
            );
        }
        if let Some(row) = self.motion.first().filter(|row| **row != (0.0, 0.0, 0.0)) {
            let value = format!("({}, {}, {})", row.0, row.1, row.2);
            return refused("motion[0]", value, "(0, 0, 0)", "the points are where the wall is at the start");
        }
        let shell = self.shell();
        if self.motion.len() == 1 || !shell.motion.is_sound() {
            let value = format!("{} rows", self.motion.len());
            return refused("motion", value, "rows with rising times, two or more", "sort the rows by their times");
        }
        Ok(())
    }
}

/// The sides of the domain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sides {
    /// At small x.
    pub left: DomainSide,
    /// At large x.
    pub right: DomainSide,
    /// At small y.
    pub bottom: DomainSide,
    /// At large y.
    pub top: DomainSide,
}

impl Sides {
    /// Pairs along each axis: lower and upper.
    pub(super) fn pairs(&self) -> [(DomainSide, DomainSide); 2] {
        [(self.left, self.right), (self.bottom, self.top)]
    }

    /// The boundary of the solver along each axis.
    pub(super) fn axes(&self) -> [AxisBoundary; 2] {
        self.pairs().map(sides::boundary)
    }

    /// Whether a wall of the scene is a plane of symmetry, which has no name.
    pub(super) fn has_mirror(&self) -> bool {
        sides::has_mirror(&self.pairs())
    }

    /// Refuses a period with one end, and ends in the wrong order.
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        sides::check(self.pairs(), [("left", "right"), ("bottom", "top")])
    }
}
