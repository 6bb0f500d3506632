//! Bed load on three slopes in three formulations.

mod checks;
mod figures;
mod fit;
mod metrics;
mod observation;
mod parameters;
mod profiles;
mod runs;
mod scenes;
mod statements;
mod tiers;

pub use observation::BedLoadObservation;
pub use parameters::{BedLoadParameters, Continuum, Fit, Grains, Materials, Stage, StageRuns, Yield};
pub use runs::{BedLoadRun, Formulation};

use crate::case::{Case, ParameterError, Progress, Run, Tier};
use crate::cases::channel;
use crate::figure::Figure;
use crate::metric::Metric;
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct BedLoad;

/// A run with what it left behind.
type Record = (BedLoadRun, Recorded<BedLoadObservation>);

impl Case for BedLoad {
    type Parameters = BedLoadParameters;
    type Run = BedLoadRun;
    type Observation = BedLoadObservation;

    fn name(&self) -> &'static str {
        "bed-load"
    }

    fn summary(&self) -> &'static str {
        "water over a bed that moves: profiles, drag and transport, in three formulations"
    }

    fn description(&self) -> &'static str {
        "Turbulent water over a bed of 5 mm grains. `stabilised` has one particle a grain, a yield stress that grows with \
         the grains' weight, and two parameters that are fitted on two slopes and judged on the third. `continuum` \
         resolves the grains' layer by its solid fraction, with literature closures and nothing fitted; it is verified \
         against the 1-D layer of bed-load-1d in three stages: grains at rest, grains that move at a given fraction, grains \
         that dilate. `paper` is the set-up as printed, which fails in documented ways: its metrics are observations. The \
         quick tier is too short to be stationary and says so: it judges conservation."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> BedLoadParameters {
        BedLoadParameters::of_tier(tier)
    }

    fn check(&self, parameters: &BedLoadParameters) -> Result<(), ParameterError> {
        parameters.check()
    }

    fn runs(&self, parameters: &BedLoadParameters) -> Vec<BedLoadRun> {
        runs::runs(parameters)
    }

    fn simulate(
        &self,
        run: &BedLoadRun,
        progress: &dyn Progress,
    ) -> Result<Recorded<BedLoadObservation>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &BedLoadParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(&self, _: &BedLoadParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(&self, _: &BedLoadParameters, records: &[Record]) -> Vec<Table> {
        let of_run = |(run, record): &Record| {
            let variant = run.variant();
            let mut tables = channel::tables(&variant, &record.data.channel);
            tables.extend(profiles::grain_table(&variant, &record.data));
            tables
        };
        records.iter().flat_map(of_run).collect()
    }
}
