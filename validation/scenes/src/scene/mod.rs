//! A scene that a user describes in a file: bodies of material, walls of segments, open sides, gauges.

mod body;
mod figures;
mod gauge;
mod inlet;
mod wall;

pub use body::PlaneBody;
pub use gauge::PlaneGauge;
pub use inlet::PlaneInlet;
pub use wall::{FlowSide, PlaneSides, WallLine};

use super::enclosed::{Dimension, DrawFrames, DrawSites, SceneCase, SceneFlow, SideSearch};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// Two coordinates or components along x and y.
pub type PlaneVector = (f64, f64);

/// The flow of the case.
pub type PlaneFlow = SceneFlow<Plane, 2>;

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

    const SIDE: SideSearch<2> = <Simulation<2> as Compiled<2>>::compiled_side;
    const NAME: &'static str = "scene";
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
    const RUNS: &'static str = include_str!("../../runs/scene.toml");
    const GRAVITY: PlaneVector = (0.0, -9.81);
    const ADD_A_BODY: &'static str = "add a box, a disc or a polygon of material";
    const COST: f64 = 0.6;
    const FORCE_UNIT: &'static str = "N/m";
    const MASS_UNIT: &'static str = "kg/m";
    const FLUX_UNIT: &'static str = "kg/(m s)";
    const SETUP: DrawSites<Self, 2> = figures::setup;
    const PICTURES: DrawFrames<Self, 2> = figures::pictures;
}

/// The case.
pub const CASE: SceneCase<Plane, 2> = SceneCase::NEW;
