//! Round granular columns, the experiment of Lube et al. (2004), in three dimensions.

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf};
use crate::collapse::{self, Collapse, ColumnFlow};
use crate::figure::{Animation, Figure};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct ColumnRound;

/// A round column.
pub type RoundColumn = ColumnFlow<3>;
type Record = RecordOf<RoundColumn>;

impl Case for ColumnRound {
    const NAME: &'static str = "column-round";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "round columns of sand in three dimensions: run-out against the axisymmetric experiment's law";
    const DESCRIPTION: &'static str = "\
        Setup. A quarter of a cylinder of dry grains stands between two free-slip symmetry planes on a rough \
        horizontal bed and is released at once. Run-out and height are defined as in `column-planar`, with three \
        differences: the area of the bed that carries a thickness replaces a length, two rows replace four, and the \
        bins are quarter rings of width 0.1 r_0.\n\n\
        Judged. Run-out against the law of Lube et al. (2004), measured on round columns; kinetic energy over time \
        against another code; balances.\n\n\
        Observed only. The height law of the same source, which is unverified. The published laws under any other \
        law than μ(I).";
    const EXTERNAL_SCHEMA: ExternalSchema = collapse::external::column::EXTERNAL_SCHEMA;
    type Flow = RoundColumn;
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
        run: &RoundColumn,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<Collapse>>, FieldError> {
        collapse::external::column::observe(run, given).map(Some)
    }

    fn tables(records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(collapse::tables).collect()
    }
}
