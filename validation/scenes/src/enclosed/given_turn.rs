//! Turn of a wall, as a case file gives it.

use super::sound::FOR_EVER;
use crate::case::ParameterError;
use bagnold_solver::parameter::between;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::wall_turn::WallTurn;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Turn of a wall, by a rate or by a table of angles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "GivenTurn")]
pub struct GivenTurn<A> {
    /// Point x, y `[m]` that the wall turns about; in space two points of its axis, seen from the second of which it turns against the clock.
    pub about: A,
    /// Rate `[rad/s]`, in the plane against the clock; unless `angles` are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = between(-1e6, 1e6, "give it in rad/s: 2π turns once a second"))]
    pub rate: Option<f64>,
    /// Time `[s]`, angle `[rad]`, linear between the rows and constant after the last; unless `rate` is given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub angles: Vec<(f64, f64)>,
}

impl<A> GivenTurn<A> {
    /// The turn for the solver about an axis through a place `[m]`, across which two unit vectors are.
    pub(crate) fn around<const D: usize>(&self, centre: Vector<D>, plane: [Vector<D>; 2]) -> WallTurn<D> {
        let steady = self.rate.map(|rate| vec![(0.0, 0.0), (FOR_EVER, rate * FOR_EVER)]);
        let rows = steady.unwrap_or_else(|| self.angles.clone());
        let (times, angles) = rows.into_iter().map(|(time, angle)| (time, Vector::<1>::new(angle))).unzip();
        WallTurn { centre, plane, times, angles }
    }

    /// Refuses a turn given by both a rate and angles, or by neither.
    pub(crate) fn check(&self) -> Result<(), ParameterError> {
        if self.rate.is_some() == self.angles.is_empty() {
            return Ok(());
        }
        let value = self.rate.map_or("absent", |_| "given beside `angles`");
        Err(ParameterError::field("turn.rate", value, "given where `angles` are not", "give one of the two"))
    }
}
