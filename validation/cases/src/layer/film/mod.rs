//! Newtonian, Bingham and Herschel–Bulkley films on an incline against their exact profiles.

mod figures;
mod flow;
mod metrics;

pub use flow::FilmFlow;

use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, RecordOf, Tabulate};
use crate::layer;
use crate::metric::Quantity;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Film;

type Record = RecordOf<FilmFlow>;

impl Case for Film {
    const NAME: &'static str = "film";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "Newtonian, Bingham and Herschel–Bulkley films on an incline against their exact profiles";
    const DESCRIPTION: &'static str = "\
        Setup. A viscous film flows down an incline, periodic along the slope, over a no-slip bed. The Newtonian \
        film starts from rest. The Bingham and Herschel–Bulkley films, regularised after Papanastasiou, have long \
        relaxation times and start from their exact profiles.\n\n\
        Judged. Velocity profile, discharge and the edge of the plug against exact solutions of the unregularised \
        laws, so that creep of the plug counts as error. The order of convergence of the Newtonian film.\n\n\
        Observed only. The Newtonian film with the operators and walls of the collapse paper. Any other law given \
        under `material`, compared with its steady film, integrated over the depth.";
    const EXTERNAL_SCHEMA: ExternalSchema = layer::foreign::EXTERNAL_SCHEMA;
    type Flow = FilmFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const FROM_EXTERNAL: FromExternal<Self::Flow> =
        |run, given| layer::foreign::observe(&run.layer(&|_| 0.0), given).map(Some);
    const TABLES: Tabulate<Self::Flow> = layer::tables_of_runs;
}
