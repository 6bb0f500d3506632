//! A scene that a user describes in a file: bodies of material, walls of segments, open sides, gauges.

mod body;
mod figures;
mod gauge;
mod inlet;
mod tiers;
mod wall;

pub use body::PlaneBody;
pub use gauge::PlaneGauge;
pub use inlet::PlaneInlet;
pub use wall::{FlowSide, PlaneSides, WallLine};

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

/// Two coordinates or components along x and y.
pub type PlaneVector = (f64, f64);

/// Parameters of the case.
pub type PlaneParameters = enclosed::SceneParameters<Plane, 2>;

type PlaneSceneRecord = RecordOf<PlaneParameters>;

/// The plane: masses, forces and fluxes are those per metre of depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane;

impl Dimension<2> for Plane {
    type Place = PlaneVector;
    type Sides = PlaneSides;
    type Body = PlaneBody;
    type Wall = WallLine;
    type Inlet = PlaneInlet;
    type Gauge = PlaneGauge;

    const ADD_A_BODY: &'static str = "add a box, a disc or a polygon of material";
    const COST: f64 = 0.6;
    const MEAN_FORCE: Quantity = Quantity::accounted(
        "mean_force",
        "N/m",
        "time average, from the start, of the force of the flow on the wall of a gauge",
    );
    const MASS_CROSSED: Quantity =
        Quantity::accounted("mass_crossed", "kg/m", "mass that crosses the line of a gauge until the end");
    const MASS_FED: Quantity = Quantity::accounted("mass_fed", "kg/m", "inflow through an inlet until the end");
    const FLUX_UNIT: &'static str = "kg/(m s)";

    fn of_tier(tier: Tier) -> PlaneParameters {
        tiers::of_tier(tier)
    }

    fn setup(parameters: &PlaneParameters, sites: &[(Vector<2>, f64)]) -> Vec<Panel> {
        figures::setup(parameters, sites)
    }

    fn pictures(parameters: &PlaneParameters, frames: &[Frame]) -> Figure {
        figures::pictures(parameters, frames)
    }
}

/// The case.
#[derive(Debug)]
pub struct UserScene;

impl Case for UserScene {
    const NAME: &'static str = "scene";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "user-defined 2-D scene: bodies of material, walls of segments, inlets, open sides, gauges; judged by its balances";
    const DESCRIPTION: &'static str = "\
        Setup. Boxes, discs and polygons of one material under any law, by the weakly compressible model. Walls are \
        polylines, rough or smooth, at rest or moved by a table of times. Sides of the domain are symmetry planes, \
        periodic, or open; outflow is counted. Gauges measure the front along a line, the depth at a place, the \
        force on a wall and the flux through a line, as time series. The scene of the tiers is a column of glass \
        beads that collapses onto a step and falls over its edge.\n\n\
        Judged. Balances of mass, momentum and energy, and walls that let nothing pass. The file itself gives any \
        further reference.\n\n\
        Observed only. All gauges.";
    type Parameters = PlaneParameters;
    const QUANTITIES: &'static [Quantity] = &metrics::quantities_of::<Plane, 2>();
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;

    fn metrics(parameters: &PlaneParameters, records: &[PlaneSceneRecord]) -> Vec<Metric> {
        metrics::all(parameters, records)
    }

    fn figures(parameters: &PlaneParameters, records: &[PlaneSceneRecord]) -> Vec<Figure> {
        enclosed::figures::all(parameters, records)
    }

    fn setup(parameters: &PlaneParameters) -> Option<Figure> {
        Some(enclosed::figures::setup(parameters))
    }

    fn from_external(
        run: &RunOf<PlaneParameters>,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<SceneObservation<2>>>, FieldError> {
        foreign::observe(run, given)
    }

    fn tables(parameters: &PlaneParameters, records: &[PlaneSceneRecord]) -> Vec<Table> {
        series::tables(parameters, records)
    }
}
