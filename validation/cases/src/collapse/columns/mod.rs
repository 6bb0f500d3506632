//! The cases of columns: planar ones (`D = 2`), and round ones in space (`D = 3`), the experiment of Lube et al. (2004).

use crate::case::{Animate, Case, DrawFigures, ExternalSchema, FromExternal, Judge, Tabulate};
use crate::collapse::external::column::{self, EXTERNAL_SCHEMA};
use crate::collapse::{ColumnFlow, figures, metrics, tables};
use crate::metric::Quantity;
use crate::store::CodeOrigin;

const PLANAR: &str = "\
    Setup. Half a column of dry grains stands against a free-slip symmetry plane on a rough horizontal bed and \
    is released at once. The sand is that of Table 2 of the collapse paper; the other grains are those of \
    Lagrée, Staron & Popinet (2011), whose grain diameter is not published.\n\n\
    Definitions. Run-out: distance of the front at a thickness of 0.02 r_0, minus the initial half width, over \
    the half width. Thickness is counted in whole rows of particles, outwards from the thickest place. A \
    toe of fewer than four rows is replaced by a wedge of the same volume, so that isolated grains do not set the \
    run-out. Height: thickness of the innermost bin.\n\n\
    Judged. Run-out, height, stopping time and exponents against the published laws; fronts and kinetic energy \
    over time against other codes; the shape of a pile of rods against measurements; balances.\n\n\
    Observed only. The undisturbed core, the failure surface and the profile of the flowing layer. The published \
    laws under any other law than μ(I): their coefficients depend on the material, their exponents much less.";
const ROUND: &str = "\
    Setup. A quarter of a cylinder of dry grains stands between two free-slip symmetry planes on a rough \
    horizontal bed and is released at once. Run-out and height are defined as in `column-planar`, with three \
    differences: the area of the bed that carries a thickness replaces a length, two rows replace four, and the \
    bins are quarter rings of width 0.1 r_0.\n\n\
    Judged. Run-out against the law of Lube et al. (2004), measured on round columns; kinetic energy over time \
    against another code; balances.\n\n\
    Observed only. The height law of the same source, which is unverified. The published laws under any other \
    law than μ(I).";

/// Planar columns.
pub mod column_planar {
    /// The case.
    pub const CASE: super::ColumnCase<2> = super::ColumnCase;
}

/// Round columns.
pub mod column_round {
    /// The case.
    pub const CASE: super::ColumnCase<3> = super::ColumnCase;
}

/// Columns that collapse and spread on a rough horizontal bed.
#[derive(Debug)]
pub struct ColumnCase<const D: usize>;

impl<const D: usize> Case for ColumnCase<D> {
    const NAME: &'static str = if D == 2 { "column-planar" } else { "column-round" };
    const AXES_OF_RUNS: &'static [[&'static str; 2]] =
        &[["u [m/s]", "y/r0 [-]"], ["t/√(h0/g) [-]", "energy/released [-]"]];
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = if D == 2 {
        "planar columns of μ(I) grains: run-out, height and stopping time against the published laws"
    } else {
        "round columns of sand in three dimensions: run-out against the axisymmetric experiment's law"
    };
    const DESCRIPTION: &'static str = if D == 2 { PLANAR } else { ROUND };
    const EXTERNAL_SCHEMA: ExternalSchema = EXTERNAL_SCHEMA;
    type Flow = ColumnFlow<D>;
    const QUANTITIES: &'static [Quantity] = metrics::quantities::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const ANIMATIONS: Animate<Self::Flow> = figures::animations;
    const FROM_EXTERNAL: FromExternal<Self::Flow> = |run, given| column::observe(run, given).map(Some);
    const TABLES: Tabulate<Self::Flow> = |records| records.iter().flat_map(tables).collect();
}
