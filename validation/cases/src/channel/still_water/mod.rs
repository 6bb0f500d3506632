//! Incompressible water at rest: height, vertical velocity, pressure.

mod figures;
mod flow;
mod metrics;

pub use flow::StillWaterFlow;

use crate::case::{Case, DrawFigures, Judge, RecordOf, Tabulate};
use crate::channel;
use crate::metric::Quantity;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct StillWater;

type StillWaterRecord = RecordOf<StillWaterFlow>;

impl Case for StillWater {
    const NAME: &'static str = "still-water";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "a perturbed column of incompressible water at rest: height, vertical velocity, pressure";
    const DESCRIPTION: &'static str = "\
        Setup. A column of perturbed water particles stands on a closed floor, by the incompressible projection \
        step. A second run leaves out the stabilisation of the pressure Poisson equation: the compact Laplacian of \
        the bed-load paper alone over-corrects with alternating sign.\n\n\
        Judged. Mean height and hydrostatic pressure, averaged over the last window. Vertical velocity, in runs long \
        enough to come to rest (paper tier). The run without stabilisation must diverge, which shows that the test \
        can fail.\n\n\
        Observed only. Vertical velocity of shorter runs, and iterations of the solvers.";
    type Flow = StillWaterFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = |records| {
        [figures::pressure(records), figures::rest(records)].into_iter().chain(figures::states(records)).collect()
    };
    const TABLES: Tabulate<Self::Flow> = channel::tables_of_runs;
}
