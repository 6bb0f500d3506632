//! Round granular columns, the experiment of Lube et al. (2004), in three dimensions.

mod parameters;

pub use parameters::{ColumnRoundParameters, RoundColumn};

use super::collapse::{self, Collapse, ColumnRun, Record};
use crate::case::{Case, ParameterError, Progress, Tier};
use crate::figure::{Animation, Figure};
use crate::metric::Metric;
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct ColumnRound;

impl Case for ColumnRound {
    type Parameters = ColumnRoundParameters;
    type Run = ColumnRun;
    type Observation = Collapse;

    fn name(&self) -> &'static str {
        "column-round"
    }

    fn summary(&self) -> &'static str {
        "round columns of sand in three dimensions: run-out against the axisymmetric experiment's law"
    }

    fn description(&self) -> &'static str {
        "A quarter of a cylinder of dry sand stands between two free-slip symmetry planes on a rough horizontal bed and is \
         released at once. Run-out and height are defined as in column-planar, with quarter rings of width 0.1 r_0 as \
         bins. The run-out law of Lube et al. (2004) was measured on such columns; the collapse paper compared its \
         planar runs with it. The height law of the same source is unverified and does not gate."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> ColumnRoundParameters {
        ColumnRoundParameters::of_tier(tier)
    }

    fn check(&self, parameters: &ColumnRoundParameters) -> Result<(), ParameterError> {
        parameters.check()?;
        collapse::check_size(&self.runs(parameters), |run| {
            let is_it =
                |column: &RoundColumn| column.aspect_ratio == run.aspect_ratio && column.resolution == run.resolution;
            format!("columns[{}].resolution", parameters.columns.iter().position(is_it).unwrap_or(0))
        })
    }

    fn runs(&self, parameters: &ColumnRoundParameters) -> Vec<ColumnRun> {
        parameters::runs(parameters)
    }

    fn simulate(&self, run: &ColumnRun, progress: &dyn Progress) -> Result<Recorded<Collapse>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &ColumnRoundParameters, records: &[Record]) -> Vec<Metric> {
        collapse::metrics::all(records)
    }

    fn figures(&self, _: &ColumnRoundParameters, records: &[Record]) -> Vec<Figure> {
        collapse::figures::all(records)
    }

    fn animations(&self, _: &ColumnRoundParameters, records: &[Record]) -> Vec<Animation> {
        collapse::figures::animations(records)
    }

    fn tables(&self, _: &ColumnRoundParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(collapse::tables).collect()
    }
}
