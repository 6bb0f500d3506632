//! Incompressible water at rest: height, vertical velocity, pressure.

mod figures;
mod metrics;
mod parameters;

pub use parameters::{StillWaterParameters, StillWaterRun};

use super::channel::{self, ChannelObservation};
use crate::case::{Case, ParameterError, Progress, Run, Tier};
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct StillWater;

/// A run with what it left behind.
type Record = (StillWaterRun, Recorded<ChannelObservation>);

impl Case for StillWater {
    type Parameters = StillWaterParameters;
    type Run = StillWaterRun;
    type Observation = ChannelObservation;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn name(&self) -> &'static str {
        "still-water"
    }

    fn summary(&self) -> &'static str {
        "a displaced column of incompressible water at rest: height, vertical velocity, pressure"
    }

    fn description(&self) -> &'static str {
        "Water of displaced particles over a closed floor must come to rest with its height and with the hydrostatic \
         pressure. On strongly displaced particles the compact Laplacian of the bed-load paper alone corrects too much, \
         with alternating sign: the same column without the stabilisation of the pressure Poisson equation blows up at \
         once, which shows that the test can fail. A profile alone would not show it early; height and vertical velocity \
         do."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> StillWaterParameters {
        StillWaterParameters::of_tier(tier)
    }

    fn check(&self, parameters: &StillWaterParameters) -> Result<(), ParameterError> {
        parameters.check()
    }

    fn runs(&self, parameters: &StillWaterParameters) -> Vec<StillWaterRun> {
        parameters::runs(parameters)
    }

    fn simulate(
        &self,
        run: &StillWaterRun,
        progress: &dyn Progress,
    ) -> Result<Recorded<ChannelObservation>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &StillWaterParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(&self, _: &StillWaterParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(&self, _: &StillWaterParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(|(run, record)| channel::tables(&run.variant(), &record.data)).collect()
    }
}
