//! A layer at rest: pressure, pressure noise, drift.

mod figures;
mod flow;
mod foreign;
mod metrics;

pub use flow::HydrostaticFlow;

use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, RecordOf, Tabulate};
use crate::layer;
use crate::metric::Quantity;
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
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const FROM_EXTERNAL: FromExternal<Self::Flow> = |run, given| foreign::observe(run, given).map(Some);
    const TABLES: Tabulate<Self::Flow> = layer::tables_of_runs;
}
