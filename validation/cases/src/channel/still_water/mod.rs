//! Incompressible water at rest: height, vertical velocity, pressure.

mod figures;
mod metrics;
mod parameters;

pub use parameters::{StillWaterParameters, StillWaterRun};

use crate::case::{Case, RecordOf};
use crate::channel;
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct StillWater;

type StillWaterRecord = RecordOf<StillWaterParameters>;

impl Case for StillWater {
    const NAME: &'static str = "still-water";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "a displaced column of incompressible water at rest: height, vertical velocity, pressure";
    const DESCRIPTION: &'static str = "Water of displaced particles over a closed floor must come to rest with its height and with the hydrostatic \
        pressure. On strongly displaced particles the compact Laplacian of the bed-load paper alone corrects too much, \
        with alternating sign: the same column without the stabilisation of the pressure Poisson equation blows up at \
        once, which shows that the test can fail. A profile alone would not show it early; height and vertical velocity \
        do.";
    type Parameters = StillWaterParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(_: &StillWaterParameters, records: &[StillWaterRecord]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(_: &StillWaterParameters, records: &[StillWaterRecord]) -> Vec<Figure> {
        [figures::pressure(records), figures::rest(records)].into_iter().chain(figures::states(records)).collect()
    }

    fn tables(_: &StillWaterParameters, records: &[StillWaterRecord]) -> Vec<Table> {
        channel::tables_of_runs(records)
    }
}
