//! Turbulent flow of clear water over a fixed rough bed against the logarithmic law.

mod figures;
mod laws;
mod metrics;
mod parameters;

pub use parameters::{ClearWaterParameters, ClearWaterRun, Period, RoughBedFlow};

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf};
use crate::channel;
use crate::figure::Figure;
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct ClearWater;

type ClearWaterRecord = RecordOf<ClearWaterParameters>;

impl Case for ClearWater {
    const NAME: &'static str = "clear-water";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "turbulent clear water over a fixed rough bed against the logarithmic law";
    const DESCRIPTION: &'static str = "Water over a fixed bed of 5 mm grains on the slopes of the bed-load paper, with a mixing length for what the \
        particles do not resolve and the law of a rough wall for the bed. The closure carries the stress of a uniform \
        flow with exactly the logarithmic law, so that the whole profile has a reference. In the paper tier the flow \
        starts 20 % too slow and is averaged once it is stationary: once its depth mean changes by less than 0.5 % over \
        U/(2 g i) three times in a row. The quick tier starts from the law itself, is too short to be stationary and \
        says so: it judges the balance of momentum only, and reports the rest with its drift.";
    const EXTERNAL_SCHEMA: ExternalSchema = channel::foreign::EXTERNAL_SCHEMA;
    type Parameters = ClearWaterParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(_: &ClearWaterParameters, records: &[ClearWaterRecord]) -> Vec<Metric> {
        records.iter().flat_map(metrics::of_run).chain(laws::metrics()).collect()
    }

    fn figures(_: &ClearWaterParameters, records: &[ClearWaterRecord]) -> Vec<Figure> {
        vec![figures::profiles(records), figures::over_time(records)]
    }

    fn from_external(
        _: &ClearWaterRun,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<channel::ChannelObservation>>, FieldError> {
        channel::foreign::observe(given).map(Some)
    }

    fn tables(_: &ClearWaterParameters, records: &[ClearWaterRecord]) -> Vec<Table> {
        channel::tables_of_runs(records)
    }
}
