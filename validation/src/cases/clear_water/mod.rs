//! Turbulent flow of clear water over a fixed rough bed against the logarithmic law.

mod figures;
mod metrics;
mod parameters;

pub use parameters::{ClearWaterParameters, ClearWaterRun, Period};

use super::channel::{self, ChannelObservation};
use crate::case::{Case, ParameterError, Progress, Run, Tier};
use crate::figure::Figure;
use crate::metric::Metric;
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct ClearWater;

/// A run with what it left behind.
type Record = (ClearWaterRun, Recorded<ChannelObservation>);

impl Case for ClearWater {
    type Parameters = ClearWaterParameters;
    type Run = ClearWaterRun;
    type Observation = ChannelObservation;

    fn name(&self) -> &'static str {
        "clear-water"
    }

    fn summary(&self) -> &'static str {
        "turbulent clear water over a fixed rough bed against the logarithmic law"
    }

    fn description(&self) -> &'static str {
        "Water over a fixed bed of 5 mm grains on the slopes of the bed-load paper, with a mixing length for what the \
         particles do not resolve and the law of a rough wall for the bed. The closure carries the stress of a uniform \
         flow with exactly the logarithmic law, so that the whole profile has a reference. In the paper tier the flow \
         starts 20 % too slow and is averaged once it is stationary: once its depth mean changes by less than 0.5 % over \
         U/(2 g i) three times in a row. The quick tier starts from the law itself, is too short to be stationary and \
         says so: it judges the balance of momentum only, and reports the rest with its drift."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> ClearWaterParameters {
        ClearWaterParameters::of_tier(tier)
    }

    fn check(&self, parameters: &ClearWaterParameters) -> Result<(), ParameterError> {
        parameters.check()
    }

    fn runs(&self, parameters: &ClearWaterParameters) -> Vec<ClearWaterRun> {
        parameters::runs(parameters)
    }

    fn simulate(
        &self,
        run: &ClearWaterRun,
        progress: &dyn Progress,
    ) -> Result<Recorded<ChannelObservation>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &ClearWaterParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(&self, _: &ClearWaterParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(&self, _: &ClearWaterParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(|(run, record)| channel::tables(&run.variant(), &record.data)).collect()
    }
}
