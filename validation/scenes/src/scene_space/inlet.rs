//! Inlets of a scene in space: rectangles by which material comes in.

use super::SpaceVector;
use super::gauge::edges;
use crate::case::ParameterError;
use crate::enclosed::{GivenRate, TableEnds, setting};
use bagnold_solver::parameter::not_negative;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::inlet::{Inlet, Supply};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Cosine of the angle between two edges that counts as a right one `[-]`.
const RIGHT: f64 = 1e-6;

/// An opening by which material comes in, towards those who see its three corners against the clock.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpaceInlet {
    /// Name by which gauges and messages call the inlet: letters, digits and hyphens, unlike those of other inlets and walls.
    pub name: String,
    /// A corner of the rectangle and the two next to it x, y, z `[m]`.
    pub corners: (SpaceVector, SpaceVector, SpaceVector),
    /// Mass per time, where it is one for all times `[kg/s]`; 0 beside `rates` or `table`.
    #[serde(default)]
    #[schemars(transform = not_negative("give 0 or more; for outflow, open a side of the domain"))]
    pub rate: f64,
    /// Mass per time as a table: time `[s]` and rate `[kg/s]`, linear between the rows; two rows of one time are a jump.
    #[serde(default)]
    pub rates: Vec<(f64, f64)>,
    /// CSV file of these rows with a heading, whose path begins at the case file; empty without one.
    #[serde(default)]
    pub table: String,
    /// Rate before the first and after the last row; unless given, the first row is that of the time 0 and the last goes on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends: Option<TableEnds>,
}

impl setting::SceneInlet<3> for SpaceInlet {
    const GIVEN_BY: &'static str = "corners";
    const TURN: &'static str = "reverse the inlet (its last two corners)";

    fn name(&self) -> &str {
        &self.name
    }

    fn rate(&self) -> GivenRate<'_> {
        GivenRate { rate: self.rate, rates: &self.rates, table: &self.table, ends: self.ends }
    }

    fn corners(&self) -> Vec<Vector<3>> {
        let [corner, one, other] = edges(&self.corners);
        vec![corner, corner + one, corner + one + other, corner + other]
    }

    fn edges(&self) -> Vec<f64> {
        let [_, one, other] = edges(&self.corners);
        vec![one.norm(), other.norm()]
    }

    fn check(&self) -> Result<(), ParameterError> {
        let [_, one, other] = edges(&self.corners);
        let cosine = one.dot(&other) / (one.norm() * other.norm());
        if cosine.abs() <= RIGHT {
            return Ok(());
        }
        let angle = libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees();
        let defect = format!("edges at an angle of {angle:.1}° instead of 90°");
        Err(ParameterError::field("corners", defect, "", "give one corner of a rectangle and its two neighbours"))
    }

    fn feed(&self, supply: Supply) -> Option<Inlet<3>> {
        let [corner, one, other] = edges(&self.corners);
        Inlet::rectangle(&self.name, corner, [corner + one, corner + other], supply)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::setting::SceneInlet as _;

    #[test]
    fn an_opening_is_a_rectangle() {
        let inlet = |last: SpaceVector| SpaceInlet {
            name: "feed".to_owned(),
            corners: ((0.0, 0.0, 0.0), (0.0, 0.1, 0.0), last),
            rate: 1.0,
            rates: Vec::new(),
            table: String::new(),
            ends: None,
        };
        assert!(inlet((0.0, 0.0, 0.1)).check().is_ok());
        assert_eq!(
            inlet((0.0, 0.05, 0.1)).check().expect_err("slanted").to_string(),
            "`corners`: edges at an angle of 63.4° instead of 90°; give one corner of a rectangle and its two neighbours"
        );
    }
}
