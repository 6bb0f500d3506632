//! Walls of a scene: polylines, rough or smooth, at rest or moved by a table; and the sides of its domain.

use super::PlaneVector;
use super::body::check_crossing;
use crate::case::ParameterError;
use crate::enclosed::setting::{self, vector};
use crate::enclosed::{DomainSide, GivenLoad, GivenTurn, sides};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{FacetWall, Motion, Side};
use bagnold_solver::weakly_compressible::walls::Surface;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Side of a polyline on which the flow is, seen along its points.
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
    /// Name by which gauges and messages call the wall: letters, digits and hyphens, unlike those of other walls and inlets.
    pub name: String,
    /// Two or more points x, y `[m]`, farther apart than the spacing.
    pub points: Vec<PlaneVector>,
    /// Whether its last point is joined to the first.
    #[serde(default)]
    pub closed: bool,
    /// Side of the flow, seen along the points.
    #[serde(default = "left")]
    pub flow: FlowSide,
    /// Whether the flow sticks to it or slides.
    #[serde(default = "setting::rough")]
    pub surface: Surface,
    /// Whether material may stand behind it, farther away than it is thick.
    #[serde(default)]
    pub both_sides: bool,
    /// Motion: time `[s]`, displacement along x `[m]` and along y `[m]`, linear between the rows; empty for a wall
    /// at rest.
    #[serde(default)]
    pub motion: Vec<(f64, f64, f64)>,
    /// Load, under which the wall moves freely along one direction; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<GivenLoad<PlaneVector>>,
    /// Turn about a point; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<GivenTurn<PlaneVector>>,
}

fn left() -> FlowSide {
    FlowSide::Left
}

impl setting::SceneWall<2> for WallLine {
    const FACETS: &'static str = "segments";
    const GIVEN_BY: &'static str = "points";
    const TURN: &'static str = "reverse the wall (`flow`)";

    fn name(&self) -> &str {
        &self.name
    }

    fn may_have_two_sides(&self) -> bool {
        self.both_sides
    }

    fn facet_wall(&self) -> FacetWall<2> {
        let mut points: Vec<Vector<2>> = self.points.iter().map(vector).collect();
        if self.closed {
            points.extend(points.first().copied());
        }
        let side = match self.flow {
            FlowSide::Left => Side::Left,
            FlowSide::Right => Side::Right,
        };
        let mut facet_wall = FacetWall::polyline(&self.name, &points, side);
        facet_wall.roughness = self.surface;
        facet_wall.motion = self.motion();
        facet_wall
    }

    fn motion(&self) -> Motion<2> {
        Motion {
            times: self.motion.iter().map(|row| row.0).collect(),
            displacements: self.motion.iter().map(|row| Vector::<2>::new(row.1, row.2)).collect(),
            turn: self.turn.as_ref().map(|turn| turn.around(vector(&turn.about), [Vector::x(), Vector::y()])),
            load: None,
        }
    }

    fn load(&self) -> Option<GivenLoad<Vector<2>>> {
        self.load.as_ref().map(GivenLoad::with_vector)
    }

    fn hull(&self) -> Vec<Vector<2>> {
        self.points.iter().map(vector).collect()
    }

    fn measure(&self) -> f64 {
        self.facet_wall().facets.iter().map(|facet| (facet.corners[1] - facet.corners[0]).norm()).sum()
    }

    fn check(&self, spacing: f64, _: f64) -> Result<(), ParameterError> {
        let (least, word) = if self.closed { (3, "three") } else { (2, "two") };
        if self.points.len() < least {
            let defect = format!("{} given, but a wall needs {word} or more", self.points.len());
            return Err(ParameterError::field("points", defect, "", "give the wall's corners in their order"));
        }
        let length = self.measure();
        if length <= spacing {
            let (value, rule) = (format!("{length} m long"), format!("longer than the spacing, {spacing} m"));
            let remedy = "check the unit of `spacing` and of the corners";
            return Err(ParameterError::field("points", value, &rule, remedy));
        }
        self.turn.iter().try_for_each(GivenTurn::check)?;
        check_crossing(&self.points, self.closed)
    }
}

/// The sides of the domain.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneSides {
    /// Side at the smallest x.
    pub left: DomainSide,
    /// Side at the largest x.
    pub right: DomainSide,
    /// Side at the smallest y.
    pub bottom: DomainSide,
    /// Side at the largest y.
    pub top: DomainSide,
}

impl sides::SceneSides<2> for PlaneSides {
    const NAMES: [(&'static str, &'static str); 2] = [("left", "right"), ("bottom", "top")];

    fn pairs(&self) -> [sides::SidePair; 2] {
        [(self.left, self.right), (self.bottom, self.top)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::setting::SceneWall;

    #[test]
    fn a_wall_whose_points_run_the_other_way_has_its_flow_on_the_right() {
        let points = vec![(0.0, 0.0), (0.2, 0.1), (0.3, 0.4)];
        let wall = |points: Vec<PlaneVector>, flow| WallLine {
            name: "bed".to_owned(),
            points,
            closed: false,
            flow,
            surface: Surface::Rough,
            both_sides: false,
            motion: Vec::new(),
            load: None,
            turn: None,
        };
        let normals = |points, flow| -> Vec<Vector<2>> {
            let mut normals: Vec<Vector<2>> =
                wall(points, flow).facet_wall().facets.iter().map(|facet| facet.normal).collect();
            normals.sort_by(|one, other| one[1].abs().total_cmp(&other[1].abs()));
            normals
        };
        let reversed: Vec<PlaneVector> = points.iter().rev().copied().collect();
        let left = normals(points.clone(), FlowSide::Left);
        let (right, turned) = (normals(reversed, FlowSide::Right), normals(points, FlowSide::Right));
        assert_eq!((left.len(), right.len(), turned.len()), (2, 2, 2));
        for ((left, right), turned) in left.iter().zip(&right).zip(&turned) {
            assert!((left - right).norm() < 1e-15, "{left:?} and {right:?}");
            // it is another wall if its side alone changes
            assert!((left + turned).norm() < 1e-15, "{left:?} and {turned:?}");
        }
    }
}
