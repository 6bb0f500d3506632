//! Bodies, walls, inlets and gauges, which the plane and space each give in their own way.

use super::given::PlainData;
use super::{GivenLoad, GivenRate, Measurand};
use crate::case::ParameterError;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{FacetWall, Motion};
use bagnold_solver::weakly_compressible::enclosure::inlet::{Inlet, Supply};
use bagnold_solver::weakly_compressible::walls::Surface;

/// A piece of the material at the start.
pub trait SceneBody<const D: usize>: PlainData {
    /// Velocity at the start `[m/s]`.
    fn velocity(&self) -> Vector<D>;

    /// Lower and upper corner of its box `[m]`.
    fn extent(&self) -> (Vector<D>, Vector<D>);

    /// Least and greatest place of its box along a direction `[m]`.
    fn span(&self, direction: &Vector<D>) -> (f64, f64) {
        let (lower, upper) = self.extent();
        let (one, other) = (direction.component_mul(&lower), direction.component_mul(&upper));
        (one.inf(&other).sum(), one.sup(&other).sum())
    }

    /// Area `[m²]` in the plane, its volume `[m³]` in space.
    fn volume(&self) -> f64;

    /// Whether it is a box along the axes, so that it fills what [`SceneBody::extent`] gives.
    fn is_box(&self) -> bool;

    /// Whether it holds a place.
    fn holds(&self, place: &Vector<D>) -> bool;

    /// Refuses an empty body.
    ///
    /// # Errors
    /// The field that leaves it none.
    fn check(&self) -> Result<(), ParameterError>;
}

/// A wall. It has one side: behind it is nothing.
pub trait SceneWall<const D: usize>: PlainData {
    /// Word for its facets.
    const FACETS: &'static str;
    /// Fields of its geometry: the places of the wall at the start.
    const GIVEN_BY: &'static str;
    /// Remedy for a wall that is seen from its back.
    const TURN: &'static str;

    /// Name, by which gauges and messages call it.
    fn name(&self) -> &str;

    /// Whether material may stand behind it.
    fn may_have_two_sides(&self) -> bool;

    /// The wall for the solver.
    fn facet_wall(&self) -> FacetWall<D>;

    /// Motion from the start, without that by its load.
    fn motion(&self) -> Motion<D>;

    /// Load that moves the wall, if there is one.
    fn load(&self) -> Option<GivenLoad<Vector<D>>>;

    /// Number of triangles, which take time before the run; a polyline has none.
    fn triangle_count(&self) -> usize {
        0
    }

    /// Openings of its mesh in words; none for another wall or of a closed mesh. Defects of the mesh are warned of.
    fn openings(&self) -> Option<String> {
        None
    }

    /// Places that it lies between `[m]`.
    fn hull(&self) -> Vec<Vector<D>>;

    /// Length or area `[m^(D-1)]`.
    fn measure(&self) -> f64;

    /// Refuses a wall that is none at this spacing `[m]`, or in another unit than bodies of this size `[m]`.
    ///
    /// # Errors
    /// The field that breaks a rule. How it moves is checked elsewhere.
    fn check(&self, spacing: f64, bodies: f64) -> Result<(), ParameterError>;
}

/// An opening by which material comes in.
pub trait SceneInlet<const D: usize>: PlainData {
    /// The field by which its place is given.
    const GIVEN_BY: &'static str;
    /// Remedy for an inlet that faces the wrong way.
    const TURN: &'static str;

    /// Name, by which gauges and messages call it.
    fn name(&self) -> &str;

    /// The rate at which it feeds the flow.
    fn rate(&self) -> GivenRate<'_>;

    /// Corners `[m]`.
    fn corners(&self) -> Vec<Vector<D>>;

    /// Lengths of its edges `[m]`.
    fn edges(&self) -> Vec<f64>;

    /// Refuses an opening of another form.
    ///
    /// # Errors
    /// The field that gives it.
    fn check(&self) -> Result<(), ParameterError>;

    /// The inlet for the solver; none where its edges are in line.
    fn feed(&self, supply: Supply) -> Option<Inlet<D>>;
}

/// Measurement during the run of a scene.
pub trait SceneGauge<const D: usize>: PlainData {
    /// Name of the gauge or wall in messages and files.
    fn name(&self) -> &str;

    /// Direction of a thickness, unless along gravity: a vector of any length, or the normal of a named wall.
    fn along(&self) -> (Option<Vector<D>>, Option<&str>);

    /// Measurand of the gauge. Gravity, or what takes its place as the direction of a thickness, points along the unit vector
    /// `down`.
    fn measure(&self, down: &Vector<D>) -> Measurand<'_, D>;

    /// Places `[m]`; none for what is measured on a wall.
    fn places(&self) -> Vec<Vector<D>>;

    /// Refuses lines and openings without a size, measured by the spacing `[m]`.
    ///
    /// # Errors
    /// The field that breaks a rule. Names of walls are checked elsewhere.
    fn check(&self, spacing: f64, down: &Vector<D>) -> Result<(), ParameterError>;
}

/// Default diameter of a probe in spacings `[-]`.
pub(crate) fn probe_width() -> f64 {
    5.0
}

/// Default surface of walls.
pub(crate) fn rough() -> Surface {
    Surface::Rough
}

/// A place as a vector `[m]`, a velocity `[m/s]` or an acceleration `[m/s²]` likewise.
pub(crate) fn vector<const D: usize>(place: &(impl Copy + Into<[f64; D]>)) -> Vector<D> {
    Vector::<D>::from((*place).into())
}

/// A place, or a row of a table, as messages show it.
pub(crate) fn shown<'a>(parts: impl IntoIterator<Item = &'a f64>) -> String {
    let parts: Vec<String> = parts.into_iter().map(ToString::to_string).collect();
    format!("({})", parts.join(", "))
}
