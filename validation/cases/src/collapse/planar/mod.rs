//! Planar granular columns that collapse and spread on a rough horizontal bed.

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf};
use crate::collapse::{self, Collapse, ColumnFlow};
use crate::figure::{Animation, Figure};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct ColumnPlanar;

/// A planar column.
pub type PlanarColumn = ColumnFlow<2>;
type Record = RecordOf<PlanarColumn>;

impl Case for ColumnPlanar {
    const NAME: &'static str = "column-planar";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "planar columns of μ(I) grains: run-out, height and stopping time against the published laws";
    const DESCRIPTION: &'static str = "\
        Setup. Half a column of dry grains stands against a free-slip symmetry plane on a rough horizontal bed and \
        is released at once. The sand is that of Table 2 of the collapse paper; the other grains are those of \
        Lagrée, Staron & Popinet (2011), whose grain diameter is not published.\n\n\
        Definitions. Run-out: distance of the front at a thickness of 0.02 r_0, minus the initial half width, over \
        the half width. Thickness is counted in whole rows of particles, outwards from the thickest place. Fewer \
        than four rows at the toe are replaced by a wedge of the same volume, so that isolated grains do not set the \
        run-out. Height: thickness of the innermost bin.\n\n\
        Judged. Run-out, height, stopping time and exponents against the published laws; fronts and kinetic energy \
        over time against other codes; the shape of a pile of bars against measurements; balances.\n\n\
        Observed only. The undisturbed core, the failure surface and the profile of the flowing layer. The published \
        laws under any other law than μ(I): their coefficients depend on the material, their exponents much less.";
    const EXTERNAL_SCHEMA: ExternalSchema = collapse::external::column::EXTERNAL_SCHEMA;
    type Flow = PlanarColumn;
    const QUANTITIES: &'static [Quantity] = collapse::metrics::quantities::QUANTITIES;

    fn metrics(records: &[Record]) -> Vec<Metric> {
        collapse::metrics::all(records)
    }

    fn figures(records: &[Record]) -> Vec<Figure> {
        collapse::figures::all(records)
    }

    fn animations(records: &[Record]) -> Vec<Animation> {
        collapse::figures::animations(records)
    }

    fn from_external(
        run: &PlanarColumn,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<Collapse>>, FieldError> {
        collapse::external::column::observe(run, given).map(Some)
    }

    fn tables(records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(collapse::tables).collect()
    }
}
