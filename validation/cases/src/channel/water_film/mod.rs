//! A laminar film of incompressible water against the exact parabola.

mod figures;
mod flow;
mod metrics;

pub use flow::WaterFilmFlow;

use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, RecordOf, Tabulate};
use crate::channel;
use crate::metric::Quantity;
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
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const FROM_EXTERNAL: FromExternal<Self::Flow> = |_, given| channel::foreign::observe(given).map(Some);
    const TABLES: Tabulate<Self::Flow> = channel::tables_of_runs;
}
