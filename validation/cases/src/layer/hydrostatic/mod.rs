//! A layer at rest: pressure, pressure noise, drift.

mod elasticity;
mod figures;
mod foreign;
mod kernel;
mod metrics;
mod parameters;

pub use parameters::{HydrostaticParameters, HydrostaticRun};

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf};
use crate::figure::Figure;
use crate::input::FieldError;
use crate::layer::{self, LayerObservation};
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Hydrostatic;

type HydrostaticRecord = RecordOf<HydrostaticParameters>;

impl Case for Hydrostatic {
    const NAME: &'static str = "hydrostatic";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "a jittered layer at rest, Newtonian and μ(I): pressure, its noise, drift";
    const DESCRIPTION: &'static str = "A layer of displaced particles, settled without friction before the start (`preparation`), must stay at rest \
        with the exact hydrostatic pressure of its equation of state, without the particle-scale pressure noise that weakly \
        compressible SPH is known for. The same run without the density–pressure coupling (27) shows that the noise \
        measure can fail. Under friction the pressure of a layer at rest is not unique (between the active and the \
        passive state), but the stress across the layer is: p − s_yy is gated and p observed, for whatever law carries its \
        stress along; every other law is judged by p.";
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;
    type Parameters = HydrostaticParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(parameters: &HydrostaticParameters, records: &[HydrostaticRecord]) -> Vec<Metric> {
        let mut metrics = metrics::all(records);
        metrics.extend(kernel::all(&parameters.layer.numerics));
        metrics.extend(elasticity::all(&parameters.grains));
        metrics
    }

    fn figures(_: &HydrostaticParameters, records: &[HydrostaticRecord]) -> Vec<Figure> {
        figures::all(records)
    }

    fn from_external(
        run: &HydrostaticRun,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<LayerObservation>>, FieldError> {
        foreign::observe(run, given).map(Some)
    }

    fn tables(_: &HydrostaticParameters, records: &[HydrostaticRecord]) -> Vec<Table> {
        layer::tables_of_runs(records)
    }
}
