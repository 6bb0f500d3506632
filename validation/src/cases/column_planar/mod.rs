//! Planar granular columns that collapse and spread on a rough horizontal bed.

mod parameters;

pub use parameters::{ColumnPlanarParameters, Columns, Regularised, Sensitivity, Variants};

use super::collapse::{self, Collapse, ColumnRun, Purpose, Record};
use crate::case::{Case, ParameterError, Progress, Tier};
use crate::figure::{Animation, Figure};
use crate::metric::Metric;
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct ColumnPlanar;

impl Case for ColumnPlanar {
    type Parameters = ColumnPlanarParameters;
    type Run = ColumnRun;
    type Observation = Collapse;

    fn name(&self) -> &'static str {
        "column-planar"
    }

    fn summary(&self) -> &'static str {
        "planar columns of μ(I) grains: run-out, height and stopping time against the published laws"
    }

    fn description(&self) -> &'static str {
        "Half a column of dry grains stands against a free-slip symmetry plane on a rough horizontal bed and is released \
         at once. It falls, spreads and comes to rest. Run-out is the front where the thickness (volume per bin of \
         0.1 r_0, each particle spread over a spacing to either side) first falls below 0.02 r_0, seen from the symmetry plane, less the initial half width, over the \
         initial half width; height is the thickness of the innermost bin. The sand is that of the collapse paper's \
         Table 2; the other grains are those of Lagrée, Staron & Popinet (2011), whose grain diameter the source does \
         not give. The coefficients of the published laws depend on the material, their exponents much less."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> ColumnPlanarParameters {
        ColumnPlanarParameters::of_tier(tier)
    }

    fn check(&self, parameters: &ColumnPlanarParameters) -> Result<(), ParameterError> {
        parameters.check()?;
        collapse::check_size(&self.runs(parameters), |run| match run.purpose {
            Purpose::Convergence => "sensitivity.resolutions".to_owned(),
            Purpose::Hourglass => "sensitivity.hourglass_resolutions".to_owned(),
            Purpose::Law | Purpose::Regularised => parameters.resolution_field(run.aspect_ratio).to_owned(),
        })
    }

    fn runs(&self, parameters: &ColumnPlanarParameters) -> Vec<ColumnRun> {
        parameters::runs(parameters)
    }

    fn simulate(&self, run: &ColumnRun, progress: &dyn Progress) -> Result<Recorded<Collapse>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Metric> {
        collapse::metrics::all(records)
    }

    fn figures(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Figure> {
        collapse::figures::all(records)
    }

    fn animations(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Animation> {
        collapse::figures::animations(records)
    }

    fn tables(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(collapse::tables).collect()
    }
}
