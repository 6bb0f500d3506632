//! Planar granular columns that collapse and spread on a rough horizontal bed.

mod parameters;
mod runs;
mod tiers;

pub use parameters::{ColumnPlanarParameters, OtherNumerics, PlanarColumns, Regularised, Sensitivity, Variants};

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema};
use crate::collapse::{self, Collapse, CollapseRecord, ColumnRun};
use crate::figure::{Animation, Figure};
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct ColumnPlanar;

impl Case for ColumnPlanar {
    const NAME: &'static str = "column-planar";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "planar columns of μ(I) grains: run-out, height and stopping time against the published laws";
    const DESCRIPTION: &'static str = "Half a column of dry grains stands against a free-slip symmetry plane on a rough horizontal bed and is released \
        at once. It falls, spreads and comes to rest. Run-out is the distance of the front at a thickness of \
        0.02 r_0 less the initial half width, over it. Thickness is counted in whole rows of particles, from the thickest place outwards, and what \
        lies in fewer than four rows counts as a wedge of its volume, so that single grains do not make the run-out; \
        height is the thickness of the innermost bin. The sand is that of the collapse paper's \
        Table 2; the other grains are those of Lagrée, Staron & Popinet (2011), whose grain diameter the source does \
        not give. The coefficients of the published laws depend on the material, their exponents much less. With another \
        law than μ(I) the published laws are shown and do not gate.";
    const EXTERNAL_SCHEMA: ExternalSchema = collapse::foreign::EXTERNAL_SCHEMA;
    type Parameters = ColumnPlanarParameters;
    const QUANTITIES: &'static [Quantity] = collapse::quantities::QUANTITIES;

    fn metrics(_: &ColumnPlanarParameters, records: &[CollapseRecord]) -> Vec<Metric> {
        collapse::metrics::all(records)
    }

    fn figures(_: &ColumnPlanarParameters, records: &[CollapseRecord]) -> Vec<Figure> {
        collapse::figures::all(records)
    }

    fn animations(_: &ColumnPlanarParameters, records: &[CollapseRecord]) -> Vec<Animation> {
        collapse::figures::animations(records)
    }

    fn from_external(
        run: &ColumnRun,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<Collapse>>, FieldError> {
        collapse::foreign::observe(run, given).map(Some)
    }

    fn tables(_: &ColumnPlanarParameters, records: &[CollapseRecord]) -> Vec<Table> {
        records.iter().flat_map(collapse::tables).collect()
    }
}
