//! Newtonian, Bingham and Herschel–Bulkley films on an incline against their exact profiles.

mod comparison;
mod figures;
mod metrics;
mod parameters;
mod runs;

pub use parameters::{EddyLiquid, FilmParameters, FluidKind};
pub use runs::FilmRun;

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf};
use crate::figure::Figure;
use crate::input::FieldError;
use crate::layer;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Film;

type Record = RecordOf<FilmParameters>;

impl Case for Film {
    const NAME: &'static str = "film";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "Newtonian, Bingham and Herschel–Bulkley films on an incline against their exact profiles";
    const DESCRIPTION: &'static str = "A viscous film on an incline, periodic along the slope, over a no-slip bed. The Newtonian film starts from rest; \
        the two yield-stress films, regularised after Papanastasiou and so with a long viscous relaxation, start from \
        their exact profile and must keep it. Velocity profile, flux and the edge of the plug are compared with the \
        exact solutions of the unregularised laws: the regularisation's creep of the plug is part of the error. The \
        Newtonian film is also run with the collapse paper's operators and walls, which are observed and do not gate. Any other \
        law, under `material`, is compared with its steady film, integrated over the depth, and does not gate.";
    const EXTERNAL_SCHEMA: ExternalSchema = layer::foreign::EXTERNAL_SCHEMA;
    type Parameters = FilmParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(_: &FilmParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(_: &FilmParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn from_external(
        run: &FilmRun,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<layer::LayerObservation>>, FieldError> {
        run.observe_external(given).map(Some)
    }

    fn tables(_: &FilmParameters, records: &[Record]) -> Vec<Table> {
        layer::tables_of_runs(records)
    }
}
