//! Newtonian, Bingham and Herschel–Bulkley films on an incline against their exact profiles.

mod comparison;
mod figures;
mod fluid;
mod metrics;
mod parameters;

pub use fluid::FluidKind;
pub use parameters::{FilmParameters, FilmRun};

use super::layer::{self, LayerObservation};
use crate::case::{Case, ParameterError, Progress, Run, Tier};
use crate::figure::Figure;
use crate::metric::Metric;
use crate::observation::Recorded;
use crate::output::Table;

/// The case.
#[derive(Debug)]
pub struct Film;

/// A run with what it left behind.
type Record = (FilmRun, Recorded<LayerObservation>);

impl Case for Film {
    type Parameters = FilmParameters;
    type Run = FilmRun;
    type Observation = LayerObservation;

    fn name(&self) -> &'static str {
        "film"
    }

    fn summary(&self) -> &'static str {
        "Newtonian, Bingham and Herschel–Bulkley films on an incline against their exact profiles"
    }

    fn description(&self) -> &'static str {
        "A viscous film on an incline, periodic along the slope, over a no-slip bed. The Newtonian film starts from rest; \
         the two yield-stress films, regularised after Papanastasiou and so with a long viscous relaxation, start from \
         their exact profile and must keep it. Velocity profile, flux and the edge of the plug are compared with the \
         exact solutions of the unregularised laws: the regularisation's creep of the plug is part of the error. The \
         Newtonian film is also run with the collapse paper's operators and walls, which are observed and do not gate."
    }

    fn field_notes(&self) -> &'static [(&'static str, &'static str)] {
        parameters::FIELD_NOTES
    }

    fn parameters(&self, tier: Tier) -> FilmParameters {
        FilmParameters::of_tier(tier)
    }

    fn check(&self, parameters: &FilmParameters) -> Result<(), ParameterError> {
        parameters.check()
    }

    fn runs(&self, parameters: &FilmParameters) -> Vec<FilmRun> {
        parameters::runs(parameters)
    }

    fn simulate(&self, run: &FilmRun, progress: &dyn Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        run.simulate(progress)
    }

    fn metrics(&self, _: &FilmParameters, records: &[Record]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(&self, _: &FilmParameters, records: &[Record]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(&self, _: &FilmParameters, records: &[Record]) -> Vec<Table> {
        records.iter().flat_map(|(run, record)| layer::tables(&run.variant(), &record.data)).collect()
    }
}
