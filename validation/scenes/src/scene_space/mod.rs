//! A scene in space that a user describes in a file: bodies of material, walls of triangles, open sides, gauges.

mod body;
mod figures;
mod gauge;
mod inlet;
mod openings;
mod wall;

pub use body::SpaceBody;
pub use gauge::SpaceGauge;
pub use inlet::SpaceInlet;
pub use wall::{SpaceSides, SpaceWall};

use super::enclosed::{Dimension, DrawFrames, DrawSites, SceneCase, SceneFlow, SideSearch};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// Three coordinates or components along x, y and z.
pub type SpaceVector = (f64, f64, f64);

/// The flow of the case.
pub type SpaceFlow = SceneFlow<Space, 3>;

/// Setting of three-dimensional scenes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Space;

impl Dimension<3> for Space {
    type Place = SpaceVector;
    type Sides = SpaceSides;
    type Body = SpaceBody;
    type Wall = SpaceWall;
    type Inlet = SpaceInlet;
    type Gauge = SpaceGauge;

    const SIDE: SideSearch<3> = <Simulation<3> as Compiled<3>>::compiled_side;
    const NAME: &'static str = "scene-space";
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
    const RUNS: &'static str = include_str!("../../runs/scene-space.toml");
    const GRAVITY: SpaceVector = (0.0, 0.0, -9.81);
    const ADD_A_BODY: &'static str = "add a box, a cylinder or a sphere of material";
    const COST: f64 = 1.5;
    const FORCE_UNIT: &'static str = "N";
    const MASS_UNIT: &'static str = "kg";
    const FLUX_UNIT: &'static str = "kg/s";
    const SETUP: DrawSites<Self, 3> = figures::setup;
    const PICTURES: DrawFrames<Self, 3> = figures::pictures;
}

/// The case.
pub const CASE: SceneCase<Space, 3> = SceneCase::NEW;
