//! What scenes in the plane and in space each give in their own way. All else about them is written once, over these traits.

use super::{Measure, SceneParameters};
use crate::case::{ParameterError, Tier};
use crate::figure::Figure;
use crate::metric::Quantity;
use crate::observation::Frame;
use bagnold_solver::domain::Domain;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::boundary::shell::Shell;
use schemars::JsonSchema;
use serde::{Serialize, de::DeserializeOwned};
use std::fmt::Debug;

pub use super::sides::Sides;

/// Plain data that a case file gives.
pub trait Given: Debug + Clone + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static {}

impl<T: Debug + Clone + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static> Given for T {}

/// The plane (D = 2) or space (D = 3).
pub trait Setting<const D: usize>: Debug + Clone + Copy + PartialEq + Send + Sync + 'static {
    /// Coordinates or components along the axes, as a case file gives them.
    type Place: Given + Copy + Into<[f64; D]>;
    /// The sides of the domain by their names.
    type Sides: Sides<D>;
    /// A piece of material.
    type Body: Body<D>;
    /// A wall.
    type Wall: Wall<D>;
    /// A gauge.
    type Gauge: Gauge<D>;

    /// What to do about a scene without bodies.
    const ADD_A_BODY: &'static str;
    /// What a step of a particle costs of one in the plane `[-]`: its neighbours.
    const COST: f64;
    /// Mean force on a gauge's wall, in the unit that forces have here.
    const MEAN_FORCE: Quantity;
    /// Mass that has crossed a gauge's opening, in the unit that masses have here.
    const MASS_CROSSED: Quantity;
    /// Unit of a mass per time.
    const FLUX_UNIT: &'static str;

    /// The scene of a tier.
    fn of_tier(tier: Tier) -> SceneParameters<Self, D>;

    /// Fills the space behind walls with `rows` of dummy particles at a `spacing` `[m]`.
    fn lay(shells: &mut [Shell<D>], domain: &Domain<D>, spacing: f64, rows: usize);

    /// Pictures of the material between its walls.
    fn pictures(parameters: &SceneParameters<Self, D>, frames: &[Frame]) -> Figure;
}

/// A piece of the material at the start.
pub trait Body<const D: usize>: Given {
    /// Velocity at the start `[m/s]`.
    fn velocity(&self) -> Vector<D>;

    /// Lower and upper corner of its box `[m]`.
    fn extent(&self) -> (Vector<D>, Vector<D>);

    /// Whether it holds a place.
    fn holds(&self, place: &Vector<D>) -> bool;

    /// Refuses an empty body.
    ///
    /// # Errors
    /// The field that leaves it none.
    fn check(&self) -> Result<(), ParameterError>;
}

/// A wall. It has one side: behind it is nothing.
pub trait Wall<const D: usize>: Given {
    /// What its facets are called.
    const FACETS: &'static str;
    /// What it is given by: the places where it is at the start.
    const GIVEN_BY: &'static str;

    /// Its name, by which gauges and messages call it.
    fn name(&self) -> &str;

    /// The wall for the solver, without its dummy particles.
    fn shell(&self) -> Shell<D>;

    /// Places that it lies between `[m]`.
    fn hull(&self) -> Vec<Vector<D>>;

    /// Its length or area `[m^(D-1)]`.
    fn measure(&self) -> f64;

    /// Refuses a wall that is none at this spacing `[m]`.
    ///
    /// # Errors
    /// The field that breaks a rule. How it moves is checked elsewhere.
    fn check(&self, spacing: f64) -> Result<(), ParameterError>;
}

/// What is measured while a scene runs.
pub trait Gauge<const D: usize>: Given {
    /// Its name.
    fn name(&self) -> &str;

    /// What it measures, where gravity points along the unit vector `down`.
    fn measure(&self, down: &Vector<D>) -> Measure<'_, D>;

    /// Refuses lines and openings without a size, measured by the spacing `[m]`.
    ///
    /// # Errors
    /// The field that breaks a rule. Names of walls are checked elsewhere.
    fn check(&self, spacing: f64, down: &Vector<D>) -> Result<(), ParameterError>;
}

/// How walls are unless a file says otherwise.
pub(in crate::cases) fn rough() -> Surface {
    Surface::Rough
}

/// A place as a vector `[m]`, a velocity `[m/s]` or an acceleration `[m/s²]` likewise.
pub(in crate::cases) fn vector<const D: usize>(place: &(impl Copy + Into<[f64; D]>)) -> Vector<D> {
    Vector::<D>::from((*place).into())
}

/// A place, or a row of a table, as messages show it.
pub(in crate::cases) fn shown<'a>(parts: impl IntoIterator<Item = &'a f64>) -> String {
    let parts: Vec<String> = parts.into_iter().map(ToString::to_string).collect();
    format!("({})", parts.join(", "))
}
