//! Two walls at rest beside a plane flow, parallel to its plane: the plates of a narrow channel.

use crate::parameter::{ParameterProblem, between, positive, range_problem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most that grains may rub on a wall `[-]`: an angle of friction of 63°. An angle in degrees is beyond it.
const MOST_FRICTION: f64 = 2.0;

/// The walls; what they do is [`terms::side_walls`](crate::weakly_compressible::terms::side_walls).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SideWalls {
    /// Distance W of the two walls `[m]`.
    #[schemars(transform = positive("give the inner width of the channel in metres, or leave `side_walls` out"))]
    pub width: f64,
    /// Friction coefficient μ_w of grains on them `[-]`.
    #[schemars(transform = between(0.0, MOST_FRICTION, "give the tangent of the friction angle: 0.3 for 17°"))]
    pub friction: f64,
}

impl SideWalls {
    /// Friction over the width μ_w/W `[1/m]`: what the flow knows of the walls.
    #[must_use]
    pub fn friction_per_width(&self) -> f64 {
        self.friction / self.width
    }

    /// First rule that side walls break in a scene of two or three axes: a scene in space has real walls.
    #[must_use]
    pub fn problem(&self, axes: usize) -> Option<ParameterProblem> {
        if axes != 2 {
            let remedy = "leave it out, and give the side walls under `walls`";
            return Some(ParameterProblem::new("side_walls", "for two-dimensional scenes only", "", remedy));
        }
        range_problem(self).map(|problem| problem.within("side_walls"))
    }
}
