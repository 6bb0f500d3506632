//! A scene in space that a user describes in a file: bodies of material, walls of triangles, open sides, gauges.

mod body;
mod figures;
mod gauge;
mod inlet;
mod openings;
mod tiers;
mod wall;

pub use body::SpaceBody;
pub use gauge::SpaceGauge;
pub use inlet::SpaceInlet;
pub use wall::{SpaceSides, SpaceWall};

use super::enclosed::Dimension;
use super::enclosed::{self, SceneObservation, foreign, metrics, series};
use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf, RunOf, Tier};
use crate::figure::{Figure, Panel};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::observation::Frame;
use crate::output::Table;
use crate::store::CodeOrigin;
use bagnold_solver::vector::Vector;

/// Three coordinates or components along x, y and z.
pub type SpaceVector = (f64, f64, f64);

/// Parameters of the case.
pub type SpaceParameters = enclosed::SceneParameters<Space, 3>;

type SpaceSceneRecord = RecordOf<SpaceParameters>;

/// Space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Space;

impl Dimension<3> for Space {
    type Place = SpaceVector;
    type Sides = SpaceSides;
    type Body = SpaceBody;
    type Wall = SpaceWall;
    type Inlet = SpaceInlet;
    type Gauge = SpaceGauge;

    const ADD_A_BODY: &'static str = "add a box, a cylinder or a sphere of material";
    const COST: f64 = 1.5;
    const MEAN_FORCE: Quantity = Quantity::accounted(
        "mean_force",
        "N",
        "time average, from the start, of the force of the flow on the wall of a gauge",
    );
    const MASS_CROSSED: Quantity =
        Quantity::accounted("mass_crossed", "kg", "mass that crosses the parallelogram of a gauge until the end");
    const MASS_FED: Quantity = Quantity::accounted("mass_fed", "kg", "inflow through an inlet until the end");
    const FLUX_UNIT: &'static str = "kg/s";

    fn of_tier(tier: Tier) -> SpaceParameters {
        tiers::of_tier(tier)
    }

    fn setup(parameters: &SpaceParameters, sites: &[(Vector<3>, f64)]) -> Vec<Panel> {
        figures::setup(parameters, sites)
    }

    fn pictures(parameters: &SpaceParameters, frames: &[Frame]) -> Figure {
        figures::pictures(parameters, frames)
    }
}

/// The case.
#[derive(Debug)]
pub struct SpaceScene;

impl Case for SpaceScene {
    const NAME: &'static str = "scene-space";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "user-defined 3-D scene: bodies of material, walls from STL files or of quadrilaterals and boxes, open sides, gauges; judged by its balances";
    const DESCRIPTION: &'static str = "\
        Setup. Boxes, cylinders and balls of one material under any law, by the weakly compressible model. Walls are \
        triangles: STL meshes, quadrilaterals and boxes, rough or smooth, at rest or moved by a table of times. \
        Sides of the domain are symmetry planes, periodic, or open; outflow is counted. Gauges measure the front \
        along a line, the depth at a place, the force on a wall and the flux through a parallelogram, as time \
        series. The scene of the tiers is half a column of glass beads that collapses in a channel with rough side \
        walls and falls over the edge at its end.\n\n\
        Judged. Balances of mass, momentum and energy, and walls that let nothing pass. The file itself gives any \
        further reference.\n\n\
        Observed only. All gauges.";
    type Parameters = SpaceParameters;
    const QUANTITIES: &'static [Quantity] = &metrics::quantities_of::<Space, 3>();
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;

    fn metrics(parameters: &SpaceParameters, records: &[SpaceSceneRecord]) -> Vec<Metric> {
        metrics::all(parameters, records)
    }

    fn figures(parameters: &SpaceParameters, records: &[SpaceSceneRecord]) -> Vec<Figure> {
        enclosed::figures::all(parameters, records)
    }

    fn setup(parameters: &SpaceParameters) -> Option<Figure> {
        Some(enclosed::figures::setup(parameters))
    }

    fn from_external(
        run: &RunOf<SpaceParameters>,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<SceneObservation<3>>>, FieldError> {
        foreign::observe(run, given)
    }

    fn tables(parameters: &SpaceParameters, records: &[SpaceSceneRecord]) -> Vec<Table> {
        series::tables(parameters, records)
    }
}
