//! Planar granular columns that collapse and spread on a rough horizontal bed.

mod column;
mod deposit;
mod figures;
mod metrics;
mod parameters;

pub use column::ColumnRun;
pub use deposit::{BIN_WIDTH, Collapse, FRONT_THICKNESS, front};
pub use parameters::{ColumnPlanarParameters, Columns};

use crate::case::{Case, Progress, Run, Tier};
use crate::error::InputError;
use crate::figure::Figure;
use crate::metric::Metric;
use crate::observe::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct ColumnPlanar;

/// A run with what it left behind.
type Record = (ColumnRun, Recorded<Collapse>);

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

    fn check(&self, parameters: &ColumnPlanarParameters) -> Result<(), InputError> {
        parameters.check()
    }

    fn runs(&self, parameters: &ColumnPlanarParameters) -> Vec<ColumnRun> {
        column::all(parameters)
    }

    fn simulate(&self, run: &ColumnRun, progress: &dyn Progress) -> Result<Recorded<Collapse>, InputError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(&self, _: &ColumnPlanarParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(|(run, record)| tables(&run.variant(), &record.data)).collect()
    }
}

fn tables(variant: &str, collapse: &Collapse) -> Vec<Table> {
    let stem = variant.replace(['=', ','], "-").replace('_', "-");
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let series = |k: usize| {
        let energies = [collapse.kinetic_energy[k], collapse.potential_energy[k]];
        [collapse.time[k], collapse.front[k], collapse.height[k]].into_iter().chain(energies).collect()
    };
    vec![
        Table {
            name: format!("deposit-{stem}"),
            columns: names(&["x/r0 [-]", "thickness/r0 [-]"]),
            rows: collapse.deposit.iter().map(|&(x, thickness)| vec![x, thickness]).collect(),
        },
        Table {
            name: format!("series-{stem}"),
            columns: names(&[
                "t [s]",
                "front/r0 [-]",
                "height/r0 [-]",
                "kinetic energy [J/m]",
                "potential energy [J/m]",
            ]),
            rows: (0..collapse.time.len()).map(series).collect(),
        },
    ]
}
