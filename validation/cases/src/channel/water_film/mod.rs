//! A laminar film of incompressible water against the exact parabola.

mod figures;
mod flow;
mod metrics;

pub use flow::WaterFilmFlow;

use crate::case::{Case, ExternalData, ExternalSchema, RecordOf};
use crate::channel;
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::shared::FromExternal;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct WaterFilm;

type WaterFilmRecord = RecordOf<WaterFilmFlow>;

impl Case for WaterFilm {
    const NAME: &'static str = "water-film";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "a laminar film by the incompressible model against its exact profile, with the order of convergence";
    const DESCRIPTION: &'static str = "\
        Setup. A Newtonian film flows down a slope of 3 % over a no-slip bed, by the incompressible projection step. \
        The viscosity gives a surface velocity of 0.5 m/s at a depth of 46 mm (Reynolds number 37, Froude number \
        0.74). The film starts from the exact laminar profile and runs for several relaxation times 4h²/(π²ν).\n\n\
        Judged. Velocity profile against the exact film, the momentum balance, and the order of convergence where \
        three resolutions are run. The errors come from the wall, the viscous pair terms and the depth that the \
        particles take.\n\n\
        Observed only. Bed friction, change of depth, and the profile against the film of the depth that the \
        particles take.";
    const EXTERNAL_SCHEMA: ExternalSchema = channel::foreign::EXTERNAL_SCHEMA;
    type Flow = WaterFilmFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(records: &[WaterFilmRecord]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(records: &[WaterFilmRecord]) -> Vec<Figure> {
        figures::all(records)
    }

    fn from_external(_: &WaterFilmFlow, given: &ExternalData) -> FromExternal<WaterFilmFlow> {
        channel::foreign::observe(given).map(Some)
    }

    fn tables(records: &[WaterFilmRecord]) -> Vec<Table> {
        channel::tables_of_runs(records)
    }
}
