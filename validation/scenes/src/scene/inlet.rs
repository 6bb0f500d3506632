//! Inlets of a scene in the plane: lines by which material comes in.

use super::PlaneVector;
use crate::case::ParameterError;
use crate::enclosed::setting::{self, vector};
use crate::enclosed::{GivenRate, TableEnds};
use bagnold_solver::parameter::not_negative;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::inlet::{Inlet, Supply};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An opening by which material comes in, from the right of a line to its left, seen along it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlaneInlet {
    /// Name by which gauges and messages call the inlet: letters, digits and hyphens, unlike those of other inlets and walls.
    pub name: String,
    /// Start of the line x, y `[m]`.
    pub from: PlaneVector,
    /// End of the line x, y `[m]`.
    pub to: PlaneVector,
    /// Mass per time, where it is one for all times `[kg/(m s)]`; 0 beside `rates` or `table`.
    #[serde(default)]
    #[schemars(transform = not_negative("give 0 or more; for outflow, open a side of the domain"))]
    pub rate: f64,
    /// Mass per time as a table: time `[s]` and rate `[kg/(m s)]`, linear between the rows; two rows of one time are a jump.
    #[serde(default)]
    pub rates: Vec<(f64, f64)>,
    /// CSV file of these rows with a heading, whose path begins at the case file; empty without one.
    #[serde(default)]
    pub table: String,
    /// Rate before the first and after the last row; unless given, the first row is that of the time 0 and the last goes on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ends: Option<TableEnds>,
}

impl setting::SceneInlet<2> for PlaneInlet {
    const GIVEN_BY: &'static str = "to";
    const TURN: &'static str = "reverse the inlet (`from`, `to`)";

    fn name(&self) -> &str {
        &self.name
    }

    fn rate(&self) -> GivenRate<'_> {
        GivenRate { rate: self.rate, rates: &self.rates, table: &self.table, ends: self.ends }
    }

    fn corners(&self) -> Vec<Vector<2>> {
        vec![vector(&self.from), vector(&self.to)]
    }

    fn edges(&self) -> Vec<f64> {
        vec![(vector::<2>(&self.to) - vector::<2>(&self.from)).norm()]
    }

    fn check(&self) -> Result<(), ParameterError> {
        Ok(())
    }

    fn feed(&self, supply: Supply) -> Option<Inlet<2>> {
        Inlet::segment(&self.name, vector(&self.from), vector(&self.to), supply)
    }
}
