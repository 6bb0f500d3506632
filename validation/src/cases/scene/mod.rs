//! A scene that a user describes in a file: bodies of material, walls of segments, open sides, gauges.

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
pub use parameters::SceneParameters;
pub use run::SceneRun;
pub use wall::{FlowSide, Sides, WallLine};

use crate::case::{Case, RecordOf, Run};
use crate::cases::enclosed::series;
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;

/// Two coordinates or components along x and y.
pub type Place = (f64, f64);

type Record = RecordOf<SceneParameters>;

/// The case.
#[derive(Debug)]
pub struct UserScene;

impl Case for UserScene {
    const NAME: &'static str = "scene";
    const SUMMARY: &'static str = "a scene of one's own in the plane: bodies of material, walls of segments, open sides, gauges; judged by its balances";
    const DESCRIPTION: &'static str = "Boxes, discs and polygons of one material under any law, by the weakly compressible model, between walls \
        that are polylines, rough or smooth, at rest or moved by a table of times. Sides of the domain are planes of \
        symmetry, periods, or open: what leaves is counted. Gauges measure the front along a line, the depth at a place, the \
        force on a wall and the flux through a line, and are written as series. There is no reference but what the file \
        itself gives: a scene is judged by its balances of mass, momentum and energy, and by nothing having passed a wall. \
        The scene of the tiers is a column of glass beads that collapses onto a step and falls over its edge.";
    type Parameters = SceneParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const STATED: &'static [&'static str] = &["bodies", "walls", "gauges", "measured"];

    fn metrics(parameters: &SceneParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(parameters, records)
    }

    fn figures(parameters: &SceneParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(parameters, records)
    }

    fn tables(parameters: &SceneParameters, records: &[Record]) -> Vec<Table> {
        let of_run = |(run, record): &Record| {
            let data = &record.data;
            let gauges = parameters.gauges.iter().map(|gauge| (gauge.name(), gauge.columns()));
            let name = format!("gauges-{}", run.variant().file_name());
            series::table(name, "mass in the scene [kg/m]", gauges, (&data.time, &data.mass, &data.gauges))
        };
        records.iter().map(of_run).collect()
    }
}
