//! A layer at rest: pressure, pressure noise, drift.

mod figures;
mod flow;
mod foreign;
mod metrics;

pub use flow::HydrostaticFlow;

use crate::case::{Case, ExternalData, ExternalSchema, RecordOf};
use crate::figure::Figure;
use crate::layer;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::shared::FromExternal;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Hydrostatic;

type HydrostaticRecord = RecordOf<HydrostaticFlow>;

impl Case for Hydrostatic {
    const NAME: &'static str = "hydrostatic";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "a jittered layer at rest, Newtonian and μ(I): pressure, its noise, drift";
    const DESCRIPTION: &'static str = "\
        Setup. A layer of perturbed particles, relaxed without friction before the start (`preparation`), lies at \
        rest, as a Newtonian liquid and as μ(I) grains. A second run leaves out the density–pressure coupling (27).\n\n\
        Judged. Hydrostatic pressure of the equation of state, particle-scale pressure noise and drift. Grains that \
        carry their stress are judged by p − s_yy, because friction leaves the pressure undetermined between the \
        active and the passive state. The run without coupling must be noisy, which shows that the measure can fail.\n\n\
        Observed only. Velocities at rest.";
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;
    type Flow = HydrostaticFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(records: &[HydrostaticRecord]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(records: &[HydrostaticRecord]) -> Vec<Figure> {
        figures::all(records)
    }

    fn from_external(run: &HydrostaticFlow, given: &ExternalData) -> FromExternal<HydrostaticFlow> {
        foreign::observe(run, given).map(Some)
    }

    fn tables(records: &[HydrostaticRecord]) -> Vec<Table> {
        layer::tables_of_runs(records)
    }
}
