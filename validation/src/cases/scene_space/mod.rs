//! A scene in space that a user describes in a file: bodies of material, walls of triangles, open sides, gauges.

mod body;
mod checks;
mod figures;
mod gauge;
mod metrics;
mod parameters;
mod run;
mod wall;

pub use body::Body;
pub use gauge::Gauge;
pub use parameters::SpaceParameters;
pub use run::SpaceRun;
pub use wall::{Sides, Wall};

use crate::case::{Case, RecordOf, Run};
use crate::cases::enclosed::series;
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use bagnold_solver::vector::Vector;

/// Three coordinates or components along x, y and z.
pub type Place = (f64, f64, f64);

type Record = RecordOf<SpaceParameters>;

/// A place as a vector `[m]`.
fn vector(place: &Place) -> Vector<3> {
    Vector::<3>::new(place.0, place.1, place.2)
}

/// The case.
#[derive(Debug)]
pub struct SpaceScene;

impl Case for SpaceScene {
    const NAME: &'static str = "scene-space";
    const SUMMARY: &'static str = "a scene of one's own in space: bodies of material, walls from STL files or of quadrilaterals and boxes, open sides, gauges; judged by its balances";
    const DESCRIPTION: &'static str = "Boxes, cylinders and balls of one material under any law, by the weakly compressible model, between walls of \
        triangles: meshes from STL files, quadrilaterals and boxes, rough or smooth, at rest or moved by a table of times. Sides of the \
        domain are planes of symmetry, periods, or open: what leaves is counted. Gauges measure the front along a line, the depth at \
        a place, the force on a wall and the flux through a parallelogram, and are written as series. There is no reference but what \
        the file itself gives: a scene is judged by its balances of mass, momentum and energy, and by nothing having passed a \
        wall. The scene of the tiers is half a column of glass beads that collapses in a channel with rough side walls and falls \
        over the edge at its end.";
    type Parameters = SpaceParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const STATED: &'static [&'static str] = &["bodies", "walls", "gauges", "measured"];

    fn metrics(parameters: &SpaceParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(parameters, records)
    }

    fn figures(parameters: &SpaceParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(parameters, records)
    }

    fn tables(parameters: &SpaceParameters, records: &[Record]) -> Vec<Table> {
        let of_run = |(run, record): &Record| {
            let data = &record.data;
            let gauges = parameters.gauges.iter().map(|gauge| (gauge.name(), gauge.columns()));
            let name = format!("gauges-{}", run.variant().file_name());
            series::table(name, "mass in the scene [kg]", gauges, (&data.time, &data.mass, &data.gauges))
        };
        records.iter().map(of_run).collect()
    }
}
