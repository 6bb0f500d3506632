//! A layer at rest: pressure, pressure noise, drift.

mod figures;
mod metrics;
mod parameters;

pub use parameters::{HydrostaticParameters, HydrostaticRun, MaterialKind};

use super::layer::{self, LayerObservation};
use crate::case::{Case, ParameterError, Progress, Run, Tier};
use crate::figure::Figure;
use crate::metric::Metric;
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct Hydrostatic;

/// A run with what it left behind.
type Record = (HydrostaticRun, Recorded<LayerObservation>);

impl Case for Hydrostatic {
    type Parameters = HydrostaticParameters;
    type Run = HydrostaticRun;
    type Observation = LayerObservation;

    fn name(&self) -> &'static str {
        "hydrostatic"
    }

    fn summary(&self) -> &'static str {
        "a jittered layer at rest, Newtonian and μ(I): pressure, its noise, drift"
    }

    fn description(&self) -> &'static str {
        "A layer of displaced particles, settled without friction before the start (`preparation`), must stay at rest \
         with the exact hydrostatic pressure of its equation of state, without the particle-scale pressure noise that weakly \
         compressible SPH is known for. The same run without the density–pressure coupling (27) shows that the noise \
         measure can fail. Under friction the pressure of a layer at rest is not unique (between the active and the \
         passive state), but the stress across the layer is: p − s_yy is gated and p observed."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> HydrostaticParameters {
        HydrostaticParameters::of_tier(tier)
    }

    fn check(&self, parameters: &HydrostaticParameters) -> Result<(), ParameterError> {
        parameters.check()
    }

    fn runs(&self, parameters: &HydrostaticParameters) -> Vec<HydrostaticRun> {
        parameters::runs(parameters)
    }

    fn simulate(
        &self,
        run: &HydrostaticRun,
        progress: &dyn Progress,
    ) -> Result<Recorded<LayerObservation>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &HydrostaticParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(&self, _: &HydrostaticParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(&self, _: &HydrostaticParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(|(run, record)| layer::tables(&run.variant(), &record.data)).collect()
    }
}
