//! Load on a wall, as a case file gives it.

use bagnold_solver::parameter::{at_least, between, positive};
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Load on a wall, under which it moves freely along one direction.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "GivenLoad")]
pub struct GivenLoad<P> {
    /// Direction of the load and of the wall's motion, by its components, of any length `[-]`.
    pub direction: P,
    /// Pressure on the area of the wall across the direction and between the sides of the domain `[Pa]`; unless `force` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = positive("give it in Pa; reverse `direction` for a pulled wall"))]
    pub pressure: Option<f64>,
    /// Force `[N]`, in 2-D per metre of depth `[N/m]`; unless `pressure` is given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = between(1e-12, 1e12, "give it in N, in 2-D in N/m; reverse `direction` for a pulled wall"))]
    pub force: Option<f64>,
    /// Mass of the wall `[kg]`, in 2-D per metre of depth `[kg/m]`; half of that of the material below it where it is left out. Its weight is
    /// not added to the load.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = between(1e-12, 1e12, "leave it out for half of the mass of the material below the wall"))]
    pub mass: Option<f64>,
    /// Rate of a damper of the wall `[1/s]`, which takes nothing at rest; twice the sound speed over the height of the material where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(transform = at_least(0.0, "give 0 for an undamped wall"))]
    pub damping: Option<f64>,
}

impl<P> GivenLoad<P> {
    /// The load with a vector for its direction.
    pub(crate) fn with_vector<const D: usize>(&self) -> GivenLoad<Vector<D>>
    where
        P: Copy + Into<[f64; D]>,
    {
        let Self { direction, pressure, force, mass, damping } = *self;
        GivenLoad { direction: Vector::<D>::from(direction.into()), pressure, force, mass, damping }
    }
}
